#include "optim/panel_balance.hpp"

#include "model/closure_drive.hpp"
#include "model/elastic/adjoint.hpp"
#include "model/elastic/load_path.hpp"

namespace kinetix {
namespace {

constexpr double nearby = 0.3;
constexpr int most_iterations = 40;

}  // namespace

PanelBalance::PanelBalance(Structure panel, const Elasticity& elasticity, const Drive& plates)
    : panel_(std::move(panel)), elasticity_(elasticity), drive_(plates) {
  const ElasticSystem refuses_overlap(panel_, elasticity_, drive_, true, true);
}

bool PanelBalance::settle(const Eigen::VectorXd& t) {
  for (std::size_t h = 0; h < panel_.hinges.size(); ++h) panel_.hinges[h].parameters.t = t[h];
  return settle_nearby() || settle_from_flat();
}

bool PanelBalance::settle_nearby() {
  if (kept_.empty()) return false;
  ElasticSystem system(panel_, elasticity_, drive_, true, true);
  Tangent tangent(system.freedoms());
  NewtonOptions options;
  options.max_iterations = most_iterations;
  State state = kept_;
  system.place(drive_.theta(), state);
  const NewtonResult result = minimise(system, drive_.theta(), options, state, tangent);
  if (!result.converged || !result.stable || !(turn_distance(panel_, kept_, state) <= nearby)) return false;
  state_ = std::move(state);
  return true;
}

bool PanelBalance::settle_from_flat() {
  ++paths_;
  LoadPathOptions options;
  options.planar = true;
  LoadPath path = follow_load(panel_, elasticity_, drive_, options);
  if (path.stop != LoadPath::Stop::reached || !path.steps.back().stable) return false;
  state_ = std::move(path.state);
  return true;
}

std::optional<PanelBalance::Slopes> PanelBalance::slopes(const Eigen::VectorXd& by_state) {
  const ElasticSystem system(panel_, elasticity_, drive_, true, true);
  Tangent tangent(system.freedoms());
  const double theta = drive_.theta();
  system.linearise(state_, theta, tangent);
  if (!tangent.factorise(0)) return std::nullopt;
  BalanceGradient gradient;
  gradient.state = by_state;
  const Sensitivity by = sensitivity(system, elasticity_, state_, theta, tangent, gradient);
  return Slopes{by.hinges.row(0).transpose(), by.theta / system.drive_rate(theta)};
}

}  // namespace kinetix
