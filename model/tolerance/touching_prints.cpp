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
  State print(const Matrix4Xd& errors) const { return retract(system_.structure(), state, change(errors)); }

  State state;
  std::vector<WallPair> suspects = {};

 private:
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
  /// @param fold state of the fold   @param changes of it in some prints
  SuspectPlates(const Linkage& linkage, const State& fold, std::vector<VectorXd> changes)
      : edge_mm_(linkage.size.edge_mm),
        changes_(std::move(changes)),
        walls_(half_walls(linkage)),
        at_rest_(linkage),
        plates_of_(linkage.bodies.size()),
        reach_(linkage.bodies.size()) {
    for (int k = 0; k < static_cast<int>(walls_.size()); ++k) {
      plates_of_[walls_[k].body].push_back(k);
      double& reach = reach_[walls_[k].body];
      reach = std::max(reach, walls_[k].box.center.norm() + radius(walls_[k].box));
    }
    for (int b = 0; b < static_cast<int>(fold.size()); ++b)
      for (const VectorXd& change : changes_)
        moved_ = std::max(moved_, shift(change, b, fold, fold[b].p).norm());
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
    const auto box = [&](int wall) { return placed(walls_[wall], state[walls_[wall].body]); };
    return overlap(box(pair.first), box(pair.second), overlap_in_edges * edge_mm_);
  }

 private:
  /// How far two bodies move apart at a point between them, mm, and turn against each other, rad: each the rms over prints.
  struct Scatter {
    Vector3d at = Vector3d::Zero();
    double shift = 0, turn = 0;

    double near(const Vector3d& place) const {
      return suspect_deviations * (shift + turn * (place - at).norm());
    }
  };

  /// Of a point that a body carries, mm.
  Vector3d shift(const VectorXd& change, int body, const State& state, const Vector3d& at) const {
    const Vector3d turn = change.segment<3>(6 * body);
    return edge_mm_ * change.segment<3>(6 * body + 3) + turn.cross(at - state[body].p);
  }

  Scatter scatter(const State& state, int a, int b) const {
    Scatter out{(state[a].p + state[b].p) / 2};
    for (const VectorXd& change : changes_) {
      out.shift += (shift(change, a, state, out.at) - shift(change, b, state, out.at)).squaredNorm();
      out.turn += (change.segment<3>(6 * a) - change.segment<3>(6 * b)).squaredNorm();
    }
    const auto count = static_cast<double>(changes_.size());
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

  double edge_mm_;
  std::vector<VectorXd> changes_;
  std::vector<HalfWall> walls_;
  WallContact at_rest_;
  std::vector<std::vector<int>> plates_of_;  ///< each body
  std::vector<double> reach_;                ///< of each body's plates from its vertex, mm
  double moved_ = 0;                         ///< of any body in those prints, mm
  std::vector<OrientedBox> boxes_;           ///< of the state that is looked at
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
  SuspectPlates suspects(linkage, fold->state, std::move(changes));

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
    stage->suspects = std::move(here);
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
