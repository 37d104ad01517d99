#include "model/elastic/path/path_stop.hpp"

#include <cmath>

#include "model/base/angle.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

using Stop = EquilibriumPath::Stop;

std::string degrees(double theta) { return number_text(to_degrees(theta)) + " deg"; }

std::string place(const EquilibriumStep& last, const LinkageDrive& drive, const OffClosedForm& off) {
  const std::string at = " at theta " + degrees(last.theta) + (drive.tells_fold() ? "" : " of the drive") +
                         ", load " + number_text(last.load) + " " + drive.load_unit();
  if (!std::isfinite(off.since)) return at;
  return at + "; off the closed form since theta " + degrees(off.since) +
         (off.unstable ? ", where that is unstable" : "");
}

std::string overstretched(const HingeGaps& gaps, const Linkage& linkage, double gap_limit) {
  return "the hinge on wall " + linkage.wall_name(gaps.worst_hinge) + " stretched by " +
         number_text(gaps.max) + " cell edges; at most " + number_text(gap_limit) + " is allowed;";
}

std::string locked(const Refusal& refusal, const std::string& what) {
  return what + " in contact lock the structure: " +
         (refusal.faults.tunnelled ? "further on they would have to pass through each other;"
                                   : "no equilibrium found further on;");
}

std::string not_converged(const Refusal& refusal) {
  if (refusal.faults.mirrored) return "further on the sheet folds to the other side than asked;";
  return "no equilibrium found further on (" + number_text(refusal.newton.iterations) +
         " iterations, force " + number_text(refusal.newton.force) + " left);";
}

}  // namespace

EquilibriumPath::Stop Refusal::stop(const EquilibriumStep& last) const {
  return last.contacts == 0 && touching.empty() && !faults.tunnelled ? Stop::not_converged : Stop::locked;
}

std::string stop_reason(const EquilibriumPath& path, const MeasuredSystem& system, double gap_limit,
                        const Refusal& refusal, const OffClosedForm& off) {
  const std::string at = place(path.steps.back(), system.elastic.drive(), off);
  switch (path.stop) {
    case Stop::reached:
      return "the drive reached its goal" + at;
    case Stop::overstretched:
      return overstretched(path.gaps, system.elastic.structure(), gap_limit) + at;
    case Stop::locked:
      return locked(refusal, system.elastic.touching_kind()) + at;
    case Stop::interrupted:
      return "it was told to stop" + at;
    case Stop::not_converged:
      break;
  }
  return not_converged(refusal) + at;
}

std::string to_string(EquilibriumPath::Stop stop) {
  switch (stop) {
    case Stop::reached:
      return "reached";
    case Stop::overstretched:
      return "torn";
    case Stop::locked:
      return "locked";
    case Stop::interrupted:
      return "interrupted";
    case Stop::not_converged:
      break;
  }
  return "not converged";
}

}  // namespace kinetix::model
