#include "optim/space_curve/fit_space_curve.hpp"

#include <fmt/format.h>

#include "model/hinge/crease_law.hpp"
#include "model/lattice/square/family/classification.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;

constexpr double max_error_ratio = 1.1;  // times the least error: within this, the remaining room decides

/// Returns the limits of the columns at theta.
SpaceLimits limits_at(const SpaceVariables& v, double theta) {
  const double lean = std::min(2 * v.t[1] - 1, 1 - 2 * v.t[0]);
  return {model::crease_turn(v.beta, theta), lean * std::tan(theta)};
}

/// Returns the goal in the strip's frame: x and z in the plane of its turns, y across.
targets::SpaceCurve seen(const targets::SpaceGoal& goal, const Eigen::Matrix3d& frame) {
  std::vector<Vector3d> points;
  for (const Vector3d& p : goal.points()) points.push_back(frame.transpose() * p);
  return targets::SpaceCurve(points);
}

double largest(const std::vector<double>& all, std::size_t& where) {
  const auto more = [](double a, double b) { return std::abs(a) < std::abs(b); };
  where = static_cast<std::size_t>(std::max_element(all.begin(), all.end(), more) - all.begin());
  return std::abs(all[where]);
}

std::string describe_place(const targets::SpaceGoal& goal, double arc) {
  const Vector3d p = goal.line().at(arc);
  return fmt::format("{:.4g} mm along the curve, at [{:.4g}, {:.4g}, {:.4g}]", arc, p.x(), p.y(), p.z());
}

Across across_of(const targets::SpaceGoal& goal, int columns) {
  return min_slope(goal, 2 * goal.length() / columns);
}

/// Returns the range of theta below the angle at which cells close.
AngleRange allowed_theta(const SpaceVariables& v) {
  const double closing = closing_theta(v.size) - model::closing_margin;
  if (!(v.theta.lower < closing))
    throw InvalidInput(
        fmt::format("walls of {:.3g} mm in cells of {:.3g} mm close at {:.3g} deg, below the range of the "
                    "fold angle. Give thinner walls or smaller angles",
                    v.size.thickness_mm, v.size.edge_mm, to_degrees(closing)));
  return {v.theta.lower, std::min(v.theta.upper, closing)};
}

// Least cell edge over the thickness of given walls. Structures allow walls below half a cell edge. The rest is for
// cells that get smaller when the same strip is folded less (same_at).
constexpr double min_edge_ratio = 2.4;

/// Returns the least edge of cells that given walls leave open at theta, mm. @pre theta <= allowed_theta(v).upper
double min_edge_mm(const SpaceVariables& v, double theta) {
  if (v.free_walls) return 0;
  const double open = 1 - std::tan(theta + model::closing_margin);  // see closing_theta()
  return v.size.thickness_mm * std::max(min_edge_ratio, 1 / open);
}

/// Returns the lattice's design of a strip at theta.
model::ExactDesign<double> design_of(const SpaceStrip& strip, double theta) {
  auto design = model::ExactDesign<double>::basic(strip.columns, 1);
  design.theta = theta;
  for (int k = 0; k < strip.columns; ++k)
    if (SpaceStrip::bends(
            k))  // odd columns begin at a body of sublattice B: the crease turns with the sign of the tilt
      design.beta[k] = model::tilt_of_turn(strip.turn[k / 2], theta);
    else
      design.t[k] = (1 + strip.climb[k / 2] / std::tan(theta)) / 2;
  return design;
}

model::CellSize with_edge(const SpaceVariables& v, double edge) {
  if (!v.free_edge) return v.size;
  const double scale = edge / v.size.edge_mm;
  model::CellSize size = v.size;
  size.edge_mm = edge;
  if (!v.free_walls) return size;
  size.thickness_mm *= scale;
  size.height_mm *= scale;
  return size;
}

/// Returns the share of the room for tilts, fractions and theta that is used, [0, 1].
double use_of(const SpaceDesign& found, const SpaceVariables& v, double upper) {
  double use = found.design.theta / upper;
  for (const double beta : found.design.beta) use = std::max(use, std::abs(beta) / v.beta);
  for (const double t : found.design.t)
    use = std::max(use, (t - 0.5) / (t > 0.5 ? v.t[1] - 0.5 : v.t[0] - 0.5));
  return use;
}

constexpr double narrower = 0.8;   // times the limits of columns whose walls meet
constexpr int max_narrowings = 4;  // 0.8^4 is 0.4: with smaller turns and climbs the strip is hardly nearer
// Evaluations of one search for a goal out of reach. Columns at their limits converge slowly, to little less error.
constexpr int most_evaluations = 50;

/// Returns the error, and far more of a strip whose walls meet.
double rank(const SpaceDesign& one) { return one.error.rms + (one.contact.touches ? 1e3 : 0); }

class StripSearch {
 public:
  StripSearch(const targets::SpaceGoal& goal, const SpaceVariables& v, const SolverOptions& options,
              const Across& across)
      : goal_(goal), v_(v), options_(options), across_(across) {
    frame_ = frame_across(goal, across_.direction);
    line_ = std::make_unique<targets::SpaceCurve>(seen(goal, frame_));
    first_ = followed(*line_, v.columns);
  }

  SpaceDesign find() {
    const AngleRange range = allowed_theta(v_);
    if (!v_.free_edge) return of_given_cells(range);
    // Starts with the largest theta, which allows most. The same strip stays the best as long as the bounds
    // allow it.
    std::vector<SpaceDesign> all;
    for (int k = 0; k < v_.thetas && !(k > 0 && options_.stop.stop_requested()); ++k) {
      const double part = v_.thetas > 1 ? static_cast<double>(k) / (v_.thetas - 1) : 0;
      const double theta = range.upper - part * (range.upper - range.lower);
      all.push_back(k > 0 && fits(all.back(), theta) ? same_at(all.back(), theta) : at(theta, range));
    }
    return best_of(std::move(all), range.upper);
  }

  /// Returns the strip at the largest theta, whose walls may meet.
  SpaceDesign find_first() {
    const AngleRange range = allowed_theta(v_);
    return v_.free_edge ? at(range.upper, range) : of_given_cells(range);
  }

  /// Finds the strip nearest to a goal out of reach, whose columns are at their limits. Where their walls meet, the
  /// limits are narrowed. Each search starts at the strip of the one before. @param first find_first()
  SpaceDesign find_nearest(SpaceDesign first) {
    if (!v_.free_edge) return first;
    const AngleRange range = allowed_theta(v_);
    int evaluations = first.search.evaluations;
    std::vector<SpaceDesign> all = {std::move(first)};
    for (int k = 0; k < v_.thetas; ++k) {
      const double part = v_.thetas > 1 ? static_cast<double>(k) / (v_.thetas - 1) : 0;
      const double theta = range.upper - part * (range.upper - range.lower);
      double share = 1;
      for (int narrowed = 0; narrowed <= max_narrowings; ++narrowed, share *= narrower) {
        if (options_.stop.stop_requested()) break;
        if (k > 0 || narrowed > 0) {
          all.push_back(at(theta, range, share, all.back().strip));
          evaluations += all.back().search.evaluations;
        }
        if (!all.back().contact.touches) break;
      }
    }
    SpaceDesign out = best_of(std::move(all), range.upper);
    out.search.evaluations = evaluations;
    return out;
  }

 private:
  double theta_of(double step) const { return std::acos(std::min(1.0, step / v_.size.edge_mm)); }

  bool fits(const SpaceDesign& one, double theta) const {
    const SpaceLimits limits = limits_at(v_, theta);
    std::size_t where = 0;
    return largest(one.strip.turn, where) <= limits.turn && largest(one.strip.climb, where) <= limits.climb;
  }

  /// Fits a strip of given cells, whose theta follows from its length. A strip longer than the first estimate
  /// is folded less, so the same turns and climbs need more of tilts and fractions. If that exceeds their
  /// bounds, it is searched again with this length as its limit.
  SpaceDesign of_given_cells(const AngleRange& range) const {
    SpaceDesign found = at(std::clamp(theta_of(first_.step), range.lower, range.upper), range);
    const double theta = found.design.theta;
    if (!(theta < range.upper) || fits(found, theta)) return found;
    const int before = found.search.evaluations;
    found = at(theta, {theta, range.upper});
    found.search.evaluations += before;
    return found;
  }

  /// Returns the same midline, folded less or more; distances are unchanged.
  SpaceDesign same_at(SpaceDesign one, double theta) const {
    one.design = design_of(one.strip, theta);
    one.size = with_edge(v_, one.strip.step / std::cos(theta));
    meet(one);
    return one;
  }

  SpaceDesign at(double theta, const AngleRange& range) const { return at(theta, range, 1, first_); }

  /// @param share of the limits of columns, (0, 1]   @param start of the search
  SpaceDesign at(double theta, const AngleRange& range, double share, const SpaceStrip& start) const {
    SpaceLimits limits = limits_at(v_, theta);
    limits.turn *= share;
    limits.climb *= share;
    if (v_.free_edge) {
      limits.min_step = min_edge_mm(v_, theta) * std::cos(theta);
    } else {
      limits.min_step = v_.size.edge_mm * std::cos(range.upper);
      limits.max_step = v_.size.edge_mm * std::cos(range.lower);
    }
    const SpaceFit fit(*line_, goal_.diagonal(), first_, limits);
    SpaceDesign out;
    out.search = solve(fit, fit.pack(start), options_);
    if (out.search.x.size() == 0) throw std::runtime_error("the search failed: " + out.search.why);
    out.strip = fit.strip(out.search.x);
    const double at_theta = v_.free_edge ? theta : theta_of(out.strip.step);
    out.across = across_;
    out.design = design_of(out.strip, at_theta);
    out.size = with_edge(v_, out.strip.step / std::cos(at_theta));
    measure(out);
    return out;
  }

  void measure(SpaceDesign& out) const {
    const model::Structure structure = sheet_of(out.design, out.size);
    const std::vector<Vector3d> midline = space_midline(fold(out.design, structure));
    // The fold begins at the origin with its first panel along x.
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(out.strip.heading, Vector3d::UnitY()).toRotationMatrix();
    const Eigen::Matrix3d R = turn * frame_.transpose();
    out.place = {R, midline.front() - turn * out.strip.start};
    out.error = targets::space_error(midline, goal_, out.place);
    meet(out);
  }

  static void meet(SpaceDesign& out) {
    const model::Structure structure = sheet_of(out.design, out.size);
    out.contact = theta_range(structure, exact_motion(structure), {.limit = out.design.theta}).positive;
  }

  SpaceDesign best_of(std::vector<SpaceDesign> all, double upper) const {
    double least = std::numeric_limits<double>::infinity();
    for (const SpaceDesign& one : all) least = std::min(least, rank(one));
    std::size_t chosen = all.size();
    double use = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (!(rank(all[k]) <= max_error_ratio * least) || !(use_of(all[k], v_, upper) < use)) continue;
      chosen = k;
      use = use_of(all[k], v_, upper);
    }
    SpaceDesign out = std::move(all.at(chosen));
    out.tried = static_cast<int>(all.size());
    return out;
  }

  const targets::SpaceGoal& goal_;
  const SpaceVariables& v_;
  const SolverOptions& options_;
  Across across_;
  Eigen::Matrix3d frame_;
  std::unique_ptr<targets::SpaceCurve> line_;
  SpaceStrip first_;
};

void check(bool is_fine, const std::string& what) {
  if (!is_fine) throw InvalidInput(what);
}

}  // namespace

void SpaceVariables::validate() const {
  check(columns >= 4, fmt::format("columns is {}, must be at least 4", columns));
  check(beta > 0 && beta < pi / 2, fmt::format("beta is {} rad, must be in (0, pi/2)", beta));
  check(t[0] > 0 && t[0] < 0.5 && t[1] > 0.5 && t[1] < 1,
        fmt::format("t is [{}, {}], must hold 0.5 and lie within (0, 1)", t[0], t[1]));
  check(theta.lower > 0 && theta.lower < theta.upper && theta.upper < pi / 4,
        fmt::format("theta is [{}, {}] rad, must be [lower, upper] within (0, pi/4)", theta.lower,
                    theta.upper));
  check(thetas >= 1, fmt::format("thetas is {}, must be at least 1", thetas));
}

std::optional<SpaceObstacle> obstacle(const targets::SpaceGoal& goal, const SpaceVariables& v) {
  v.validate();
  const Across across = across_of(goal, v.columns);
  const SpaceLimits most = limits_at(v, allowed_theta(v).upper);
  // Every second column climbs, so the slope over two columns is half of it.
  if (!(across.slope <= most.climb / 2))
    return SpaceObstacle{
        across.arc_mm,
        fmt::format(
            "the curve climbs across the strip by {:.3g} of its length {}, and columns can shear at most "
            "{:.3g} at fold angle {:.3g} deg",
            across.slope, describe_place(goal, across.arc_mm), most.climb / 2,
            to_degrees(allowed_theta(v).upper)),
        true};
  const SpaceStrip strip = followed(seen(goal, frame_across(goal, across.direction)), v.columns);
  std::size_t where = 0;
  const double turn = largest(strip.turn, where);
  if (turn <= most.turn) return std::nullopt;
  const double arc = goal.length() * (2.0 * static_cast<double>(where) + 1.5) / v.columns;
  return SpaceObstacle{
      arc, fmt::format("the curve turns by {:.3g} deg within two columns {}, more than the {:.3g} deg "
                       "that a column can bend",
                       to_degrees(turn), describe_place(goal, arc), to_degrees(most.turn))};
}

SpaceDesign fit_space_curve(const targets::SpaceGoal& goal, const SpaceVariables& variables,
                            const SolverOptions& options) {
  const std::optional<SpaceObstacle> found = obstacle(goal, variables);
  const Across across = across_of(goal, variables.columns);
  if (!found) return StripSearch(goal, variables, options, across).find();
  SolverOptions few = options;
  few.max_evaluations = std::min(few.max_evaluations, most_evaluations);
  StripSearch by_largest(goal, variables, few, across),
      by_mean(goal, variables, few, mean_slope(goal, 2 * goal.length() / variables.columns));
  SpaceDesign first = by_largest.find_first(), other = by_mean.find_first();
  const bool is_other = other.error.rms < first.error.rms;
  SpaceDesign out =
      is_other ? by_mean.find_nearest(std::move(other)) : by_largest.find_nearest(std::move(first));
  out.obstacle = found;
  return out;
}

std::vector<Vector3d> space_midline(const model::State& state) {
  std::vector<Vector3d> points;
  for (std::size_t b = 0; b + 1 < state.size(); b += 2) points.push_back((state[b].p + state[b + 1].p) / 2);
  return points;
}

}  // namespace kinetix::optim
