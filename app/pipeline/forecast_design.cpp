#include "app/pipeline/forecast_design.hpp"

#include "app/pipeline/design_drive.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {
namespace {

/// Returns the size of the folded design by the closed form, mm.
std::optional<Eigen::Vector3d> folded_size(const model::ExactMotion& motion, const Design& design) {
  const Eigen::Vector3d size = size_of(design.structure, motion.at(exact_theta_of(design, motion)));
  return size.allFinite() ? std::optional(size) : std::nullopt;
}

}  // namespace

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
