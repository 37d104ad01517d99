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
// Of that distance: prints whose walls stay further apart to first order do not touch in their equilibrium either.
constexpr double apart_for_sure = 0.25;
constexpr double overlap_in_edges = 1e-9;  // cell edges, as in WallContact
constexpr int prints_at_once = 50, most_prints = 1000;
constexpr double largest_share_error = 0.016;

/// Plates that come close in a state.
struct SuspectPair {
  WallPair walls;
  double near_mm = 0;   ///< distance that the scatter of their bodies allows
  double nearness = 0;  ///< their gap over that distance, below 1
};

/// A state of the design in equilibrium, and its prints.
class PrintedStage {
 public:
  PrintedStage(const PrintedLinkage& printed, HeldState held, const AsMadeOptions& options)
      : state(std::move(held.state)),
        scene_{printed, std::move(held.elasticity), std::move(held.drive), options.planar},
        options_(options),
        theta_(scene_.drive.theta()),
        system_(scene_.system({})),
        tangent_(system_.dofs()) {
    system_.place(theta_, state);
    is_stable_ = settle(system_, theta_, state, tangent_);
    if (is_stable_) by_hinges_ = std::make_unique<DesignSensitivities>(system_, state, theta_, tangent_);
  }

  bool is_stable() const { return is_stable_; }
  /// To first order. @pre is_stable()
  VectorXd change(const Matrix4Xd& errors) const { return by_hinges_->change(errors); }
  State first_order(const Matrix4Xd& errors) const {
    return retract(system_.structure(), state, change(errors));
  }
  std::vector<PrintEquilibria::Print> equilibria(const std::vector<Matrix4Xd>& errors) {
    if (!equilibria_) equilibria_.emplace(scene_, state, prints_at_once, options_);
    return equilibria_->of(errors);
  }

  State state;
  std::vector<SuspectPair> suspects = {};

 private:
  PrintScene scene_;
  AsMadeOptions options_;
  double theta_;
  ElasticSystem system_;
  TangentStiffness tangent_;
  std::unique_ptr<DesignSensitivities> by_hinges_;
  std::optional<PrintEquilibria> equilibria_;
  bool is_stable_ = false;
};

/// Finds plates that come closer in a state than the scatter of their bodies.
class SuspectPlates {
 public:
  /// @param fold state of the fold   @param changes of it in some prints
  SuspectPlates(const Linkage& linkage, const State& fold, std::vector<VectorXd> changes,
                const HingeScatter& scatter)
      : edge_mm_(linkage.size.edge_mm),
        changes_(std::move(changes)),
        walls_(half_walls(linkage)),
        at_rest_(linkage),
        plates_of_(linkage.bodies.size()),
        reach_(linkage.bodies.size()) {
    const Matrix4Xd spread = scatter.by_hinge(static_cast<Eigen::Index>(linkage.hinges.size()));
    for (int k = 0; k < static_cast<int>(walls_.size()); ++k) {
      plates_of_[walls_[k].body].push_back(k);
      plate_scatter_.push_back(suspect_deviations * plate_scatter(linkage.size, spread.col(walls_[k].hinge)));
      double& reach = reach_[walls_[k].body];
      reach = std::max(reach, walls_[k].box.center.norm() + radius(walls_[k].box));
    }
    largest_plate_scatter_ = *std::max_element(plate_scatter_.begin(), plate_scatter_.end());
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
    for (const auto& [a, b] :
         near_.find(places, 2 * (farthest + suspect_deviations * moved_ + largest_plate_scatter_)))
      add(state, a, b, found);
    return found;
  }

  /// Whether plates come so near to each other in a print to first order that its equilibrium decides.
  bool may_touch(const State& print, const std::vector<SuspectPair>& suspects) const {
    return std::any_of(suspects.begin(), suspects.end(), [&](const SuspectPair& pair) {
      return separation(placed_wall(walls_, print, pair.walls.first),
                        placed_wall(walls_, print, pair.walls.second)) <= apart_for_sure * pair.near_mm;
    });
  }

  /// @param walls of the print
  bool touch(const State& print, const std::vector<HalfWall>& walls,
             const std::vector<SuspectPair>& suspects) const {
    return std::any_of(suspects.begin(), suspects.end(), [&](const SuspectPair& pair) {
      return overlap(placed_wall(walls, print, pair.walls.first),
                     placed_wall(walls, print, pair.walls.second), overlap_in_edges * edge_mm_);
    });
  }

  const std::vector<HalfWall>& walls() const { return walls_; }

 private:
  /// How far two bodies move apart at a point between them, mm, and turn against each other, rad: each the rms over prints.
  struct Scatter {
    Vector3d at = Vector3d::Zero();
    double shift = 0, turn = 0;

    double near(const Vector3d& place) const {
      return suspect_deviations * (shift + turn * (place - at).norm());
    }
  };

  static OrientedBox placed_wall(const std::vector<HalfWall>& walls, const State& state, int wall) {
    return placed(walls[wall], state[walls[wall].body]);
  }

  /// How far errors of its hinge move the rim of a plate on its body, mm, rms.
  static double plate_scatter(const CellSize& size, const Eigen::Vector4d& sd) {
    const double length = size.edge_mm, half_height = size.height_mm / 2;
    return sd.cwiseProduct(Eigen::Vector4d(length, half_height, half_height, length)).norm();
  }

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
    const double near = suspect_deviations * (apart.shift + apart.turn * reach) + 2 * largest_plate_scatter_;
    if ((state[a].p - state[b].p).norm() > reach + near) return;
    for (const int p : plates_of_[a])
      for (const int q : plates_of_[b]) add_walls({std::min(p, q), std::max(p, q)}, apart, found);
  }

  void add_walls(const WallPair& pair, const Scatter& apart, std::vector<SuspectPair>& found) const {
    if (walls_[pair.first].hinge == walls_[pair.second].hinge) return;
    const OrientedBox &first = boxes_[pair.first], &second = boxes_[pair.second];
    const double near = apart.near((first.center + second.center) / 2) + plate_scatter_[pair.first] +
                        plate_scatter_[pair.second];
    if ((first.center - second.center).norm() > radius(first) + radius(second) + near) return;
    const auto& left_out = at_rest_.touching_at_rest();
    if (std::binary_search(left_out.begin(), left_out.end(), pair)) return;
    if (const double gap = separation(first, second); gap <= near)
      found.push_back({pair, near, near > 0 ? gap / near : 0});
  }

  double edge_mm_;
  std::vector<VectorXd> changes_;
  std::vector<HalfWall> walls_;
  WallContact at_rest_;
  std::vector<std::vector<int>> plates_of_;  ///< each body
  std::vector<double> reach_;                ///< of each body's plates from its vertex, mm
  double moved_ = 0;                         ///< of any body in those prints, mm
  std::vector<double> plate_scatter_;        ///< of each plate on its body, as far as it counts, mm
  double largest_plate_scatter_ = 0;
  std::vector<OrientedBox> boxes_;  ///< of the state that is looked at
  NearPairs near_;
};

/// In which state of the way two plates come closest, against their scatter.
struct Closest {
  int state = 0;
  SuspectPair pair;
};

/// Stages of the way whose prints may touch, the fold first; nothing where the fold is not stable, and where it is told to stop.
class WayOfPrints {
 public:
  WayOfPrints(const PrintedLinkage& printed, int states,
              const std::function<std::optional<HeldState>(int)>& way, const HingeScatter& scatter,
              const AsMadeOptions& options)
      : printed_(printed), linkage_(printed({})), states_(states), way_(way), options_(options) {
    std::optional<HeldState> held = way(states - 1);
    if (!held) return;
    fold_ = std::make_unique<PrintedStage>(printed, std::move(*held), options);
    if (!fold_->is_stable()) return;
    PrintErrors first(scatter, hinges(), options.seed);
    std::vector<VectorXd> changes;
    for (int k = 0; k < scatter_prints; ++k) changes.push_back(fold_->change(first.next()));
    suspects_.emplace(linkage_, fold_->state, std::move(changes), scatter);
    is_found_ = find_closest() && find_stages();
  }

  bool is_found() const { return is_found_; }
  bool stops() const { return options_.stop && options_.stop(); }
  Eigen::Index hinges() const { return static_cast<Eigen::Index>(linkage_.hinges.size()); }

  /// How many of these prints touch; less once it is told to stop.
  int count(const std::vector<Matrix4Xd>& errors) {
    std::vector<bool> touches(errors.size(), false);
    for (const std::unique_ptr<PrintedStage>& stage : stages_) look(*stage, errors, touches);
    return static_cast<int>(std::count(touches.begin(), touches.end(), true));
  }

 private:
  bool find_closest() {
    for (int k = states_ - 1; k >= 0; --k) {
      if (stops()) return false;
      const std::optional<HeldState> held = k < states_ - 1 ? way_(k) : std::nullopt;
      if (k < states_ - 1 && (!held || !is_finite(held->state))) continue;
      for (const SuspectPair& found : suspects_->find(held ? held->state : fold_->state)) {
        const auto [at, is_new] = closest_.try_emplace(found.walls, Closest{k, found});
        if (!is_new && found.nearness < much_nearer * at->second.pair.nearness) at->second = {k, found};
      }
    }
    return true;
  }

  bool find_stages() {
    for (int k = states_ - 1; k >= 0; --k) {
      std::vector<SuspectPair> here;
      for (const auto& [walls, at] : closest_)
        if (at.state == k) here.push_back(at.pair);
      if (here.empty()) continue;
      if (stops()) return false;
      auto stage = k == states_ - 1 ? std::move(fold_)
                                    : std::make_unique<PrintedStage>(printed_, std::move(*way_(k)), options_);
      if (!stage->is_stable()) continue;
      stage->suspects = std::move(here);
      stages_.push_back(std::move(stage));
    }
    return true;
  }

  /// Prints that come near to first order are judged by their equilibrium; those that have none stay as they are to first order.
  void look(PrintedStage& stage, const std::vector<Matrix4Xd>& errors, std::vector<bool>& touches) {
    std::vector<std::size_t> near;
    std::vector<Matrix4Xd> near_errors;
    std::vector<State> first_orders;
    for (std::size_t k = 0; k < errors.size(); ++k) {
      if (touches[k]) continue;
      State print = stage.first_order(errors[k]);
      if (!suspects_->may_touch(print, stage.suspects)) continue;
      near.push_back(k);
      near_errors.push_back(errors[k]);
      first_orders.push_back(std::move(print));
    }
    if (near.empty()) return;
    const std::vector<PrintEquilibria::Print> prints = stage.equilibria(near_errors);
    for (std::size_t k = 0; k < near.size(); ++k)
      touches[near[k]] =
          prints[k].state
              ? suspects_->touch(*prints[k].state, half_walls(printed_(near_errors[k])), stage.suspects)
              : suspects_->touch(first_orders[k], suspects_->walls(), stage.suspects);
  }

  const PrintedLinkage& printed_;
  const Linkage linkage_;
  const int states_;
  const std::function<std::optional<HeldState>(int)>& way_;
  const AsMadeOptions options_;
  std::unique_ptr<PrintedStage> fold_;
  std::optional<SuspectPlates> suspects_;
  std::map<WallPair, Closest> closest_;
  std::vector<std::unique_ptr<PrintedStage>> stages_;
  bool is_found_ = false;
};

/// As if two more prints had been counted, one of which touches.
double share_error(const TouchingPrints& counted) {
  const double n = counted.prints + 2, share = (counted.touching + 1) / n;
  return std::sqrt(share * (1 - share) / n);
}

}  // namespace

std::optional<TouchingPrints> touching_prints(const PrintedLinkage& printed, int states,
                                              const std::function<std::optional<HeldState>(int)>& way,
                                              const HingeScatter& scatter, const AsMadeOptions& options) {
  WayOfPrints prints(printed, states, way, scatter, options);
  if (!prints.is_found()) return std::nullopt;
  PrintErrors errors(scatter, prints.hinges(), options.seed);
  TouchingPrints counted;
  while (counted.prints < most_prints &&
         (counted.prints == 0 || share_error(counted) > largest_share_error)) {
    std::vector<Matrix4Xd> next(prints_at_once);
    for (Matrix4Xd& of_print : next) of_print = errors.next();
    const int touching = prints.count(next);
    if (prints.stops()) break;
    counted.touching += touching;
    counted.prints += prints_at_once;
  }
  return counted.prints > 0 ? std::optional(counted) : std::nullopt;
}

}  // namespace kinetix::model
