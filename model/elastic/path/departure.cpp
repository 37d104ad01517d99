#include "model/elastic/path/departure.hpp"

#include "model/base/angle.hpp"
#include "model/base/invalid_input.hpp"
#include "model/closure/closure_drive.hpp"
#include "model/closure/null_space.hpp"

namespace kinetix::model {
namespace {

// Ratio to the smallest singular value of flat. Stiffness scales with its square, so a sixteenth is left.
constexpr double nearly_lost = 0.25;

std::string rounded(double number) { return number_text(std::round(10 * number) / 10); }

std::string energy_words(const ElasticSystem& system, const State& state, const State& exact) {
  const double spared = 1 - system.elastic_energy(state) / system.elastic_energy(exact);
  if (!(spared > 0)) return "";
  return ", with " + rounded(100 * spared) + " % less energy";
}

std::string cause(const Linkage& linkage, const State& exact) {
  const NullSpace flat = null_space(linkage, rest_state(linkage));
  if (flat.dofs() > 1) return "it is one of several motions that begin in the flat state";
  const NullSpace folded = null_space(linkage, exact);
  if (folded.dofs() > 1 || folded.smallest_other < nearly_lost * flat.smallest_other)
    return "a second motion begins near there, and its hinges turn for less";
  return "the hinges give way too much to hold it";
}

}  // namespace

std::optional<double> DepartureWatch::see(const State& state, double theta, bool came_along) {
  if (came_along) place_ = Place::on_it;
  if (place_ == Place::elsewhere) return {};
  const auto exact = closed_form_.at(theta);
  if (!exact) return {};
  const double off = turn_distance(system_.structure(), state, *exact);
  if (place_ == Place::left && off <= ClosedForm::near) place_ = Place::on_it;
  if (place_ == Place::on_it && system_.touching(*exact) > 0) place_ = Place::elsewhere;
  if (place_ != Place::on_it || !(off > ClosedForm::far)) return {};
  place_ = Place::left;
  return off;
}

std::string departure_words(const ElasticSystem& system, const ClosedForm& closed_form, const State& state,
                            double theta, double turn) {
  const State exact = *closed_form.at(theta);
  return "left the closed form: hinges turn by up to " + rounded(to_degrees(turn)) + " deg otherwise" +
         energy_words(system, state, exact) + "; " + cause(system.structure(), exact);
}

}  // namespace kinetix::model
