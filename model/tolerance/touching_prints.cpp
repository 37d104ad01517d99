#include "model/tolerance/touching_prints.hpp"

#include <deque>

#include "model/closure/closure.hpp"

namespace kinetix::model {
namespace {

/// Two plates that are close in a state.
struct SuspectPair {
  WallPair walls;
  double near_mm = 0;   ///< distance that the scatter of their bodies allows
  double nearness = 0;  ///< ratio: their gap over that distance, below 1
};

/// Search for plates that are closer in a state than the scatter of their bodies.
class SuspectPlates {
 public:
  /// @param changes of the fold's state in some prints, as from DesignSensitivities::change
  SuspectPlates(const Linkage& linkage, const std::vector<Eigen::VectorXd>& changes,
                const HingeScatter& scatter);

  std::vector<SuspectPair> find(const State& state);

  /// Returns whether two suspects are closer in a print than `share` times the distance that their scatter
  /// allows. A negative share tests whether they overlap deeper than that.
  /// @param walls of the print
  bool are_nearer(const State& print, const std::vector<HalfWall>& walls,
                  const std::vector<SuspectPair>& suspects, double share) const;
  /// Returns whether two suspects overlap in a print. @param walls of the print
  bool touch(const State& print, const std::vector<HalfWall>& walls,
             const std::vector<SuspectPair>& suspects) const;

  /// Returns the half walls of the design.
  const std::vector<HalfWall>& walls() const { return walls_; }

 private:
  /// Motion of a body from the design to a print.
  struct Motion {
    Eigen::Vector3d turn;   // rad
    Eigen::Vector3d shift;  // of its vertex, mm

    /// Returns the shift of a point that the body carries, mm. @param from the body's vertex to the point, mm
    Eigen::Vector3d at(const Eigen::Vector3d& from) const { return shift + turn.cross(from); }
  };

  /// Rms over prints of the relative motion of two bodies: shift (mm) at a point between them, and turn
  /// (rad).
  struct Scatter {
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    double shift = 0, turn = 0;

    double near(const Eigen::Vector3d& place) const;
  };

  Scatter scatter(const State& state, int a, int b) const;
  void add(const State& state, int a, int b, std::vector<SuspectPair>& found) const;
  void add_walls(const WallPair& pair, const Scatter& apart, std::vector<SuspectPair>& found) const;

  double depth_mm_;
  std::vector<HalfWall> walls_;
  WallContact at_rest_;
  std::vector<std::vector<int>> plates_of_;   ///< of each body
  std::vector<double> reach_;                 ///< of each body's plates from its vertex, mm
  std::vector<std::vector<Motion>> motions_;  ///< of each body in the sample prints
  double moved_ = 0;                          ///< largest shift of any body, mm
  std::vector<double> plate_scatter_;         ///< of each plate on its body, times suspect_deviations, mm
  double largest_plate_scatter_ = 0;
  std::vector<OrientedBox> boxes_;  ///< of the state that is searched
  NearPairs near_;
};

using Eigen::Vector3d;

// Multiple of the rms scatter over all directions. Of plates further apart, about one in 1000 prints touches.
// This includes the case that the sample prints show a fifth too little scatter.
constexpr double suspect_deviations = 4;
constexpr double overlap_in_edges = 1e-9;  // cell edges, as in WallContact

/// Returns the rms shift of the rim of a plate because of the errors of its hinge, mm.
double plate_scatter(const CellSize& size, const Eigen::Vector4d& sd) {
  const double length = size.edge_mm, half_height = size.height_mm / 2;
  return sd.cwiseProduct(Eigen::Vector4d(length, half_height, half_height, length)).norm();
}

/// Calls `look` with the boxes of those pairs that are closer than `within` of the pair, until it returns
/// true.
/// @return whether it did
template <class Within, class Test>
bool any_pair(const State& print, const std::vector<HalfWall>& walls,
              const std::vector<SuspectPair>& suspects, const Within& within, const Test& test) {
  return std::any_of(suspects.begin(), suspects.end(), [&](const SuspectPair& pair) {
    const HalfWall &first = walls[pair.walls.first], &second = walls[pair.walls.second];
    const Pose &a = print[first.body], &b = print[second.body];
    const Vector3d apart = b.p + b.R * second.box.center - a.p - a.R * first.box.center;
    const double near = within(pair);
    if (apart.norm() > radius(first.box) + radius(second.box) + near) return false;
    return test(pair, placed(first, a), placed(second, b));
  });
}

double SuspectPlates::Scatter::near(const Vector3d& place) const {
  return suspect_deviations * (shift + turn * (place - at).norm());
}

SuspectPlates::SuspectPlates(const Linkage& linkage, const std::vector<Eigen::VectorXd>& changes,
                             const HingeScatter& scatter)
    : depth_mm_(overlap_in_edges * linkage.size.edge_mm),
      walls_(half_walls(linkage)),
      at_rest_(linkage),
      plates_of_(linkage.bodies.size()),
      reach_(linkage.bodies.size()) {
  const Eigen::Matrix4Xd spread = scatter.by_hinge(static_cast<Eigen::Index>(linkage.hinges.size()));
  for (int k = 0; k < static_cast<int>(walls_.size()); ++k) {
    plates_of_[walls_[k].body].push_back(k);
    plate_scatter_.push_back(suspect_deviations * plate_scatter(linkage.size, spread.col(walls_[k].hinge)));
    largest_plate_scatter_ = std::max(largest_plate_scatter_, plate_scatter_.back());
    double& reach = reach_[walls_[k].body];
    reach = std::max(reach, walls_[k].box.center.norm() + radius(walls_[k].box));
  }
  for (int b = 0; b < static_cast<int>(linkage.bodies.size()); ++b) {
    motions_.emplace_back();
    for (const Eigen::VectorXd& change : changes) {
      const Motion motion{change.segment<3>(6 * b), linkage.size.edge_mm * change.segment<3>(6 * b + 3)};
      motions_.back().push_back(motion);
      moved_ = std::max(moved_, motion.shift.norm());
    }
  }
}

std::vector<SuspectPair> SuspectPlates::find(const State& state) {
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

bool SuspectPlates::are_nearer(const State& print, const std::vector<HalfWall>& walls,
                               const std::vector<SuspectPair>& suspects, double share) const {
  return any_pair(
      print, walls, suspects, [&](const SuspectPair& pair) { return std::max(share * pair.near_mm, 0.0); },
      [&](const SuspectPair& pair, const OrientedBox& a, const OrientedBox& b) {
        return overlap(a, b, -share * pair.near_mm);
      });
}

bool SuspectPlates::touch(const State& print, const std::vector<HalfWall>& walls,
                          const std::vector<SuspectPair>& suspects) const {
  return any_pair(
      print, walls, suspects, [](const SuspectPair&) { return 0.0; },
      [&](const SuspectPair&, const OrientedBox& a, const OrientedBox& b) {
        return overlap(a, b, depth_mm_);
      });
}

SuspectPlates::Scatter SuspectPlates::scatter(const State& state, int a, int b) const {
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

void SuspectPlates::add(const State& state, int a, int b, std::vector<SuspectPair>& found) const {
  const Scatter apart = scatter(state, a, b);
  const double reach = reach_[a] + reach_[b];
  const double near = suspect_deviations * (apart.shift + apart.turn * reach) + 2 * largest_plate_scatter_;
  if ((state[a].p - state[b].p).norm() > reach + near) return;
  for (const int p : plates_of_[a])
    for (const int q : plates_of_[b]) add_walls({std::min(p, q), std::max(p, q)}, apart, found);
}

void SuspectPlates::add_walls(const WallPair& pair, const Scatter& apart,
                              std::vector<SuspectPair>& found) const {
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

using Eigen::Matrix4Xd;
using Eigen::VectorXd;

constexpr int scatter_prints = 16;  // sample for the scatter of two bodies
// Ratio to the nearness of two plates in the fold: a state before it counts only if they are this much
// nearer.
constexpr double much_nearer = 0.8;
// In units of nearness. Plates that are further apart than the nearest pair by two deviations are left out.
// They touch in few prints in which the nearest pair does not.
constexpr double less_near = 0.5;
// Fraction of the distance that scatter allows. Within it the first-order result is uncertain, and the
// equilibrium of a print decides. In 700 prints of a ring and a disc the equilibrium decided from 0 to -0.06.
constexpr double unsure = 0.1;
constexpr double worth_checking = 0.2;  // the same, with the design's walls, which move with errors
constexpr int prints_at_once = 50, max_prints = 1000;
constexpr double largest_share_error = 0.016;
constexpr double largest_relative_error = 0.05, of_large_sheets = 0.1;  // relative, of the share
// Total of hinges over all prints that are brought to equilibrium: each takes about 0.05 ms.
constexpr Eigen::Index max_hinges = 15000;
constexpr Eigen::Index min_equilibria = 20;  // fewer mean little: large sheets use first order only

/// State of the design in equilibrium, with its prints.
class PrintedStage {
 public:
  /// @param printed, design kept by reference
  PrintedStage(const PrintedLinkage& printed, const SettledDesign& design,
               const std::vector<SuspectPair>& suspects, const std::vector<HalfWall>& walls,
               const ToleranceOptions& options)
      : printed_(printed), design_(design), suspects_(suspects), options_(options) {
    for (const SuspectPair& pair : suspects)
      for (const int wall : {pair.walls.first, pair.walls.second}) bodies_.push_back(walls[wall].body);
    std::sort(bodies_.begin(), bodies_.end());
    bodies_.erase(std::unique(bodies_.begin(), bodies_.end()), bodies_.end());
  }

  const std::vector<SuspectPair>& suspects() const { return suspects_; }

  /// Returns the state with the bodies of the suspects moved as in a print with these errors, to first order.
  /// All other bodies stay.
  State first_order(const Matrix4Xd& errors) const {
    const VectorXd all = design_.change(errors);
    State looked_at;
    VectorXd twists(6 * static_cast<Eigen::Index>(bodies_.size()));
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      looked_at.push_back(design_.state()[bodies_[k]]);
      twists.segment<6>(6 * k) = all.segment<6>(6 * bodies_[k]);
    }
    looked_at = retract(design_.system().structure(), looked_at, twists);
    State out = design_.state();
    for (std::size_t k = 0; k < bodies_.size(); ++k) out[bodies_[k]] = looked_at[k];
    return out;
  }

  std::vector<PrintEquilibria::Print> equilibria(const std::vector<Matrix4Xd>& errors) {
    if (!equilibria_)
      equilibria_.emplace(PrintScene{printed_, design_.elasticity(), design_.drive(), options_.planar},
                          design_.state(), prints_at_once, options_);
    return equilibria_->of(errors);
  }

 private:
  const PrintedLinkage& printed_;
  const SettledDesign& design_;
  const std::vector<SuspectPair> suspects_;
  const ToleranceOptions& options_;
  std::vector<int> bodies_;  ///< of the suspects, ascending
  std::optional<PrintEquilibria> equilibria_;
};

/// State of the path in which two plates are closest, relative to their scatter.
struct Closest {
  int state = 0;
  SuspectPair pair;
};

/// States of the path whose prints may touch, the fold first.
class PrintMotionCheck {
 public:
  /// Keeps all parameters but `scatter` by reference.
  PrintMotionCheck(const PrintedLinkage& printed, const SettledDesign& fold, const MotionPath& motion,
                   const HingeScatter& scatter, const ToleranceOptions& options)
      : printed_(printed), fold_(fold), motion_(motion), options_(options) {
    PrintErrors first(scatter, hinges(), options.seed);
    std::vector<VectorXd> changes;
    for (int k = 0; k < scatter_prints; ++k) changes.push_back(fold.change(first.next()));
    suspects_.emplace(fold.system().structure(), changes, scatter);
    is_found_ = find_closest() && find_stages();
  }

  /// Returns false if the search was stopped.
  bool is_found() const { return is_found_; }
  bool stops() const { return options_.stop && options_.stop(); }
  Eigen::Index hinges() const { return static_cast<Eigen::Index>(fold_.system().hinges().size()); }

  /// Counts prints that touch. @param most limit of equilibria to search: the first prints have them
  void count(const std::vector<Matrix4Xd>& errors, int most, TouchingPrints& counted) {
    std::vector<FirstOrderResult> first_order_results;
    for (const Matrix4Xd& of_print : errors) first_order_results.push_back(first_order(of_print));
    const std::vector<bool> settled = settle(errors, most, first_order_results);
    if (stops()) return;
    for (std::size_t k = 0; k < first_order_results.size(); ++k) {
      counted.prints += 1;
      counted.touching += first_order_results[k].touches;
      if (k >= settled.size()) continue;
      counted.settled += 1;
      counted.gained += settled[k] && !first_order_results[k].touches;
      counted.lost += !settled[k] && first_order_results[k].touches;
    }
  }

  /// Returns the number of equilibria searched so far.
  int equilibria() const { return equilibria_; }

 private:
  /// First-order result of a print.
  struct FirstOrderResult {
    bool touches = false;
    std::vector<std::size_t> near =
        {};  ///< stages whose equilibrium decides, in order; empty if it surely touches
  };

  bool find_closest() {
    for (int k = motion_.states; k >= 0; --k) {
      if (stops()) return false;
      const std::optional<HeldState> held = k < motion_.states ? motion_.at(k) : std::nullopt;
      if (k < motion_.states && (!held || !is_finite(held->state))) continue;
      for (const SuspectPair& found : suspects_->find(held ? held->state : fold_.state())) {
        const auto [at, is_new] = closest_.try_emplace(found.walls, Closest{k, found});
        if (!is_new && found.nearness < much_nearer * at->second.pair.nearness) at->second = {k, found};
      }
    }
    double least = INFINITY;
    for (const auto& [walls, at] : closest_) least = std::min(least, at.pair.nearness);
    std::erase_if(closest_, [&](const auto& at) { return at.second.pair.nearness > least + less_near; });
    return true;
  }

  bool find_stages() {
    for (int k = motion_.states; k >= 0; --k) {
      std::vector<SuspectPair> here;
      for (const auto& [walls, at] : closest_)
        if (at.state == k) here.push_back(at.pair);
      if (here.empty()) continue;
      if (stops()) return false;
      if (k < motion_.states) {
        auto before = std::make_unique<SettledDesign>(fold_.system().structure(), std::move(*motion_.at(k)),
                                                      options_.planar);
        if (!before->is_stable()) continue;
        before_.push_back(std::move(before));
      }
      stages_.emplace_back(printed_, k < motion_.states ? *before_.back() : fold_, here, suspects_->walls(),
                           options_);
    }
    return true;
  }

  FirstOrderResult first_order(const Matrix4Xd& errors) const {
    FirstOrderResult out;
    std::optional<std::vector<HalfWall>> walls;
    for (std::size_t s = 0; s < stages_.size(); ++s) {
      const auto& suspects = stages_[s].suspects();
      const State print = stages_[s].first_order(errors);
      if (!suspects_->are_nearer(print, suspects_->walls(), suspects, worth_checking)) continue;
      if (!walls) walls = half_walls(printed_(errors));
      if (suspects_->are_nearer(print, *walls, suspects, -unsure)) return {true};
      if (!suspects_->are_nearer(print, *walls, suspects, unsure)) continue;
      out.touches = out.touches || suspects_->touch(print, *walls, suspects);
      out.near.push_back(s);
    }
    return out;
  }

  /// Returns whether the first of these prints touch in equilibrium, for as many prints as `most` equilibria
  /// can decide. If a print has no equilibrium, its first-order result counts.
  std::vector<bool> settle(const std::vector<Matrix4Xd>& errors, int most,
                           const std::vector<FirstOrderResult>& first_order_results) {
    std::vector<bool> out;
    for (const FirstOrderResult& result : first_order_results) {
      most -= static_cast<int>(result.near.size());
      if (most < 0) break;
      out.push_back(result.near.empty() && result.touches);
    }
    for (std::size_t s = 0; s < stages_.size(); ++s) {
      std::vector<std::size_t> here;
      std::vector<Matrix4Xd> own;
      for (std::size_t k = 0; k < out.size(); ++k)
        if (!out[k] &&
            std::count(first_order_results[k].near.begin(), first_order_results[k].near.end(), s) > 0) {
          here.push_back(k);
          own.push_back(errors[k]);
        }
      if (here.empty()) continue;
      equilibria_ += static_cast<int>(here.size());
      const std::vector<PrintEquilibria::Print> prints = stages_[s].equilibria(own);
      for (std::size_t k = 0; k < here.size(); ++k)
        out[here[k]] = prints[k].state ? suspects_->touch(*prints[k].state, half_walls(printed_(own[k])),
                                                          stages_[s].suspects())
                                       : first_order_results[here[k]].touches;
    }
    return out;
  }

  const PrintedLinkage& printed_;
  const SettledDesign& fold_;
  const MotionPath& motion_;
  const ToleranceOptions& options_;
  std::optional<SuspectPlates> suspects_;
  std::map<WallPair, Closest> closest_;
  std::vector<std::unique_ptr<SettledDesign>> before_;
  std::deque<PrintedStage> stages_;
  int equilibria_ = 0;
  bool is_found_ = false;
};

/// Returns the variance of a share, estimated as if two more prints had been counted and one of them counts.
double share_variance(double some, double all) {
  const double share = (some + 1) / (all + 2);
  return share * (1 - share);
}

/// Returns whether the first-order share is accurate enough.
bool are_enough(const TouchingPrints& counted, double relative_error) {
  const double error = std::sqrt(share_variance(counted.touching, counted.prints) / (counted.prints + 2));
  return error <= std::max(largest_share_error, relative_error * counted.share());
}

}  // namespace

double TouchingPrints::share() const {
  const double more = settled > 0 ? static_cast<double>(gained - lost) / settled : 0;
  return std::clamp(static_cast<double>(touching) / prints + more, 0.0, 1.0);
}

double TouchingPrints::error() const {
  if (settled == prints) return std::sqrt(share_variance(touching + gained - lost, prints) / (prints + 2));
  const double first = share_variance(touching, prints) / (prints + 2);
  if (settled == 0) return std::sqrt(first);
  return std::sqrt(first + share_variance(gained + lost, settled) / (settled + 2));
}

std::optional<TouchingPrints> touching_prints(const PrintedLinkage& printed, const SettledDesign& fold,
                                              const MotionPath& motion, const HingeScatter& scatter,
                                              const ToleranceOptions& options) {
  if (!fold.is_stable()) return std::nullopt;
  PrintMotionCheck prints(printed, fold, motion, scatter, options);
  if (!prints.is_found()) return std::nullopt;
  PrintErrors errors(scatter, prints.hinges(), options.seed);
  TouchingPrints counted;
  const Eigen::Index afforded = max_hinges / prints.hinges();
  const int most = afforded >= min_equilibria ? static_cast<int>(afforded) : 0;
  while (counted.prints < max_prints &&
         (counted.prints == 0 || !are_enough(counted, most > 0 ? largest_relative_error : of_large_sheets))) {
    std::vector<Matrix4Xd> next(prints_at_once);
    for (Matrix4Xd& of_print : next) of_print = errors.next();
    const bool are_all = counted.settled == counted.prints && counted.prints < options.most_settled;
    prints.count(next, are_all && most > 0 ? most - prints.equilibria() : -1, counted);
    if (prints.stops()) break;
  }
  return counted.prints > 0 ? std::optional(counted) : std::nullopt;
}

}  // namespace kinetix::model
