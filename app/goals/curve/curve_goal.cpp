#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/goals/curve/curve_kind.hpp"
#include "app/goals/curve/curve_outcome.hpp"
#include "app/goals/curve/curve_points.hpp"
#include "app/goals/curve/curve_search.hpp"
#include "app/pipeline/robust_search.hpp"
#include "app/run/midline.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {
namespace {

// Measured: s a start of 40 columns; it grows with their number to 1.5.
constexpr double seconds_a_start = 0.0075;
// Likewise how many times that where a search is repeated, for tilts that are gentle or walls that stay apart: of curves that
// turn that far, rad, by all their columns, or by one of them.
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

/// What of `variables.beta` ties the tilts of columns to each other, as a file asks for it; empty: nothing.
std::string tied_tilts(const CurveFile& file) {
  std::string out = file.per == optim::Per::all ? "`per: all`" : "";
  if (file.symmetry != optim::Symmetry::none) out += out.empty() ? "`symmetry`" : " and `symmetry`";
  return out;
}

/// Of the ranges that the file gives, and of what walls that meet leave of them.
std::vector<std::string> why_too_far(const CurveFile& file, const optim::FreeCurveDesign& found) {
  std::vector<std::string> why = found.design.reach.obstacles;
  const double rms = found.design.error.rms;
  if (!found.narrowed.empty())
    why.push_back(
        fmt::format("no start whose walls stay apart came closer than {:.3g} of the diagonal; {}: use lower "
                    "or thinner walls, or more cells",
                    rms, found.narrowed));
  const std::string tied = tied_tilts(file);
  if (why.empty())
    why.push_back(
        fmt::format("no start came closer than {:.3g} of the diagonal, although every column by itself can "
                    "bend enough: {}",
                    rms,
                    tied.empty() ? "use more or smaller cells"
                                 : "leave out " + tied + ", by which their tilts depend on each other"));
  return why;
}

/// Returns what walls are in the way and what helps. @pre !found.walls_are_free
std::string obstacle(const optim::FreeCurveDesign& found) {
  return found.notes.back() + ": use lower or thinner walls, or larger cells";
}

std::vector<std::string> violations(const CurveFile& file, const optim::FreeCurveDesign& found) {
  std::vector<std::string> why;
  if (!(found.design.error.rms <= file.shape_tolerance)) why = why_too_far(file, found);
  if (!found.walls_are_free) why.push_back(obstacle(found));
  return why;
}

class CurveGoal final : public Goal {
 public:
  explicit CurveGoal(CurveFile file) : Goal(file.name), file_(std::move(file)) {}

  const targets::Curve& curve() const { return file_.curve; }

  Forecast forecast() const override {
    Forecast out{sheet_of(model::ExactDesign<double>::basic(file_.columns, file_.rows), file_.size)};
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& point : file_.curve.points()) box.extend(point);
    out.folded_mm = {box.sizes().x(), file_.rows * file_.size.edge_mm, box.sizes().y()};
    out.search_s = seconds_a_start * file_.solver.starts.value_or(optim::MultiStartOptions{}.starts) *
                   std::pow(file_.columns / 40.0, 1.5) * repeats(file_.curve, file_.columns);
    if (file_.robust) out.search_s *= robust_designs;
    add_settings(file_, out);
    if (file_.robust)
      out.search_s += static_cast<double>(robust_finalists) * matter_seconds(file_, out.sheet);
    return out;
  }

  Found search(const RunOptions& options) const override {
    const optim::MultiStartOptions search = curve_search(file_, options);
    options.progress("search", 0);
    optim::FreeCurveDesign found =
        fit_free_curve(file_.curve, curve_variables(file_), file_.size, search, file_.shape_tolerance);
    if (!file_.robust) return found_for(file_, std::move(found));
    RunOptions quiet = options;
    quiet.progress = {};
    const StripOf strip_of = [&](const CurveFile& file, const auto& strip) { return found_for(file, strip); };
    RobustCurve robust =
        robust_curve(file_, found, search, options, strip_of, [&](const CurveFile& file, const auto& strip) {
          return robust_candidate(strip_of(file, strip), *this, quiet);
        });
    CurveFile chosen = file_;
    chosen.size = robust.size;
    chosen.hinge = robust.hinge;
    chosen.hinge_parts = robust.hinge_parts;
    optim::FreeCurveDesign strip = robust.found;
    return found_for(chosen, std::move(strip), std::move(robust));
  }

  /// In the equilibrium how elastic hinges keep the goal. The physics run is judged by its distance from the model alone.
  std::shared_ptr<const Measure> measure(const Run& run, StateOf of, const model::State& state,
                                         const RunOptions&) const override {
    if (of == StateOf::physics) return nullptr;
    const optim::FreeCurveDesign& found = outcome_of<CurveOutcome>(run).found;
    auto out = std::make_shared<CurveMeasure>();
    if (of == StateOf::model) {
      out->midline_mm = found.design.midline_mm;
      out->error = found.design.error;
      out->violations = violations(file_, found);
      return out;
    }
    out->midline_mm = column_midline(run.design.structure, aligned(state, run.own));
    out->error = curve_error(out->midline_mm, file_.curve);
    if (!(out->error.rms <= file_.shape_tolerance))
      out->violations.push_back(
          fmt::format("equilibrium: rms {:.3g} of the goal's diagonal; at most {:g} is allowed",
                      out->error.rms, file_.shape_tolerance));
    if (!found.walls_are_free) out->violations.push_back(obstacle(found));
    return out;
  }

  /// Each column's place against the goal as it was laid over the midline.
  std::optional<Observed> observe(const Found& found, const model::Sheet& sheet,
                                  const model::State& state) const override {
    const targets::CurveError& error = outcome_of<CurveOutcome>(found).found.design.error;
    return Observed{curve_points(file_.curve, sheet, state, found.own),
                    file_.shape_tolerance * error.scale_mm};
  }

 private:
  TurnBounds bounds() const {
    const double tilt = std::max(std::abs(file_.beta.lower), std::abs(file_.beta.upper));
    return {tilt, file_.theta,
            [rows = file_.rows, per = file_.per, symmetry = file_.symmetry,
             beta = file_.beta](const model::Sheet& sheet) {
              const model::Structure& strip = *sheet.squares();
              const int columns = static_cast<int>(strip.cells.size()) / rows;
              return tied_tilts(strip, make_bend_ties(columns, per, symmetry, beta));
            }};
  }

  /// A strip that was found for a file.
  Found found_for(const CurveFile& file, optim::FreeCurveDesign strip,
                  std::optional<RobustCurve> robust = {}) const {
    Found out;
    take_settings(out, file);
    out.tolerances = {{"shape", file.shape_tolerance}};
    out.design.structure = sheet_of(strip.design.design, file.size);
    out.theta = strip.design.design.theta;
    out.is_strip = true;
    out.is_laid_over = true;
    out.bounds = bounds();
    out.notes = strip.notes;
    auto curve = std::make_unique<CurveOutcome>();
    curve->shape_tolerance = file.shape_tolerance;
    curve->target_mm = file.curve.points();
    curve->solver = curve_search(file, {}).solver;
    curve->found = std::move(strip);
    curve->robust = std::move(robust);
    out.goal = std::move(curve);
    return out;
  }

  CurveFile file_;
};

template <double targets::CurveError::*part>
double measured(const Goal& goal, const model::Sheet& structure, const model::State& state) {
  return curve_error(column_midline(structure, state), dynamic_cast<const CurveGoal&>(goal).curve()).*part;
}

}  // namespace

std::unique_ptr<Goal> make_goal(CurveFile file) { return std::make_unique<CurveGoal>(std::move(file)); }

// The kind for the registry (app/goals/registry.cpp), and its metrics with their units.
const GoalKind curve_kind = {
    .name = "curve",
    .example = "target: {kind: curve, points: points.csv}",
    .read = [](const targets::Node& root) { return make_goal(read_curve_file(root)); },
    .table = curve_keys,
    .metrics = {{"shape_rms", "",
                 "[distance of midline and goal](#shape_rms-and-shape_max), root mean square"},
                {"shape_max", "", "likewise, the largest"}},
    .measures = {{"shape_rms", measured<&targets::CurveError::rms>},
                 {"shape_max", measured<&targets::CurveError::max>}}};

}  // namespace kinetix::app
