#include "model/tolerance/touching_prints.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "model/contact/wall_contact.hpp"
#include "model/elastic/adjoint.hpp"
#include "model/elastic/newton.hpp"
#include "model/elastic/retract.hpp"
#include "model/tolerance/print_errors.hpp"

namespace kinetix::model {
namespace {

using Eigen::Matrix4Xd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int scatter_prints = 16;  // by which the scatter of two bodies against each other is estimated
// Rms of that scatter in all directions: of plates further apart about one in 1000 prints touches, also where 16 prints show a
// fifth too little.
constexpr double suspect_deviations = 4;
// Of how near two plates come in the fold: a state before it counts only where they come this much nearer.
constexpr double much_nearer = 0.8;
constexpr double overlap_in_edges = 1e-9;  // cell edges, as in WallContact
constexpr int prints_at_once = 50, most_prints = 1000;
constexpr double largest_share_error = 0.016;

/// A state of the design in equilibrium, of which prints differ to first order.
class PrintedStage {
 public:
  PrintedStage(const Linkage& linkage, HeldState held, bool planar)
      : state(std::move(held.state)),
        theta_(held.drive.theta()),
        system_(linkage, held.elasticity, held.drive, planar, false),
        tangent_(system_.dofs()) {
    system_.place(theta_, state);
    is_stable_ = settle(system_, theta_, state, tangent_);
    if (is_stable_) by_hinges_ = std::make_unique<DesignSensitivities>(system_, state, theta_, tangent_);
  }

  bool is_stable() const { return is_stable_; }
  /// @pre is_stable()
  VectorXd change(const Matrix4Xd& errors) const { return by_hinges_->change(errors); }
  /// Places the bodies of the suspects as a print with these errors has them; all others stay.
  State print(const Matrix4Xd& errors) const {
    const VectorXd all = change(errors);
    State looked_at;
    VectorXd twists(6 * static_cast<Eigen::Index>(bodies_.size()));
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      looked_at.push_back(state[bodies_[k]]);
      twists.segment<6>(6 * k) = all.segment<6>(6 * bodies_[k]);
    }
    looked_at = retract(system_.structure(), looked_at, twists);
    State out = state;
    for (std::size_t k = 0; k < bodies_.size(); ++k) out[bodies_[k]] = looked_at[k];
    return out;
  }

  /// @param plates of the linkage
  void suspect(std::vector<WallPair> pairs, const std::vector<Plate>& plates) {
    suspects = std::move(pairs);
    for (const WallPair& pair : suspects)
      for (const int plate : {pair.first, pair.second}) bodies_.push_back(plates[plate].body);
    std::sort(bodies_.begin(), bodies_.end());
    bodies_.erase(std::unique(bodies_.begin(), bodies_.end()), bodies_.end());
  }

  State state;
  std::vector<WallPair> suspects = {};

 private:
  std::vector<int> bodies_;  ///< of the suspects, ascending
  double theta_;
  ElasticSystem system_;
  TangentStiffness tangent_;
  std::unique_ptr<DesignSensitivities> by_hinges_;
  bool is_stable_ = false;
};

/// Plates that come close in a state, and how close: their gap over what their bodies' scatter allows, below 1.
struct SuspectPair {
  WallPair walls;
  double nearness = 0;
};

/// Finds plates that come closer in a state than the scatter of their bodies.
class SuspectPlates {
 public:
  /// @param changes of the state of the fold in some prints
  SuspectPlates(const Linkage& linkage, const std::vector<VectorXd>& changes)
      : depth_mm_(overlap_in_edges * linkage.size.edge_mm),
        walls_(half_walls(linkage)),
        at_rest_(linkage),
        plates_of_(linkage.bodies.size()),
        reach_(linkage.bodies.size()) {
    for (int k = 0; k < static_cast<int>(walls_.size()); ++k) {
      plates_of_[walls_[k].body].push_back(k);
      double& reach = reach_[walls_[k].body];
      reach = std::max(reach, walls_[k].box.center.norm() + radius(walls_[k].box));
    }
    for (int b = 0; b < static_cast<int>(linkage.bodies.size()); ++b) {
      motions_.emplace_back();
      for (const VectorXd& change : changes) {
        const Motion motion{change.segment<3>(6 * b), linkage.size.edge_mm * change.segment<3>(6 * b + 3)};
        motions_.back().push_back(motion);
        moved_ = std::max(moved_, motion.shift.norm());
      }
    }
  }

  std::vector<SuspectPair> find(const State& state) {
    Eigen::Matrix3Xd places(3, state.size());
    for (std::size_t b = 0; b < state.size(); ++b) places.col(b) = state[b].p;
    boxes_.clear();
    for (const HalfWall& wall : walls_) boxes_.push_back(placed(wall, state[wall.body]));
    const double farthest = *std::max_element(reach_.begin(), reach_.end());
    std::vector<SuspectPair> found;
    for (const auto& [a, b] : near_.find(places, 2 * (farthest + suspect_deviations * moved_)))
      add(state, a, b, found);
    return found;
  }

  bool overlap_in(const State& state, const WallPair& pair) const {
    const HalfWall &first = walls_[pair.first], &second = walls_[pair.second];
    const Pose &a = state[first.body], &b = state[second.body];
    const Vector3d apart = b.p + b.R * second.box.center - a.p - a.R * first.box.center;
    if (apart.norm() > radius(first.box) + radius(second.box)) return false;
    return overlap(placed(first, a), placed(second, b), depth_mm_);
  }

 private:
  /// How a print has a body elsewhere than the design.
  struct Motion {
    Vector3d turn;   // rad
    Vector3d shift;  // of its vertex, mm

    /// Of a point that it carries. @param from its vertex, mm
    Vector3d at(const Vector3d& from) const { return shift + turn.cross(from); }
  };

  /// How far two bodies move apart at a point between them, mm, and turn against each other, rad: each the rms over prints.
  struct Scatter {
    Vector3d at = Vector3d::Zero();
    double shift = 0, turn = 0;

    double near(const Vector3d& place) const {
      return suspect_deviations * (shift + turn * (place - at).norm());
    }
  };

  Scatter scatter(const State& state, int a, int b) const {
    Scatter out{(state[a].p + state[b].p) / 2};
    const Vector3d from_a = out.at - state[a].p, from_b = out.at - state[b].p;
    for (std::size_t k = 0; k < motions_[a].size(); ++k) {
      const Motion &of_a = motions_[a][k], &of_b = motions_[b][k];
      out.shift += (of_a.at(from_a) - of_b.at(from_b)).squaredNorm();
      out.turn += (of_a.turn - of_b.turn).squaredNorm();
    }
    const auto count = static_cast<double>(motions_[a].size());
    out.shift = std::sqrt(out.shift / count);
    out.turn = std::sqrt(out.turn / count);
    return out;
  }

  void add(const State& state, int a, int b, std::vector<SuspectPair>& found) const {
    const Scatter apart = scatter(state, a, b);
    const double reach = reach_[a] + reach_[b];
    if ((state[a].p - state[b].p).norm() > reach + suspect_deviations * (apart.shift + apart.turn * reach))
      return;
    for (const int p : plates_of_[a])
      for (const int q : plates_of_[b]) add_walls({std::min(p, q), std::max(p, q)}, apart, found);
  }

  void add_walls(const WallPair& pair, const Scatter& apart, std::vector<SuspectPair>& found) const {
    if (walls_[pair.first].hinge == walls_[pair.second].hinge) return;
    const OrientedBox &first = boxes_[pair.first], &second = boxes_[pair.second];
    const double near = apart.near((first.center + second.center) / 2);
    if ((first.center - second.center).norm() > radius(first) + radius(second) + near) return;
    const auto& left_out = at_rest_.touching_at_rest();
    if (std::binary_search(left_out.begin(), left_out.end(), pair)) return;
    if (const double gap = separation(first, second); gap <= near)
      found.push_back({pair, near > 0 ? gap / near : 0});
  }

  double depth_mm_;
  std::vector<HalfWall> walls_;
  WallContact at_rest_;
  std::vector<std::vector<int>> plates_of_;   ///< each body
  std::vector<double> reach_;                 ///< of each body's plates from its vertex, mm
  std::vector<std::vector<Motion>> motions_;  ///< of each body in those prints
  double moved_ = 0;                          ///< of any of them, mm
  std::vector<OrientedBox> boxes_;            ///< of the state that is looked at
  NearPairs near_;
};

/// In which state of the way two plates come closest, against their scatter.
struct Closest {
  int state = 0;
  double nearness = 0;
};

/// As if two more prints had been counted, one of which touches.
double share_error(const TouchingPrints& counted) {
  const double n = counted.prints + 2, share = (counted.touching + 1) / n;
  return std::sqrt(share * (1 - share) / n);
}

}  // namespace

std::optional<TouchingPrints> touching_prints(const Linkage& linkage, int states,
                                              const std::function<std::optional<HeldState>(int)>& way,
                                              const HingeScatter& scatter, const AsMadeOptions& options) {
  const auto stops = [&] { return options.stop && options.stop(); };
  const auto hinges = static_cast<Eigen::Index>(linkage.hinges.size());
  std::optional<HeldState> held = way(states - 1);
  if (!held) return std::nullopt;
  auto fold = std::make_unique<PrintedStage>(linkage, std::move(*held), options.planar);
  if (!fold->is_stable()) return std::nullopt;
  PrintErrors first(scatter, hinges, options.seed);
  std::vector<VectorXd> changes;
  for (int k = 0; k < scatter_prints; ++k) changes.push_back(fold->change(first.next()));
  SuspectPlates suspects(linkage, changes);

  std::map<WallPair, Closest> closest;
  for (int k = states - 1; k >= 0; --k) {
    if (stops()) return std::nullopt;
    if (k < states - 1) held = way(k);
    if (!held || !is_finite(k < states - 1 ? held->state : fold->state)) continue;
    for (const SuspectPair& found : suspects.find(k < states - 1 ? held->state : fold->state)) {
      const auto [at, is_new] = closest.try_emplace(found.walls, Closest{k, found.nearness});
      if (!is_new && found.nearness < much_nearer * at->second.nearness) at->second = {k, found.nearness};
    }
  }
  std::vector<std::unique_ptr<PrintedStage>> stages;
  for (int k = states - 1; k >= 0; --k) {
    std::vector<WallPair> here;
    for (const auto& [walls, at] : closest)
      if (at.state == k) here.push_back(walls);
    if (here.empty()) continue;
    if (stops()) return std::nullopt;
    auto stage = k == states - 1
                     ? std::move(fold)
                     : std::make_unique<PrintedStage>(linkage, std::move(*way(k)), options.planar);
    if (!stage->is_stable()) continue;
    stage->suspect(std::move(here), linkage.plates);
    stages.push_back(std::move(stage));
  }

  const auto touches = [&](const Matrix4Xd& errors) {
    return std::any_of(stages.begin(), stages.end(), [&](const std::unique_ptr<PrintedStage>& stage) {
      const State print = stage->print(errors);
      return std::any_of(stage->suspects.begin(), stage->suspects.end(),
                         [&](const WallPair& pair) { return suspects.overlap_in(print, pair); });
    });
  };
  PrintErrors errors(scatter, hinges, options.seed);
  TouchingPrints counted;
  while (counted.prints < most_prints &&
         (counted.prints == 0 || share_error(counted) > largest_share_error)) {
    if (stops()) break;
    for (int k = 0; k < prints_at_once; ++k) counted.touching += !stages.empty() && touches(errors.next());
    counted.prints += prints_at_once;
  }
  return counted.prints > 0 ? std::optional(counted) : std::nullopt;
}

}  // namespace kinetix::model
