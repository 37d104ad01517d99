#include "model/tolerance/touching_prints.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "model/elastic/retract.hpp"
#include "model/tolerance/print_errors.hpp"
#include "model/tolerance/suspect_plates.hpp"

namespace kinetix::model {
namespace {

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
constexpr int prints_at_once = 50, most_prints = 1000;
constexpr double largest_share_error = 0.016;
constexpr double largest_relative_error = 0.05, of_large_sheets = 0.1;  // relative, of the share
// Total of hinges over all prints that are brought to equilibrium: each takes about 0.05 ms.
constexpr Eigen::Index most_hinges = 15000;
constexpr Eigen::Index least_equilibria = 20;  // fewer mean little: large sheets use first order only

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
class WayOfPrints {
 public:
  /// Keeps all parameters but `scatter` by reference.
  WayOfPrints(const PrintedLinkage& printed, const SettledDesign& fold, const MotionPath& way,
              const HingeScatter& scatter, const ToleranceOptions& options)
      : printed_(printed), fold_(fold), way_(way), options_(options) {
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
    std::vector<Look> looks;
    for (const Matrix4Xd& of_print : errors) looks.push_back(first_order(of_print));
    const std::vector<bool> settled = settle(errors, most, looks);
    if (stops()) return;
    for (std::size_t k = 0; k < looks.size(); ++k) {
      counted.prints += 1;
      counted.touching += looks[k].touches;
      if (k >= settled.size()) continue;
      counted.settled += 1;
      counted.gained += settled[k] && !looks[k].touches;
      counted.lost += !settled[k] && looks[k].touches;
    }
  }

  /// Returns the number of equilibria searched so far.
  int equilibria() const { return equilibria_; }

 private:
  /// First-order result of a print.
  struct Look {
    bool touches = false;
    std::vector<std::size_t> near =
        {};  ///< stages whose equilibrium decides, in order; empty if it surely touches
  };

  bool find_closest() {
    for (int k = way_.states; k >= 0; --k) {
      if (stops()) return false;
      const std::optional<HeldState> held = k < way_.states ? way_.at(k) : std::nullopt;
      if (k < way_.states && (!held || !is_finite(held->state))) continue;
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
    for (int k = way_.states; k >= 0; --k) {
      std::vector<SuspectPair> here;
      for (const auto& [walls, at] : closest_)
        if (at.state == k) here.push_back(at.pair);
      if (here.empty()) continue;
      if (stops()) return false;
      if (k < way_.states) {
        auto before = std::make_unique<SettledDesign>(fold_.system().structure(), std::move(*way_.at(k)),
                                                      options_.planar);
        if (!before->is_stable()) continue;
        before_.push_back(std::move(before));
      }
      stages_.emplace_back(printed_, k < way_.states ? *before_.back() : fold_, here, suspects_->walls(),
                           options_);
    }
    return true;
  }

  Look first_order(const Matrix4Xd& errors) const {
    Look out;
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
  std::vector<bool> settle(const std::vector<Matrix4Xd>& errors, int most, const std::vector<Look>& looks) {
    std::vector<bool> out;
    for (const Look& look : looks) {
      most -= static_cast<int>(look.near.size());
      if (most < 0) break;
      out.push_back(look.near.empty() && look.touches);
    }
    for (std::size_t s = 0; s < stages_.size(); ++s) {
      std::vector<std::size_t> here;
      std::vector<Matrix4Xd> own;
      for (std::size_t k = 0; k < out.size(); ++k)
        if (!out[k] && std::count(looks[k].near.begin(), looks[k].near.end(), s) > 0) {
          here.push_back(k);
          own.push_back(errors[k]);
        }
      if (here.empty()) continue;
      equilibria_ += static_cast<int>(here.size());
      const std::vector<PrintEquilibria::Print> prints = stages_[s].equilibria(own);
      for (std::size_t k = 0; k < here.size(); ++k)
        out[here[k]] = prints[k].state ? suspects_->touch(*prints[k].state, half_walls(printed_(own[k])),
                                                          stages_[s].suspects())
                                       : looks[here[k]].touches;
    }
    return out;
  }

  const PrintedLinkage& printed_;
  const SettledDesign& fold_;
  const MotionPath& way_;
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
                                              const MotionPath& way, const HingeScatter& scatter,
                                              const ToleranceOptions& options) {
  if (!fold.is_stable()) return std::nullopt;
  WayOfPrints prints(printed, fold, way, scatter, options);
  if (!prints.is_found()) return std::nullopt;
  PrintErrors errors(scatter, prints.hinges(), options.seed);
  TouchingPrints counted;
  const Eigen::Index afforded = most_hinges / prints.hinges();
  const int most = afforded >= least_equilibria ? static_cast<int>(afforded) : 0;
  while (counted.prints < most_prints &&
         (counted.prints == 0 || !are_enough(counted, most > 0 ? largest_relative_error : of_large_sheets))) {
    std::vector<Matrix4Xd> next(prints_at_once);
    for (Matrix4Xd& of_print : next) of_print = errors.next();
    const bool are_all = counted.settled == counted.prints;
    prints.count(next, are_all ? most - prints.equilibria() : -1, counted);
    if (prints.stops()) break;
  }
  return counted.prints > 0 ? std::optional(counted) : std::nullopt;
}

}  // namespace kinetix::model
