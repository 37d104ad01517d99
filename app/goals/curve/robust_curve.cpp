#include "app/goals/curve/robust_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/files/structure_section.hpp"
#include "app/goals/curve/curve_points.hpp"
#include "app/goals/curve/curve_search.hpp"
#include "app/pipeline/as_made.hpp"
#include "app/pipeline/matter.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/sheet/sheet_motion.hpp"

namespace kinetix::app {
namespace {

// What is tried of theta: its whole range, in equal steps.
constexpr int thetas = 9;
// And of columns, over those of the file: fewer columns have fewer hinges to err, and follow the curve less well.
constexpr double column_shares[] = {1, 0.8, 0.65, 0.5};
// Of each strip's search: the plain one, of more, has found that they come to the same.
constexpr int starts = 2;
constexpr int fewest_columns = 4;
// rad: as narrow as a range may be; theta is what is tried.
constexpr double narrow = 1e-3;
// rad below the theta at which basic cells of these walls close.
constexpr double below_closing = 0.02;

struct Tried {
  CurveFile file;
  optim::FreeCurveDesign found;
  CurveCandidate candidate;
};

CurveCandidate judged(const CurveFile& file, const optim::FreeCurveDesign& found) {
  const optim::CurveDesign& design = found.design;
  CurveCandidate out{.columns = file.columns,
                     .cell_mm = file.size.edge_mm,
                     .theta = design.design.theta,
                     .shape_rms = design.error.rms,
                     .as_made_mm = std::nan(""),
                     .as_made_p95 = std::nan("")};
  Run run;
  run.structure = sheet_of(design.design, file.size);
  run.hinge = file.hinge;
  run.goal_drive = file.drive;
  run.process = file.process;
  run.physics = file.physics;
  const model::State state = exact_motion(run.structure).at(out.theta);
  const auto printed = expected_of_prints(run, goal_drive(run, run.structure, out.theta), state,
                                          curve_points(file.curve, run.structure, state, state));
  if (printed)
    std::tie(out.as_made_mm, out.as_made_p95) = std::pair{printed->made.rms_mm, printed->made.p95_mm};
  out.is_allowed =
      printed && printed->can_be_printed && found.walls_are_free && design.error.rms <= file.shape_tolerance;
  return out;
}

Tried tried(const CurveFile& file, optim::MultiStartOptions search) {
  search.starts = std::min(search.starts, starts);
  Tried out{file, fit_free_curve(file.curve, curve_variables(file), file.size, search), {}};
  out.candidate = judged(file, out.found);
  return out;
}

/// k-th of the values of theta that are tried, rad.
double theta_at(const CurveFile& file, int k) {
  const double upper = std::min(file.theta.upper, closing_theta(file.size) - below_closing);
  return file.theta.lower + narrow + (upper - file.theta.lower - 2 * narrow) * k / (thetas - 1);
}

/// The file with theta given, and cells that give the strip the curve's length.
CurveFile with(CurveFile file, int columns, double theta) {
  file.columns = columns;
  file.theta = {theta - narrow / 2, theta + narrow / 2};
  if (!file.free_size) return file;
  const double edge = file.curve.length() / (columns * std::cos(theta));
  const model::CellSize before = file.size;
  if (file.free_walls) file.size = default_size(edge);
  file.size.edge_mm = edge;
  if (file.hinge.made) file.hinge.made = fitted(*file.hinge.made, before, file.size);
  return file;
}

std::vector<int> columns_of(const CurveFile& file) {
  if (!file.free_size) return {file.columns};
  std::vector<int> all;
  for (const double share : column_shares) {
    const int columns = std::max(fewest_columns, static_cast<int>(std::lround(share * file.columns)));
    if (all.empty() || columns != all.back()) all.push_back(columns);
  }
  return all;
}

}  // namespace

RobustCurve robust_curve(const CurveFile& file, const optim::FreeCurveDesign& plain,
                         const optim::MultiStartOptions& search, const RunOptions& options) {
  RobustCurve out{plain, file.size, file.hinge, {judged(file, plain)}, 0};
  const std::vector<int> columns = columns_of(file);
  const double rounds = static_cast<double>(columns.size()) * thetas;
  optim::MultiStartOptions quiet = search;
  quiet.ended = {};
  for (const int count : columns)
    for (int k = 0; k < thetas && !options.stop.stop_requested(); ++k) {
      options.progress("robust search", static_cast<double>(out.tried.size() - 1) / rounds,
                       fmt::format("design {} of {:.0f}, prints of the best {:.2g} mm off", out.tried.size(),
                                   rounds, out.tried[out.chosen].as_made_mm));
      Tried next = tried(with(file, count, theta_at(file, k)), quiet);
      out.tried.push_back(next.candidate);
      const CurveCandidate& best = out.tried[out.chosen];
      const bool is_better =
          next.candidate.is_allowed && (!best.is_allowed || next.candidate.as_made_mm < best.as_made_mm);
      if (!is_better) continue;
      out.found = std::move(next.found);
      out.size = next.file.size;
      out.hinge = next.file.hinge;
      out.chosen = out.tried.size() - 1;
    }
  return out;
}

}  // namespace kinetix::app
