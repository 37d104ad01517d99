#include "optim/fold/fit_fold.hpp"

#include <fmt/format.h>

#include "model/base/invalid_input.hpp"
#include "model/lattice/planar/planar_motion.hpp"
#include "optim/fold/folded_net.hpp"

namespace kinetix::optim {
namespace {

// 22.5 deg per column: each finer choice widens the nets and needs one more search of all unfoldings.
constexpr int max_columns_per_right_angle = 4;
// Rad, precision of the largest free theta. More precision gains little theta, and each halving needs one
// more motion.
constexpr double precision = 0.25 * radians_per_degree;
// Rad: tan(turn / 2), and with it the needed tilt, has no value at 180 deg.
constexpr double max_turn_per_column = 179 * radians_per_degree;

/// Returns the columns of all creases. Unless the goal gives them, no column turns more than a right angle
/// over `finer`.
std::vector<int> columns_of(const targets::FoldNet& net, int finer) {
  std::vector<int> columns;
  for (const targets::FoldCrease& crease : net.creases) {
    const int needed = static_cast<int>(std::ceil(std::abs(crease.angle) * finer / (pi / 2) - 1e-9));
    columns.push_back(crease.columns > 0 ? crease.columns
                                         : std::clamp(needed, 1, targets::max_crease_columns));
  }
  return columns;
}

bool all_columns_are_given(const targets::FoldNet& net) {
  return std::all_of(net.creases.begin(), net.creases.end(),
                     [](const targets::FoldCrease& crease) { return crease.columns > 0; });
}

double turn_per_column(const targets::FoldNet& net, const std::vector<int>& columns, std::size_t crease) {
  return std::abs(net.creases[crease].angle) / columns[crease];
}

std::size_t steepest_crease(const targets::FoldNet& net, const std::vector<int>& columns) {
  std::size_t steepest = 0;
  for (std::size_t c = 1; c < columns.size(); ++c)
    if (turn_per_column(net, columns, c) > turn_per_column(net, columns, steepest)) steepest = c;
  return steepest;
}

constexpr const char* stopped_reason = "the search was stopped";

/// Reason why a net with given columns does not fold.
struct Obstacle {
  std::string why;
  bool everywhere = false;  ///< the same near any crease: another unfolding would not help
  double share = 0;         ///< free share of the path to theta
};

class NetSearch {
 public:
  NetSearch(const targets::FoldGoal& goal, const FoldOptions& options, const Progress& progress)
      : goal_(goal), options_(options), progress_(progress) {
    upper_ = std::min(options.theta.upper, closing_theta(options.size) - model::closing_margin);
  }

  FoldDesign run() {
    if (!(upper_ > options_.theta.lower))
      throw InvalidInput(
          fmt::format("walls of {:.3g} mm in cells of {:.3g} mm close at {:.3g} deg, below the range of the "
                      "fold angle. Give thinner walls or smaller angles",
                      options_.size.thickness_mm, options_.size.edge_mm, to_degrees(upper_)));
    const int finest = all_columns_are_given(goal_.nets[0]) ? 1 : max_columns_per_right_angle;
    for (int finer = 1; finer <= finest && !design_.folds && !options_.stop.stop_requested(); ++finer)
      try_all(finer);
    design_.stopped = !design_.folds && options_.stop.stop_requested();
    if (design_.stopped && design_.obstacles.empty()) add_obstacle(stopped_reason);
    if (!design_.folds) choose_nearest(finest);
    return std::move(design_);
  }

 private:
  void try_all(int finer) {
    const int count = static_cast<int>(goal_.nets.size());
    for (int k = 0; k < count; ++k) {
      progress_("search", static_cast<double>(k) / count,
                fmt::format("unfolding {} of {}, best without contact to {:.0f} % of its motion", k + 1,
                            count, 100 * best_share_));
      const std::vector<int> columns = columns_of(goal_.nets[k], finer);
      const std::optional<Obstacle> obstacle = try_net(k, columns);
      design_.attempts.push_back({k, columns, obstacle ? obstacle->why : ""});
      if (!obstacle) return;
      best_share_ = std::max(best_share_, obstacle->share);
      add_obstacle(obstacle->why);
      if (obstacle->everywhere || options_.stop.stop_requested()) return;
    }
  }

  void add_obstacle(const std::string& why) {
    auto& all = design_.obstacles;
    if (std::find(all.begin(), all.end(), why) == all.end()) all.push_back(why);
  }

  std::optional<Obstacle> try_net(int index, const std::vector<int>& columns) {
    const targets::FoldNet& net = goal_.nets[index];
    const std::size_t c = steepest_crease(net, columns);
    const double turn = columns.empty() ? 0 : turn_per_column(net, columns, c);
    if (turn > max_turn_per_column) return too_steep(net, columns, c, pi / 2);
    const double least = model::theta_of_turn(turn, options_.tilt);
    const double lower = std::max(options_.theta.lower, least);
    if (!(lower < upper_) || turn > model::crease_turn(options_.tilt, upper_))
      return too_steep(net, columns, c, model::tilt_of_turn(turn, upper_));
    try {
      return try_between(index, columns, lower);
    } catch (const InvalidInput& e) {
      return Obstacle{fmt::format("with {} columns in its widest crease: {}",
                                  *std::max_element(columns.begin(), columns.end()), e.reason())};
    }
  }

  Obstacle too_steep(const targets::FoldNet& net, const std::vector<int>& columns, std::size_t c,
                     double tilt) const {
    return {fmt::format("crease `{}` of {} needs tilts of {:.1f} deg even at fold angle {:.1f} deg, and the "
                        "limit is {:.1f} deg. Give it more columns",
                        crease_name(net, net.creases[c]), columns_text(columns[c]), to_degrees(tilt),
                        to_degrees(upper_), to_degrees(options_.tilt)),
            true};
  }

  static std::string columns_text(int columns) {
    return columns == 1 ? "one column" : fmt::format("{} columns", columns);
  }

  FoldedNet folded(int index, const std::vector<int>& columns, double theta) const {
    return fold_to(goal_.nets[index], columns, theta, options_.size, options_.tilt);
  }

  /// Finds the largest free theta. Both steep tilts at small theta and gentle ones at large theta can
  /// collide.
  std::optional<Obstacle> try_between(int index, const std::vector<int>& columns, double lower) {
    std::vector<Blocked> blocked;
    const int steps = static_cast<int>(std::ceil((upper_ - lower) / sample_step));
    for (int k = steps; k >= 0; --k) {
      if (options_.stop.stop_requested()) return Obstacle{stopped_reason, false, 0};
      FoldedNet net = folded(index, columns, lower + (upper_ - lower) * k / steps);
      const auto share = blocked_share(net);
      if (!share) return accept(index, refined(index, columns, std::move(net), k < steps));
      blocked.push_back({net.theta, *share});
    }
    return farthest(index, columns, std::move(blocked));
  }

  /// A blocked motion, and a share of its path at which it is known to be blocked.
  struct Blocked {
    double theta, share;
  };

  /// Returns the obstacle of the motion that is free for the largest share of its path.
  Obstacle farthest(int index, const std::vector<int>& columns, std::vector<Blocked> blocked) const {
    // Ties start with the least theta: an obstacle at one common theta is then at the largest share of the
    // path.
    std::sort(blocked.begin(), blocked.end(), [](const Blocked& a, const Blocked& b) {
      return std::pair(-a.share, a.theta) < std::pair(-b.share, b.theta);
    });
    Obstacle out = first_obstacle(folded(index, columns, blocked.front().theta));
    for (std::size_t k = 1; k < blocked.size() && blocked[k].share > out.share; ++k) {
      const FoldedNet net = folded(index, columns, blocked[k].theta);
      if (is_free_to(net, out.share)) out = first_obstacle(net);
    }
    return out;
  }

  /// Returns whether the path is free up to this share. Checks backwards from there, since an obstacle mostly
  /// stays in the way.
  bool is_free_to(const FoldedNet& net, double share) const {
    MotionOverlapSearch overlaps = overlap_search(net);
    if (!overlaps.touching_at_rest().empty()) return false;
    std::vector<double> thetas = sample_thetas(net.theta);
    std::erase_if(thetas, [&](double theta) { return theta / net.theta > share; });
    std::reverse(thetas.begin(), thetas.end());
    return !overlaps.first_overlap(thetas);
  }

  /// Increases theta a little, as long as the motion is free.
  FoldedNet refined(int index, const std::vector<int>& columns, FoldedNet best, bool blocked_beyond) {
    double blocked = blocked_beyond ? best.theta + sample_step : best.theta;
    while (blocked - best.theta > precision && !options_.stop.stop_requested()) {
      FoldedNet middle = folded(index, columns, (best.theta + blocked) / 2);
      if (blocked_share(middle))
        blocked = middle.theta;
      else
        best = std::move(middle);
    }
    return best;
  }

  std::optional<Obstacle> accept(int index, FoldedNet best) {
    if (const auto crossing = first_face_crossing(best))
      return Obstacle{
          fmt::format("faces `{}` and `{}` cross during the motion, at a fold angle of {:.1f} of {:.1f} deg",
                      best.net.faces[crossing->first].name, best.net.faces[crossing->second].name,
                      to_degrees(crossing->theta), to_degrees(best.theta))};
    design_.folded = std::move(best);
    design_.net = index;
    design_.folds = true;
    design_.obstacles.clear();
    return std::nullopt;
  }

  MotionOverlapSearch overlap_search(const FoldedNet& net) const {
    return {net.structure, options_.clearance,
            [&net](double theta) { return fold_net(net.tree, net.structure, theta); }, options_.threads};
  }

  /// Returns a share of the path at which walls overlap, or nullopt if it is free. Checks backwards from the
  /// end, where most walls meet.
  std::optional<double> blocked_share(const FoldedNet& net) {
    ++design_.evaluations;
    MotionOverlapSearch overlaps = overlap_search(net);
    if (!overlaps.touching_at_rest().empty()) return 0;
    std::vector<double> thetas = sample_thetas(net.theta);
    std::reverse(thetas.begin(), thetas.end());
    const auto overlap = overlaps.first_overlap(thetas);
    if (!overlap) return std::nullopt;
    return thetas[overlap->sample] / net.theta;
  }

  /// Returns the first obstacle of a motion. @pre the motion is blocked
  Obstacle first_obstacle(const FoldedNet& net) const {
    MotionOverlapSearch overlaps = overlap_search(net);
    if (!overlaps.touching_at_rest().empty()) return described(net, overlaps.touching_at_rest().front(), 0);
    const std::vector<double> thetas = sample_thetas(net.theta);
    const auto overlap = overlaps.first_overlap(thetas);
    return described(net, overlap.value().pair, thetas[overlap->sample]);
  }

  static std::string described(double theta, double needed) {
    if (!(theta > 0)) return "touch when flat";
    if (!(theta < needed))
      return fmt::format("run into each other as the fold closes, at a fold angle of {:.2f} deg",
                         to_degrees(theta));
    return fmt::format("run into each other at a fold angle of {:.2f} deg; the fold needs {:.2f} deg",
                       to_degrees(theta), to_degrees(needed));
  }

  static Obstacle described(const FoldedNet& net, const model::WallPair& pair, double theta) {
    const std::vector<int> parts = parts_of_bodies(net);
    const auto part = [&](int half) {
      const model::Hinge& hinge = net.structure.hinges[half / 2];
      return parts[half % 2 == 0 ? hinge.lower : hinge.upper];
    };
    const int a = part(pair.first), b = part(pair.second);
    const std::string who = a == b ? "of " + part_name(net.net, a)
                                   : "of " + part_name(net.net, a) + " and " + part_name(net.net, b);
    const int columns = net.layout.creases.empty() ? 1 : net.layout.creases[0].columns();
    const std::string when = described(theta, net.theta);
    return {fmt::format("with {} per crease, walls {} {}", columns_text(columns), who, when),
            beside_one_crease(net.net, a, b), theta / net.theta};
  }

  static bool beside_one_crease(const targets::FoldNet& net, int a, int b) {
    const int faces = static_cast<int>(net.faces.size());
    for (int c = 0; c < static_cast<int>(net.creases.size()); ++c) {
      const auto near = [&](int part) {
        return part == net.creases[c].first || part == net.creases[c].second || part == faces + c;
      };
      if (near(a) && near(b)) return true;
    }
    return a == b;
  }

  /// Keeps a design to show if none folds: the first unfolding, with the most columns with which it can be
  /// laid out.
  void choose_nearest(int finest) {
    for (int finer = finest; finer >= 1; --finer) try {
        design_.folded = folded(0, columns_of(goal_.nets[0], finer), upper_);
        return;
      } catch (const InvalidInput&) {
        if (finer == 1) throw;
      }
  }

  const targets::FoldGoal& goal_;
  const FoldOptions& options_;
  const Progress& progress_;
  double upper_ = 0, best_share_ = 0;
  FoldDesign design_;
};

}  // namespace

void FoldOptions::validate() const {
  if (!(tilt > 0 && tilt < pi / 2))
    throw InvalidInput(fmt::format("tilt is {} rad, must be in (0, pi/2)", tilt));
  if (!(0 < theta.lower && theta.lower < theta.upper && theta.upper < pi / 2))
    throw InvalidInput(
        fmt::format("theta is [{}, {}] rad, must be [lower, upper] with 0 < lower < upper < pi/2",
                    theta.lower, theta.upper));
  if (!(clearance >= 0 && clearance < 0.5))
    throw InvalidInput(fmt::format("clearance is {} cell edges, must be in [0, 0.5)", clearance));
}

FoldDesign fit_fold(const targets::FoldGoal& goal, const FoldOptions& options, const Progress& progress) {
  options.validate();
  return NetSearch(goal, options, progress).run();
}

namespace {

class SolidSearch {
 public:
  SolidSearch(const targets::Solid& solid, int cells, const FoldOptions& options)
      : solid_(solid), cells_(cells), options_(options) {}

  /// Searches theta for this number of columns. @return why the net does not fold, or empty
  std::string try_columns(int columns) {
    design_.net = lay_out(solid_, cells_, columns, options_.size);
    double steepest = 0;
    for (const auto& crease : design_.net.creases)
      steepest = std::max(steepest, std::tan(crease.angle / columns / 2));
    const double sine = steepest / std::tan(options_.tilt),
                 least = std::max(options_.theta.lower, sine < 1 ? std::asin(sine) : pi / 2);
    fold_at(options_.theta.upper);
    if (!(least < options_.theta.upper))
      return fmt::format(
          "with {} per crease, tilts of {:.1f} deg would be needed even at a fold angle of {:.1f} deg; at "
          "most "
          "{:.1f} deg "
          "is allowed",
          describe(columns), to_degrees(std::atan(steepest / std::sin(options_.theta.upper))),
          to_degrees(options_.theta.upper), to_degrees(options_.tilt));
    return try_thetas(columns, least);
  }

  void finish() {
    const model::ExactMotion motion = exact_motion(design_.net.structure);
    design_.error = solid_error(design_.net, motion.at(design_.theta), design_.theta);
  }

  SolidDesign& design() { return design_; }
  double best_share() const { return best_share_; }  ///< free share of the path to theta, [0, 1]

 private:
  static std::string describe(int columns) {
    return columns == 1 ? "one column" : fmt::format("{} columns", columns);
  }

  void fold_at(double theta) {
    design_.theta = theta;
    design_.tilt = fold_solid(design_.net, theta);
  }

  std::string try_thetas(int columns, double least) {
    double farthest = 0, wanted = 0;
    const int steps = static_cast<int>((options_.theta.upper - least) / sample_step);
    for (int k = 0; k <= steps; ++k) {
      if (options_.stop.stop_requested()) return "the search was stopped";
      fold_at(options_.theta.upper - k * sample_step);
      const double free = free_to();
      if (free >= design_.theta) return {};
      best_share_ = std::max(best_share_, free / design_.theta);
      if (wanted == 0 || free / design_.theta > farthest / wanted) farthest = free, wanted = design_.theta;
    }
    if (wanted != 0) fold_at(wanted);
    return fmt::format(
        "with {} per crease, walls run into each other at a fold angle of {:.1f} deg; the fold needs {:.1f} "
        "deg",
        describe(columns), to_degrees(farthest), to_degrees(wanted));
  }

  /// Returns the last checked theta before walls overlap, or theta if none do.
  double free_to() {
    ++design_.evaluations;
    const model::ExactMotion motion = exact_motion(design_.net.structure);
    MotionOverlapSearch overlaps(
        design_.net.structure, options_.clearance, [&](double theta) { return motion.at(theta); },
        options_.threads);
    if (!overlaps.touching_at_rest().empty()) return 0;
    const std::vector<double> thetas = sample_thetas(design_.theta);
    const auto overlap = overlaps.first_overlap(thetas);
    if (!overlap) return design_.theta;
    return overlap->sample == 0 ? 0 : thetas[overlap->sample - 1];
  }

  const targets::Solid& solid_;
  int cells_;
  const FoldOptions& options_;
  double best_share_ = 0;
  SolidDesign design_;
};

}  // namespace

SolidDesign fit_solid(const targets::Solid& solid, int cells, int columns, const FoldOptions& options,
                      const Progress& progress) {
  options.validate();
  SolidSearch search(solid, cells, options);
  SolidDesign& design = search.design();
  const int first = columns > 0 ? columns : 1, last = columns > 0 ? columns : max_solid_columns;
  for (int k = first; k <= last && !design.folds; ++k) {
    if (options.stop.stop_requested() && k > first) break;
    progress("search", static_cast<double>(k - first) / (last - first + 1),
             fmt::format("{} of {} columns per crease, best without contact to {:.0f} % of its motion", k,
                         last, 100 * search.best_share()));
    const std::string why = search.try_columns(k);
    design.attempts.push_back({0, {k}, why});
    design.folds = why.empty();
  }
  design.stopped = !design.folds && options.stop.stop_requested();
  search.finish();
  return std::move(design);
}

}  // namespace kinetix::optim
