#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/goals/space_curve/space_curve_file.hpp"
#include "app/pipeline/robust_search.hpp"
#include "app/result/search_json.hpp"
#include "app/run/contact_reason.hpp"
#include "app/run/goal.hpp"
#include "app/run/run.hpp"
#include "app/run/run_options.hpp"
#include "model/base/box_of.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/square/family/drive.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

class SpaceCurveMeasure final : public Measure {
 public:
  std::vector<Eigen::Vector3d> midline;  ///< in the frame of the model's state, mm
  targets::SpaceError error;
};

Json space_points_json(const std::vector<Eigen::Vector3d>& points) {
  Json out = Json::array();
  for (const Eigen::Vector3d& p : points) out.push_back({p.x(), p.y(), p.z()});
  return out;
}

Json distances_json(const targets::SpaceError& error) {
  Json out = Json::array();
  for (std::size_t k = 0; k < error.arc_mm.size(); ++k)
    out.push_back({error.arc_mm[k], error.distance_mm[k]});
  return out;
}

/// Lists the turn of each bending column and the climb of each shearing column. The midline of a bending column has
/// half of the column's turn. @param midline of a state whose width is along y
Json columns_json(const std::vector<Eigen::Vector3d>& midline) {
  Json out = Json::array();
  double before = 0;  // heading, rad
  for (int k = 0; k + 1 < static_cast<int>(midline.size()); ++k) {
    const Eigen::Vector3d way = midline[k + 1] - midline[k];
    const double heading = std::atan2(way.z(), way.x());
    if (optim::SpaceStrip::bends(k))
      out.push_back({{"column", k}, {"turn_deg", to_degrees(2 * std::remainder(heading - before, 2 * pi))}});
    else
      out.push_back({{"column", k}, {"climb", way.y() / std::hypot(way.x(), way.z())}});
    before = heading;
  }
  return out;
}

/// Section of a result for a curve in space. The goal is met if the shape is within tolerance and no walls collide.
struct SpaceCurveOutcome final : GoalOutcome {
  explicit SpaceCurveOutcome(SpaceCurveFile asked) : file(std::move(asked)) {}

  SpaceCurveFile file;
  optim::SpaceDesign found;
  model::Pose place;  ///< pose of the goal in the frame of the model's state, mm

  void add_sections(const Run& run, Json& result) const override {
    result["target"] = {{"kind", "space_curve"}, {"points_mm", space_points_json(file.wanted.points())}};
    const auto& shape = measure_of<SpaceCurveMeasure>(run);
    const targets::SpaceError& error = shape.error;
    Json section = {
        {"goal_mm", space_points_json(error.goal_mm)},
        {"error", distances_json(error)},
        {"diagonal_mm", error.scale_mm},
        {"slope", found.across.slope},
        {"across", {found.across.direction.x(), found.across.direction.y(), found.across.direction.z()}},
        {"columns", columns_json(shape.midline)},
        {"walls_meet", found.contact.touches},
        {"reasons", run.violations},
        {"reasons_physics", run.physics_violations()}};
    if (const auto* physics = physics_measure_of<SpaceCurveMeasure>(run))
      section["physics"] = {{"rms", physics->error.rms}, {"max", physics->error.max}};
    result["space_curve"] = section;
    result["optimiser"] = search_json(found.search, std::max(1, found.tried));
  }
  void add_metrics(const Run& run, Json& metrics) const override {
    const targets::SpaceError& error = measure_of<SpaceCurveMeasure>(run).error;
    metrics["shape_rms"] = error.rms;
    metrics["shape_max"] = error.max;
    if (const auto* physics = physics_measure_of<SpaceCurveMeasure>(run))
      metrics["shape_rms_physics"] = physics->error.rms;
    metrics["met"] = run.met();
  }
  std::vector<SummaryLine> summary_lines(const Run& run) const override {
    const targets::SpaceError& error = measure_of<SpaceCurveMeasure>(run).error;
    std::vector<SummaryLine> lines;
    lines.push_back(
        {"shape",
         fmt::format(
             "rms {:.2e} of the goal's diagonal ({:.3f} mm from curve to curve), largest {:.3f} mm: {}",
             error.rms, error.rms * error.scale_mm, error.max * error.scale_mm,
             tolerance_words(run, error.rms <= file.shape_tolerance))});
    const Eigen::Vector3d& y = found.across.direction;
    lines.push_back(
        {"across", fmt::format("the strip's width lies along [{:.3f}, {:.3f}, {:.3f}], along which the curve "
                               "climbs by at most {:.3f} of its length",
                               y.x(), y.y(), y.z(), found.across.slope)});
    lines.push_back({"search", fmt::format("{:.3f} s, {} evaluations, {}", run.timings.optimise,
                                           found.search.evaluations, to_string(found.search.status))});
    return lines;
  }
};

/// Describes violations of the shape tolerance. @param who "model", "equilibrium" or "physics run"
std::vector<std::string> violations(const SpaceCurveFile& file, const targets::SpaceError& error,
                                    const std::string& who) {
  if (error.rms <= file.shape_tolerance) return {};
  return {fmt::format("{}: rms {:.3g} of the goal's diagonal; at most {:g} is allowed: use more columns", who,
                      error.rms, file.shape_tolerance)};
}

// Search time in s for 96 columns, measured; it grows with the third power of their number.
constexpr double seconds_of_96 = 0.3;

// Simulated time in s per column until the ends of a strip driven at its middle are at rest, measured.
constexpr double settling_seconds_per_column = 0.06;

// Half width of the interval that gives the goal's direction at a point, as a ratio to the goal's length.
constexpr double direction_reach = 1e-3;

class SpaceCurveGoal final : public Goal {
 public:
  explicit SpaceCurveGoal(SpaceCurveFile file) : Goal(file.name), file_(std::move(file)) {}

  Forecast forecast() const override {
    const int columns = file_.variables.columns;
    Forecast out{sheet_of(model::ExactDesign<double>::basic(columns, 1), file_.variables.size)};
    out.folded_mm = model::box_of(file_.wanted.points()).sizes();
    out.search_s = seconds_of_96 * std::pow(columns / 96.0, 3);
    add_settings(file_, out);
    if (file_.robust) out.search_s *= designs_of_robust_search(tried_theta(), file_.hinge);
    return out;
  }

  Found search(const RunOptions& options) const override {
    Found plain = search(file_, options);
    if (!file_.robust) return plain;
    return search_robustly(
        std::move(plain), *this, *file_.robust, tried_theta(),
        [&](const RobustTrial& trial, const RunOptions& quiet) {
          SpaceCurveFile file = file_;
          file.hinge = trial.hinge;
          file.variables.theta = trial.theta.value_or(file.variables.theta);
          if (trial.theta) file.variables.thetas = 1;
          return search(file, quiet);
        },
        options);
  }

  std::shared_ptr<const Measure> measure(const Run& run, StateOf of, const model::State& state,
                                         const RunOptions&) const override {
    const auto& outcome = outcome_of<SpaceCurveOutcome>(run);
    auto out = std::make_shared<SpaceCurveMeasure>();
    out->midline = optim::space_midline(aligned(state, run.own));
    out->error = space_error(out->midline, file_.wanted, outcome.place);
    out->violations = violations(outcome.file, out->error, in_words(of));
    const model::ContactLimit& contact = outcome.found.contact;
    if (of != StateOf::physics && contact.touches)
      out->violations.push_back(
          overlap_words(contact, outcome.found.design.theta, run.design.structure) +
          ": use lower or thinner walls, or another number of columns: where cell_mm is given, fewer");
    return out;
  }

  /// Observes the offset of each column from the nearest point of the goal, in two directions.
  std::optional<Observed> observe(const Found& found, const model::Lattice& sheet,
                                  const model::State& state) const override {
    const auto& outcome = outcome_of<SpaceCurveOutcome>(found);
    const model::Pose motion = motion_onto(state, found.own);
    const std::vector<Eigen::Vector3d> midline = optim::space_midline(moved(state, motion));
    const targets::SpaceCurve goal(space_error(midline, file_.wanted, outcome.place).goal_mm);
    const std::vector<std::vector<int>> columns = body_columns(sheet);
    Observed out{{}, file_.shape_tolerance * file_.wanted.diagonal()};
    const Eigen::Matrix3d back = motion.R.transpose();
    for (std::size_t k = 0; k < midline.size(); ++k) {
      const double s = goal.nearest(midline[k]);
      const Eigen::Vector3d place = back * (midline[k] - motion.p), off = midline[k] - goal.at(s);
      // Both directions are perpendicular to the goal: a motion along it does not change the distance.
      const Eigen::Vector3d along = goal.direction(s, direction_reach * file_.wanted.length());
      const Eigen::Vector3d square = off - off.dot(along) * along;
      const Eigen::Vector3d away =
          square.norm() > 0 ? Eigen::Vector3d(square.normalized()) : along.unitOrthogonal();
      out.points.push_back({columns[k], place, back * away, off.dot(away), 2});
      out.points.push_back({columns[k], place, back * along.cross(away), 0, 2});
    }
    return out;
  }

 private:
  Found search(const SpaceCurveFile& file, const RunOptions& options) const {
    Found out;
    take_settings(out, file);
    options.progress("search", 0);
    auto outcome = std::make_unique<SpaceCurveOutcome>(file);
    out.tolerances = {{"shape", file.shape_tolerance}};
    optim::SolverOptions solver;
    follow(options, file.wanted.diagonal(), solver);
    outcome->found = fit_space_curve(file.wanted, file.variables, solver);
    const model::Structure strip = sheet_of(outcome->found.design, outcome->found.size);
    out.design.structure = strip;
    out.theta = outcome->found.design.theta;
    out.plan.exact = exact_motion(strip);
    const model::Pose motion = motion_onto(fold(outcome->found.design, strip), out.plan.exact.at(out.theta));
    outcome->place = {motion.R * outcome->found.place.R, motion.R * outcome->found.place.p + motion.p};
    out.goal = std::move(outcome);
    out.is_strip = true;
    out.is_laid_over = true;
    out.bounds = {file_.variables.beta, file_.variables.theta};
    const model::Wall middle = {{file_.variables.columns / 2, 0}, model::Axis::y};
    out.physics = {.drive = drive_on(strip, hinge_drive_to(strip, middle, out.theta)),
                   .least_settle_s = settling_seconds_per_column * file_.variables.columns};
    return out;
  }

  /// Returns the range of theta for a robust search; nullopt if the cell edge is fixed.
  std::optional<optim::AngleRange> tried_theta() const {
    return file_.variables.free_edge ? std::optional(file_.variables.theta) : std::nullopt;
  }

  SpaceCurveFile file_;
};

}  // namespace

std::unique_ptr<Goal> make_goal(SpaceCurveFile file) {
  return std::make_unique<SpaceCurveGoal>(std::move(file));
}

extern const GoalKind space_curve_kind = {
    .name = "space_curve",
    .example = "target: {kind: space_curve, points: helix.csv}",
    .read = [](const targets::Node& root) { return make_goal(read_space_curve_file(root)); },
    .table = space_curve_keys,
    .metrics = {
        {"shape_rms", "", "[distance of midline and goal](#shape_rms-and-shape_max), root mean square"},
        {"shape_max", "", "likewise, the largest"},
        {"shape_rms_physics", "", "shape_rms in the physics run"}}};

}  // namespace kinetix::app
