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
#include "app/run/run_hinges.hpp"
#include "model/base/invalid_input.hpp"
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
// Of the gaps of blocks and films of the best of them, over that of the file: longer ones turn softer, and are weaker
// across.
constexpr double strip_gap_shares[] = {0.5, 0.7, 1.4, 2};
// rad: as narrow as a range may be; theta is what is tried.
constexpr double narrow = 1e-3;
// rad below the theta at which basic cells of these walls close.
constexpr double below_closing = 0.02;

struct Tried {
  CurveFile file;
  optim::FreeCurveDesign found;
  CurveCandidate candidate;
};

bool has_gap(const HingeSection& hinge) { return hinge.made && hinge.made->gap_mm > 0; }

/// The same strip with other gaps; nothing where they cannot be made.
std::optional<CurveFile> with_gaps(CurveFile file, double share) {
  model::MadeHinge& made = *file.hinge.made;
  made.gap_mm *= share;
  try {
    validate(made, file.size);
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
  return file;
}

CurveCandidate judged(const CurveFile& file, const optim::FreeCurveDesign& found) {
  const optim::CurveDesign& design = found.design;
  CurveCandidate out{.columns = file.columns,
                     .cell_mm = file.size.edge_mm,
                     .theta = design.design.theta,
                     .shape_rms = design.error.rms,
                     .designed_mm = design.error.rms * design.error.scale_mm,
                     .as_made_mm = std::nan(""),
                     .as_made_p95 = std::nan("")};
  if (has_gap(file.hinge)) out.gap_mm = file.hinge.made->gap_mm;
  Run run;
  run.structure = sheet_of(design.design, file.size);
  run.hinge = file.hinge;
  run.own_hinges = own_hinges_of(run.structure, file.hinge_parts);
  run.goal_drive = file.drive;
  run.process = file.process;
  run.physics = file.physics;
  const model::State state = exact_motion(run.structure).at(out.theta);
  const auto printed = expected_of_prints(run, goal_drive(run, run.structure, out.theta), state,
                                          curve_points(file.curve, run.structure, state, state));
  if (printed)
    std::tie(out.as_made_mm, out.as_made_p95) = std::pair{printed->made.rms_mm, printed->made.p95_mm};
  out.is_allowed = printed && printed->can_be_printed && found.walls_are_free &&
                   bears_its_strain(run, state) && design.error.rms <= file.shape_tolerance;
  return out;
}

Tried tried(const CurveFile& file, optim::MultiStartOptions search) {
  search.starts = std::min(search.starts, starts);
  Tried out{
      file, fit_free_curve(file.curve, curve_variables(file), file.size, search, file.shape_tolerance), {}};
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
  const auto fit = [&](HingeSection& hinge) {
    if (hinge.made) hinge.made = fitted(*hinge.made, before, file.size);
  };
  fit(file.hinge);
  for (HingePart& part : file.hinge_parts) fit(part.hinge);
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
  RobustCurve out{plain, file.size, file.hinge, file.hinge_parts, {judged(file, plain)}, 0};
  const std::vector<int> columns = columns_of(file);
  const double rounds = static_cast<double>(columns.size()) * thetas;
  optim::MultiStartOptions quiet = search;
  quiet.ended = {};
  CurveFile best_file = file;
  const auto take = [&](Tried next) {
    out.tried.push_back(next.candidate);
    if (!is_more_robust(*file.robust, next.candidate, out.tried[out.chosen])) return;
    out.found = std::move(next.found);
    out.size = next.file.size;
    out.hinge = next.file.hinge;
    out.hinge_parts = next.file.hinge_parts;
    out.chosen = out.tried.size() - 1;
    best_file = std::move(next.file);
  };
  for (const int count : columns)
    for (int k = 0; k < thetas && !options.stop.stop_requested(); ++k) {
      options.progress("robust search", static_cast<double>(out.tried.size() - 1) / rounds,
                       fmt::format("design {} of {:.0f}, prints of the best {:.2g} mm off", out.tried.size(),
                                   rounds, out.tried[out.chosen].as_made_mm));
      take(tried(with(file, count, theta_at(file, k)), quiet));
    }
  if (!has_gap(file.hinge)) return out;
  const CurveFile strip = best_file;
  const optim::FreeCurveDesign found = out.found;
  for (const double share : strip_gap_shares)
    if (const auto other = with_gaps(strip, share); other && !options.stop.stop_requested())
      take({*other, found, judged(*other, found)});
  return out;
}

}  // namespace kinetix::app
