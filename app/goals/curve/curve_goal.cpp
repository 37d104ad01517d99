#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/goals/curve/curve_search.hpp"
#include "app/goals/strip_remedies.hpp"
#include "app/pipeline/robust_search.hpp"
#include "app/result/result_json.hpp"
#include "app/result/state_json.hpp"
#include "app/run/goal.hpp"
#include "app/run/run.hpp"
#include "app/run/run_options.hpp"
#include "app/run/search_result.hpp"
#include "model/base/box.hpp"
#include "model/lattice/lattice.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/tolerance/print_tolerance.hpp"
#include "optim/curve/fit_curve.hpp"
#include "targets/curve/curve.hpp"
#include "targets/curve/polyline.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

struct CurveMeasure final : Measure {
  std::vector<Eigen::Vector2d> midline_mm;  ///< (x, z), in the frame of the model's state
  targets::CurveError error;
};

Json error_json(const targets::CurveError& error) {
  Json out = Json::array();
  for (std::size_t k = 0; k < error.arc_mm.size(); ++k)
    out.push_back({error.arc_mm[k], error.distance_mm[k]});
  return out;
}

Json turns_json(const optim::CurveReach& reach) {
  Json out = Json::array();
  for (const optim::ColumnTurn& t : reach.turns)
    out.push_back({{"column", t.column},
                   {"arc_mm", t.arc_mm},
                   {"needed_deg", t.needed / radians_per_degree},
                   {"allowed_deg", std::abs(t.allowed) / radians_per_degree}});
  return out;
}

Json robust_json(const RobustCurve& robust) {
  Json out = Json::array();
  for (std::size_t k = 0; k < robust.tried.size(); ++k) {
    const CurveCandidate& one = robust.tried[k];
    out.push_back({{"columns", one.columns},
                   {"cell_mm", one.cell_mm},
                   {"gap_mm", one.gap_mm ? Json(*one.gap_mm) : Json(nullptr)},
                   {"theta_rad", one.theta},
                   {"shape_rms", one.shape_rms},
                   {"as_made_rms_mm", one.printed_mm},
                   {"as_made_p95_mm", one.printed_p95_mm},
                   {"allowed", one.is_allowed},
                   {"in_matter", one.is_compensated},
                   {"chosen", k == robust.chosen}});
  }
  return out;
}

std::string robust_text(const RobustCurve& robust) {
  const CurveCandidate &best = robust.tried[robust.chosen], &plain = robust.tried.front();
  if (robust.chosen == 0)
    return fmt::format("tried {} strips; none is expected to print more accurately than the original",
                       robust.tried.size());
  const std::string gaps = best.gap_mm ? fmt::format(", gaps of {:.2g} mm", *best.gap_mm) : "";
  return fmt::format(
      "{} columns at fold angle {:.1f} deg{}, of {} strips tried: print error{} {:.3g} mm; for the design "
      "with "
      "the smallest nominal error, {} columns at {:.1f} deg, {}",
      best.columns, best.theta / radians_per_degree, gaps, robust.tried.size(),
      best.is_compensated ? "" : " of the ideal motion", best.printed_mm, plain.columns,
      plain.theta / radians_per_degree,
      std::isfinite(plain.printed_mm) ? fmt::format("{:.3g} mm", plain.printed_mm) : "unknown");
}

optim::MultiStartOptions curve_search(const CurveFile& file, const RunOptions& options) {
  optim::MultiStartOptions search;
  search.starts = file.solver.starts.value_or(search.starts);
  search.solver.name = file.solver.name.value_or(search.solver.name);
  search.solver.max_evaluations = file.solver.max_evaluations.value_or(search.solver.max_evaluations);
  return followed(search, options, [mm = file.curve.diagonal()](double least) {
    return fmt::format("best {:.2g} mm off", least * mm);
  });
}

/// Curve section of a result. The goal is met if the shape is within tolerance and no walls collide.
struct CurveOutcome final : GoalOutcome {
  explicit CurveOutcome(CurveStrip strip) : file(std::move(strip.file)), found(std::move(strip.found)) {}

  CurveFile file;
  optim::FreeCurveDesign found;
  std::optional<RobustCurve> robust;  ///< candidates, if `found` was chosen by its print tolerance analysis

  optim::SolverName solver() const { return curve_search(file, {}).solver.name; }

  void add_sections(const Run& run, Json& result) const override {
    const auto& shape = measure_of<CurveMeasure>(run);
    result["target"] = {{"kind", "curve"}, {"points_mm", points_json(file.curve.points())}};
    result["curve"] = {
        {"folded_mm", points_json(shape.midline_mm)}, {"goal_mm", points_json(shape.error.goal_mm)},
        {"error", error_json(shape.error)},           {"scale_mm", shape.error.scale_mm},
        {"turn", turns_json(found.design.reach)},     {"reasons", run.violations}};
    if (robust) result["curve"]["robust"] = robust_json(*robust);
    result["optimiser"] = search_json(found.design.search, found.design.chosen, solver());
  }
  void add_metrics(const Run& run, Json& metrics) const override {
    const targets::CurveError& error = measure_of<CurveMeasure>(run).error;
    metrics["shape_rms"] = error.rms;
    metrics["shape_max"] = error.max;
    metrics["met"] = run.met();
  }
  std::vector<SummaryLine> summary_lines(const Run& run) const override {
    const targets::CurveError& error = measure_of<CurveMeasure>(run).error;
    std::vector<SummaryLine> lines = {
        describe_shape(error.rms, error.max, error.scale_mm, file.shape_tolerance)};
    if (robust) lines.push_back({"robust", robust_text(*robust)});
    lines.push_back(search_line(run.timings.optimise, found.design.search, found.design.chosen, solver()));
    return lines;
  }
};

// Measured: s a start of 40 columns; it grows with their number to 1.5.
constexpr double seconds_per_start = 0.0075;
// Curves that turn by more than this, rad, in all or in one column, are searched again for gentle tilts or walls that stay apart.
// The counts below say how many times as long that was measured to take.
constexpr double full_turn = 320 * radians_per_degree, steep_turn = 36 * radians_per_degree,
                 sharp_turn = 60 * radians_per_degree;
constexpr double repeats_of_full = 4, repeats_of_steep = 12, repeats_of_sharp = 40;
constexpr double robust_designs = 45;  // searches that a robust design takes, about

double repeats(const targets::Curve& curve, int columns) {
  double all = 0, most = 0;
  for (int c = 0; c < columns; ++c) {
    const double turn = std::abs(optim::needed_turn(curve, c, columns));
    all += turn;
    most = std::max(most, turn);
  }
  if (most >= sharp_turn) return repeats_of_sharp;
  if (most >= steep_turn) return repeats_of_steep;
  return all >= full_turn ? repeats_of_full : 1;
}

/// Lists the keys of `variables.tilt` that tie the tilts of columns to each other.
std::vector<std::string> ties_of(const CurveFile& file) {
  std::vector<std::string> out;
  if (file.per == optim::Per::all) out.emplace_back("per");
  if (file.symmetry != optim::Symmetry::none) out.emplace_back("symmetry");
  return out;
}

/// Lists the ranges of the file, and the walls that meet, which keep the strip from its curve.
std::vector<std::string> curve_violations(const CurveFile& file, const optim::FreeCurveDesign& found) {
  std::vector<std::string> why = found.design.reach.obstacles;
  const double rms = found.design.error.rms;
  if (!found.narrowed.empty())
    why.push_back(fmt::format("no start whose walls stay apart came closer than {:.3g} of the diagonal; {}",
                              rms, found.narrowed));
  const std::vector<std::string> ties = ties_of(file);
  if (why.empty())
    why.push_back(fmt::format(
        "no start came closer than {:.3g} of the diagonal, although each single column can "
        "bend enough{}",
        rms,
        ties.empty() ? ""
                     : fmt::format(": `{}` makes tilts depend on each other", fmt::join(ties, "` and `"))));
  return why;
}

class CurveGoal final : public Goal {
 public:
  explicit CurveGoal(CurveFile file) : Goal(file.name), file_(std::move(file)) {}

  const targets::Curve& curve() const { return file_.curve; }

  Forecast forecast() const override {
    Forecast out{sheet_of(model::ExactDesign<double>::basic(file_.columns, file_.rows), file_.size)};
    const Eigen::Vector2d size = model::box_of(file_.curve.points()).sizes();
    out.folded_mm = {size.x(), file_.rows * file_.size.edge_mm, size.y()};
    out.search_s = seconds_per_start * file_.solver.starts.value_or(optim::MultiStartOptions{}.starts) *
                   std::pow(file_.columns / 40.0, 1.5) * repeats(file_.curve, file_.columns);
    if (file_.robust) out.search_s *= robust_designs;
    add_settings(file_, out);
    if (file_.robust)
      out.search_s += static_cast<double>(robust_finalists) * compensation_seconds(file_, out.sheet);
    return out;
  }

  SearchResult search(const RunOptions& options) const override {
    const optim::MultiStartOptions search = curve_search(file_, options);
    options.progress("search", 0);
    CurveStrip plain{file_, fit_free_curve(file_.curve, curve_variables(file_), file_.size, search,
                                           file_.shape_tolerance)};
    if (!file_.robust) return make_search_result(std::move(plain));
    auto [best, robust] = robust_curve(*this, std::move(plain), search, options,
                                       [&](const CurveStrip& strip) { return make_search_result(strip); });
    return make_search_result(std::move(best), std::move(robust));
  }

  /// Measures the model's state and the equilibrium of elastic hinges. Returns nullptr for the simulation, which is
  /// judged by its distance from the model alone.
  std::shared_ptr<const Measure> measure(const Run& run, StateOf of, const model::State& state,
                                         const RunOptions&) const override {
    if (of == StateOf::physics) return nullptr;
    const optim::FreeCurveDesign& found = outcome_of<CurveOutcome>(run).found;
    auto out = std::make_shared<CurveMeasure>();
    if (of == StateOf::model) {
      out->midline_mm = found.design.midline_mm;
      out->error = found.design.error;
      if (!(out->error.rms <= file_.shape_tolerance)) out->violations = curve_violations(file_, found);
    } else {
      out->midline_mm = column_midline(run.design.structure, aligned(state, run.own));
      out->error = curve_error(out->midline_mm, file_.curve);
      if (!(out->error.rms <= file_.shape_tolerance))
        out->violations.push_back(
            fmt::format("equilibrium: rms {:.3g} of the goal's diagonal; at most {:g} is allowed",
                        out->error.rms, file_.shape_tolerance));
    }
    if (found.contact.touches)
      out->violations.push_back(
          describe_overlap(found.contact, found.design.design.theta, run.design.structure));
    out->distance = out->error.rms / file_.shape_tolerance;
    return out;
  }

  std::vector<targets::DocumentChanges> remedies(const Run& missed) const override {
    const optim::FreeCurveDesign& found = outcome_of<CurveOutcome>(missed).found;
    MissedStrip strip{.columns = file_.columns,
                      .rows = file_.rows,
                      .fitting_columns = found.design.reach.fitting_columns,
                      .tilt = std::min(std::abs(file_.beta.lower), std::abs(file_.beta.upper)),
                      .fold_angle = file_.theta,
                      .ties = ties_of(file_),
                      .walls_meet = found.contact.touches || !found.narrowed.empty(),
                      .size = missed.design.structure.size()};
    if (!file_.free_size) strip.cell_mm = file_.size.edge_mm;
    return strip_remedies(strip);
  }

  /// Observes the distance of each column from the goal, after the goal is aligned with the midline.
  std::optional<Observed> observe(const SearchResult& found, const model::Lattice& sheet,
                                  const model::State& state) const override {
    const model::Pose motion = motion_onto(state, found.own);
    const Eigen::Matrix3d back = motion.R.transpose();
    const model::State placed = moved(state, motion);
    const std::vector<Eigen::Vector2d> midline = column_midline(sheet, placed);
    const targets::PolylineTree goal(curve_error(midline, file_.curve).goal_mm);
    const std::vector<std::vector<int>> columns = body_columns(sheet);
    Observed out{{}, file_.shape_tolerance * outcome_of<CurveOutcome>(found).found.design.error.scale_mm};
    for (std::size_t k = 0; k < midline.size(); ++k) {
      const targets::ClosestPoint at = goal.nearest(midline[k]);
      const Eigen::Vector3d place(midline[k].x(), placed[columns[k][0]].p.y(), midline[k].y()),
          normal(at.normal.x(), 0, at.normal.y());
      out.points.push_back({columns[k], back * (place - motion.p), back * normal, at.distance});
    }
    return out;
  }

 private:
  TurnBounds bounds() const {
    const double tilt = std::max(std::abs(file_.beta.lower), std::abs(file_.beta.upper));
    return {tilt, file_.theta,
            [rows = file_.rows, per = file_.per, symmetry = file_.symmetry,
             beta = file_.beta](const model::Lattice& sheet) {
              const model::Structure& strip = *sheet.squares();
              const int columns = static_cast<int>(strip.cells.size()) / rows;
              return tied_tilts(strip, make_bend_ties(columns, per, symmetry, beta));
            }};
  }

  SearchResult make_search_result(CurveStrip strip, std::optional<RobustCurve> robust = {}) const {
    SearchResult out;
    copy_settings(out, strip.file);
    out.tolerances = {{"shape", strip.file.shape_tolerance}};
    out.design.structure = sheet_of(strip.found.design.design, strip.file.size);
    out.theta = strip.found.design.design.theta;
    out.is_strip = true;
    out.is_aligned = true;
    out.bounds = bounds();
    out.notes.insert(out.notes.end(), strip.found.notes.begin(), strip.found.notes.end());
    if (const auto& found = strip.found; found.contact.touches)
      out.notes.push_back(describe_overlap(found.contact, out.theta, out.design.structure));
    auto curve = std::make_unique<CurveOutcome>(std::move(strip));
    curve->robust = std::move(robust);
    out.goal = std::move(curve);
    return out;
  }

  CurveFile file_;
};

template <double targets::CurveError::*part>
double measured(const Goal& goal, const model::Lattice& structure, const model::State& state) {
  return curve_error(column_midline(structure, state), dynamic_cast<const CurveGoal&>(goal).curve()).*part;
}

}  // namespace

optim::CurveVariables curve_variables(const CurveFile& file) {
  optim::CurveVariables v;
  v.columns = file.columns;
  v.rows = file.rows;
  v.cell_mm = file.size.edge_mm;
  v.beta = file.beta;
  v.theta = file.theta;
  v.per = file.per;
  v.symmetry = file.symmetry;
  return v;
}

std::unique_ptr<Goal> make_goal(CurveFile file) { return std::make_unique<CurveGoal>(std::move(file)); }

extern const GoalKind curve_kind = {
    .name = "curve",
    .example = "target: {kind: curve, points: points.csv}",
    .meaning = "strip that folds into a curve in a plane",
    .file = {{"points", "x,z"}},
    .read = [](const targets::Node& root) { return make_goal(read_curve_file(root)); },
    .table = curve_keys,
    .metrics = {{"shape_rms", "",
                 "[distance of midline and goal](#shape_rms-and-shape_max), root mean square"},
                {"shape_max", "", "largest distance of midline and goal"}},
    .measures = {{"shape_rms", measured<&targets::CurveError::rms>},
                 {"shape_max", measured<&targets::CurveError::max>}},
    .keeps_length = true};

}  // namespace kinetix::app
