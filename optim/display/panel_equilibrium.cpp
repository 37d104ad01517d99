#include "optim/display/panel_equilibrium.hpp"

#include "model/closure/closure_drive.hpp"
#include "model/elastic/adjoint.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/lattice/lattice_motion.hpp"

namespace kinetix::optim {
namespace {

// Rad of a hinge. A state further away is often on another branch. Of a hundred searches that left 0.3
// behind, nine in ten up to here reached the equilibrium of the path from flat, and half of those beyond.
constexpr double nearby = 0.8;
constexpr int most_iterations = 40;  // of Newton's method: beyond, the path from flat is faster

}  // namespace

PanelEquilibrium::PanelEquilibrium(model::Lattice panel, const model::Elasticity& elasticity,
                                   const model::Plates& plates)
    : panel_(std::move(panel)), elasticity_(elasticity), drive_(plates) {
  const model::ElasticSystem refuses_overlap(panel_, elasticity_, plates_on_panel(), true, true);
}

model::LinkageDrive PanelEquilibrium::plates_on_panel() const { return drive_on(panel_, drive_); }

bool PanelEquilibrium::settle(const Eigen::VectorXd& t, const Eigen::VectorXd& offset) {
  for (int h = 0; h < panel_.hinges(); ++h) {
    panel_.hinge(h).t = t[h];
    if (offset.size() > 0) panel_.hinge(h).offset = offset[h];
  }
  return settle_nearby() || settle_from_flat();
}

bool PanelEquilibrium::settle_nearby() {
  if (kept_.empty()) return false;
  model::ElasticSystem system(panel_, elasticity_, plates_on_panel(), true, true);
  model::TangentStiffness tangent(system.dofs());
  model::NewtonOptions options;
  options.max_iterations = most_iterations;
  model::State state = kept_;
  const double theta = system.drive().theta();
  system.place(theta, state);
  const model::NewtonResult result = minimise(system, theta, options, state, tangent);
  if (!result.converged || !result.stable || !(turn_distance(panel_, kept_, state) <= nearby)) return false;
  state_ = std::move(state);
  return true;
}

bool PanelEquilibrium::settle_from_flat() {
  ++paths_;
  model::EquilibriumPathOptions options;
  options.planar = true;
  model::EquilibriumPath path =
      trace_equilibrium({panel_, plates_on_panel(), exact_motion(panel_)}, elasticity_, options);
  if (path.stop != model::EquilibriumPath::Stop::reached || !path.steps.back().stable) return false;
  state_ = std::move(path.state);
  return true;
}

std::optional<PanelEquilibrium::Gradient> PanelEquilibrium::gradient(const Eigen::VectorXd& by_state) {
  const model::ElasticSystem system(panel_, elasticity_, plates_on_panel(), true, true);
  model::TangentStiffness tangent(system.dofs());
  const double theta = system.drive().theta();
  system.linearise(state_, theta, tangent);
  if (!tangent.factorise(0)) return std::nullopt;
  model::EquilibriumGradient gradient;
  gradient.state = by_state;
  const model::Sensitivity by = sensitivity(system, elasticity_, state_, theta, tangent, gradient);
  return Gradient{by.hinges.row(0).transpose(), by.hinges.row(3).transpose(),
                  by.theta / system.drive().coordinate_rate(theta)};
}

}  // namespace kinetix::optim
