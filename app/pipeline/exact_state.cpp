#include "app/pipeline/exact_state.hpp"

#include <utility>

#include "app/pipeline/hinge_loads.hpp"
#include "app/run/run_options.hpp"
#include "model/lattice/lattice_motion.hpp"

namespace kinetix::app {
namespace {

constexpr int timed_calls = 200;  // enough to resolve the mean, microseconds for small sheets

/// Returns the size of the folded design by the closed form, mm.
std::optional<Eigen::Vector3d> folded_size(const model::ExactMotion& motion, const Design& design) {
  const Eigen::Vector3d size = size_of(design.structure, motion.at(exact_theta_of(design, motion)));
  return size.allFinite() ? std::optional(size) : std::nullopt;
}

}  // namespace

NamedState exact_state(const Found& found, const std::string& name, double theta) {
  model::State own = found.motion ? found.motion(theta) : found.plan.exact.at(theta);
  const model::HingeGaps gaps = hinge_gaps(found.design.structure, own);
  if (found.to_shown) own = moved(std::move(own), *found.to_shown);
  return {name, to_string(Model::exact), theta, std::move(own), gaps};
}

std::vector<NamedState> exact_frames(const Found& found) {
  std::vector<NamedState> out;
  for (int k = 0; k < motion_states; ++k)
    out.push_back(exact_state(found, "frame", found.theta * k / (motion_states - 1)));
  return out;
}

Fidelity exact_fidelity(const model::ExactMotion& exact, const model::Linkage& structure, double theta) {
  model::State state;
  Stopwatch watch;
  for (int k = 0; k < timed_calls; ++k) state = exact.at(theta);
  const double seconds = watch.lap() / timed_calls;
  return {to_string(Model::exact), seconds, hinge_gaps(structure, state).max, "its own hinge closure"};
}

std::optional<Model> plan_model(const Design& design, Model asked) {
  if (design.structure.assembly()) return asked;
  const bool elastic = design.hinge.model == HingeSection::Model::elastic;
  const bool in_equilibrium = asked == Model::equilibrium || (asked == Model::bullet && elastic);
  return in_equilibrium ? std::optional(Model::equilibrium) : std::nullopt;
}

Forecast forecast_design(const Design& design) {
  Forecast out{design.structure};
  if (const auto motion = exact_motion(design.structure)) out.folded_mm = folded_size(motion, design);
  if (design.drive && needs_elastic_hinges(*design.drive) &&
      design.hinge.model == HingeSection::Model::rotary)
    out.notes.push_back(
        "`verify` needs elastic hinges for this drive: give `hinge: {model: elastic}`; --model equilibrium "
        "takes rotary ones as elastic");
  return out;
}

}  // namespace kinetix::app
