#include "app/run/run.hpp"

#include "model/base/invalid_input.hpp"

namespace kinetix::app {
namespace {

/// Returns the requested theta, rad, which the equilibrium need not have reached. Plates on lattices other than squares, for which
/// the file has no drive, need not approach each other by the cosine of it.
double asked_theta(const Run& run) {
  if (!run.equilibrium) return run.theta;
  const model::LinkageDrive& drive = run.equilibrium->drive;
  const bool is_by_cosine =
      run.design.drive || run.design.structure.squares() || drive.kind != model::LinkageDrive::Kind::plates;
  if (is_by_cosine || !run.plan.exact) return drive.theta();
  try {
    return run.plan.exact.theta_of(drive);
  } catch (const InvalidInput&) {
    return drive.theta();
  }
}

}  // namespace

Design written_design(const Run& run) {
  Design design = run.design;
  design.theta = asked_theta(run);
  return design;
}

}  // namespace kinetix::app
