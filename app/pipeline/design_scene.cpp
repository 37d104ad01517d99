#include "app/pipeline/design_scene.hpp"

#include <utility>

#include "app/pipeline/design_drive.hpp"
#include "app/pipeline/equilibrium.hpp"
#include "app/pipeline/exact_state.hpp"
#include "app/pipeline/physics_settings.hpp"
#include "model/base/invalid_input.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {
namespace {

/// The state to compare with; empty where there is none of the whole drive.
model::State reference_of(const Run& run) {
  const bool on_the_way = run.equilibrium && !run.equilibrium->reached();
  return run.states.empty() || on_the_way ? model::State{} : run.states.front().poses;
}

/// Of the closed form.
std::optional<Eigen::Vector3d> folded_size(const model::ExactMotion& motion, const Design& design) {
  const Eigen::Vector3d size = size_of(design.structure, motion.at(exact_theta_of(design, motion)));
  return size.allFinite() ? std::optional(size) : std::nullopt;
}

class DesignScene final : public Scene {
 public:
  DesignScene(Design design, Model model) : design_(std::move(design)), model_(model) {}

  std::string name() const override { return design_.name; }

  std::optional<Model> model() const override {
    const bool elastic = design_.hinge.model == HingeSection::Model::elastic;
    const bool in_equilibrium = model_ == Model::equilibrium || (model_ == Model::bullet && elastic);
    return in_equilibrium ? std::optional(Model::equilibrium) : std::nullopt;
  }

  Forecast forecast() const override {
    Forecast out{design_.structure};
    out.has_physics = model_ == Model::bullet;
    if (const auto motion = exact_motion(design_.structure)) out.folded_mm = folded_size(motion, design_);
    if (needs_elastic_hinges() && design_.hinge.model == HingeSection::Model::rotary)
      out.notes.push_back(
          "`verify` needs elastic hinges for this drive: give `hinge: {model: elastic}`; --model equilibrium "
          "takes rotary ones as elastic");
    return out;
  }

  void solve(Run& run, const RunOptions&) const override {
    run.design = design_;
    run.theta = design_.theta;
  }

  void add_state(Run& run, const RunOptions& options) const override {
    if (run.plan.model == Model::equilibrium)
      return add_equilibrium(run, drive_of(design_), elasticity_of(design_), motion_states, options);
    if (!run.plan.exact && model_ == Model::exact)
      throw InvalidInput(run.plan.exact.why +
                         "; use --model equilibrium or bullet, which need no exact family");
    if (!run.plan.exact) return;
    add_exact_state(run, exact_theta_of(design_, run.plan.exact));
    add_exact_frames(run);
  }

  std::optional<PhysicsTask> physics_task(const Run& run) const override {
    if (model_ != Model::bullet) return std::nullopt;
    return PhysicsTask{reference_of(run), drive_of(design_), physics_of(design_, run.plan.planar)};
  }

 private:
  bool needs_elastic_hinges() const {
    return design_.drive && (design_.drive->press || design_.drive->kind == DriveSection::Kind::shape_memory);
  }

  Design design_;
  Model model_;
};

}  // namespace

std::unique_ptr<Scene> make_scene(Design design, Model model) {
  return std::make_unique<DesignScene>(std::move(design), model);
}

}  // namespace kinetix::app
