#include "app/print/sheet/lock.hpp"

#include "model/closure/drive_theta.hpp"
#include "model/elastic/elastic_system.hpp"

namespace kinetix::app {
namespace {

constexpr int most_rounds = 200;         // of the search
constexpr double share_of_step = 0.5;    // of a step that is taken: whole ones can swing to and fro
constexpr double longest_turn = 0.1;     // rad, cell edges: of a round
constexpr double settled_turn = 1e-7;    // rad, cell edges: a shorter round ends the search
constexpr double small_turn = 1e-6;      // rad, cell edges: step of difference quotients
constexpr double largest_change = 0.05;  // of the length, ratio to it: more is another state

model::Elasticity elasticity_of_sheet(const PrintSheet& sheet) {
  model::Elasticity whole;
  for (const model::HingePrint& hinge : sheet.hinges) whole.each.push_back(elasticity_of(hinge.made));
  whole.k_point = 0;
  for (const model::Elasticity& each : whole.each) whole.k_point = std::max(whole.k_point, each.k_point);
  whole.k_contact = 10 * whole.k_point;  // as of any sheet; nothing touches here
  return whole;
}

/// Search for the equilibrium of E + force d at a mean theta. Each round is a step of Newton's method with the
/// stiffness of the fold itself, where no hinge is pressed: pressed hinges have less, and the lock replaces it.
class HoldSearch {
 public:
  using Length = std::function<double(const model::State&)>;

  HoldSearch(const PrintSheet& sheet, const std::array<int, 2>& bodies, const Length& length_mm)
      : elasticity_(elasticity_of_sheet(sheet)),
        system_(sheet.linkage, elasticity_, all_vertical(sheet.linkage), false),
        unit_Nmm_(elasticity_.k_point * std::pow(sheet.linkage.size.edge_mm, 2)),
        bodies_(bodies),
        length_mm_(length_mm),
        state_(sheet.path.back()),
        theta_(mean_theta(sheet.linkage, state_)) {}

  std::optional<HeldFold> run() {
    const double goal_mm = length_mm_(state_);
    model::TangentStiffness tangent(system_.dofs());
    system_.linearise(state_, 0, tangent);
    if (!tangent.factorise(0)) return std::nullopt;
    for (int round = 0; round < most_rounds; ++round) {
      const Eigen::VectorXd gradient = system_.dofs().restrict(system_.elastic_gradient(state_));
      const Eigen::VectorXd pull = system_.dofs().restrict(length_gradient()) / unit_Nmm_;
      const Eigen::VectorXd released = tangent.solve(gradient), pulled = tangent.solve(pull);
      const double missing = theta_ - mean_theta(system_.structure(), state_);
      const double force_N = -(theta_rate(released) + missing) / theta_rate(pulled);
      const Eigen::VectorXd step = -released - force_N * pulled;
      const double longest = step.lpNorm<Eigen::Infinity>();
      if (!std::isfinite(longest)) return std::nullopt;
      state_ = moved(step, std::min(share_of_step, longest_turn / longest));
      const double length_mm = length_mm_(state_);
      if (!(std::abs(length_mm - goal_mm) <= largest_change * goal_mm)) return std::nullopt;
      if (longest > settled_turn) continue;
      if (!(force_N > 0)) return std::nullopt;
      return HeldFold{state_, length_mm, force_N};
    }
    return std::nullopt;
  }

 private:
  model::State moved(const Eigen::VectorXd& unknowns, double share) const {
    return system_.retract(state_, system_.dofs().extend(share * unknowns));
  }

  /// Returns the derivative of the mean theta along a motion, rad.
  double theta_rate(const Eigen::VectorXd& unknowns) const {
    const double share = small_turn / unknowns.lpNorm<Eigen::Infinity>();
    return (mean_theta(system_.structure(), moved(unknowns, share)) -
            mean_theta(system_.structure(), moved(unknowns, -share))) /
           (2 * share);
  }

  /// Returns the derivative of the length by all coordinates, mm per rad and per cell edge.
  Eigen::VectorXd length_gradient() const {
    const Eigen::Index count = system_.dofs().coordinates();
    Eigen::VectorXd out = Eigen::VectorXd::Zero(count);
    for (const int body : bodies_)
      for (Eigen::Index k = 6 * body; k < 6 * (body + 1); ++k) {
        const Eigen::VectorXd step = small_turn * Eigen::VectorXd::Unit(count, k);
        out[k] = (length_mm_(system_.retract(state_, step)) - length_mm_(system_.retract(state_, -step))) /
                 (2 * small_turn);
      }
    return out;
  }

  const model::Elasticity elasticity_;
  const model::ElasticSystem system_;
  const double unit_Nmm_;
  const std::array<int, 2> bodies_;
  const Length& length_mm_;
  model::State state_;
  const double theta_;  // rad
};

}  // namespace

std::optional<HeldFold> find_held_fold(const PrintSheet& sheet, const std::array<int, 2>& bodies,
                                       const std::function<double(const model::State&)>& length_mm) {
  if (!sheet.has_soft()) return std::nullopt;
  return HoldSearch(sheet, bodies, length_mm).run();
}

}  // namespace kinetix::app
