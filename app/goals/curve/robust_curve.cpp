#include "app/goals/curve/robust_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "app/files/structure_section.hpp"
#include "app/goals/curve/curve_points.hpp"
#include "app/goals/curve/curve_search.hpp"
#include "app/pipeline/as_made.hpp"
#include "app/pipeline/matter.hpp"
#include "app/run/design_hinges.hpp"
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

CurveCandidate judged(const CurveFile& file, const optim::FreeCurveDesign& found, const StripOf& strip_of,
                      const RunOptions& options) {
  const optim::CurveDesign& design = found.design;
  CurveCandidate out{.columns = file.columns,
                     .cell_mm = file.size.edge_mm,
                     .theta = design.design.theta,
                     .shape_rms = design.error.rms,
                     .designed_mm = design.error.rms * design.error.scale_mm,
                     .as_made_mm = std::nan(""),
                     .as_made_p95 = std::nan("")};
  if (has_gap(file.hinge)) out.gap_mm = file.hinge.made->gap_mm;
  const Found strip = planned(strip_of(file, found));
  const model::Sheet& sheet = strip.design.structure;
  const auto printed = expected_of_prints(strip, goal_drive(strip, sheet, out.theta), strip.own,
                                          curve_points(file.curve, sheet, strip.own, strip.own));
  if (printed)
    std::tie(out.as_made_mm, out.as_made_p95) = std::pair{printed->made.rms_mm, printed->made.p95_mm};
  out.is_allowed = printed && printed->can_be_printed && found.walls_are_free &&
                   bears_its_strain(strip.design, strip.own) && design.error.rms <= file.shape_tolerance &&
                   (!options.printable || options.printable(asked_design(strip)).is_taken);
  return out;
}

Tried tried(const CurveFile& file, optim::MultiStartOptions search, const StripOf& strip_of,
            const RunOptions& options) {
  search.starts = std::min(search.starts, starts);
  Tried out{
      file, fit_free_curve(file.curve, curve_variables(file), file.size, search, file.shape_tolerance), {}};
  out.candidate = judged(file, out.found, strip_of, options);
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

/// Judges the plain strip and those whose closed forms promise most once more, with what makes up for their hinges.
/// @return the best of them
std::size_t best_in_matter(std::vector<Tried>& all, const StripJudge& judge, const RunOptions& options) {
  const double weight = *all.front().file.robust;
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin() + 1, order.end(), [&](std::size_t a, std::size_t b) {
    const CurveCandidate &one = all[a].candidate, &other = all[b].candidate;
    return is_more_robust(weight, one, other);
  });
  order.resize(std::min(order.size(), robust_finalists));
  std::size_t best = 0;
  for (std::size_t k = 0; k < order.size() && !options.stop.stop_requested(); ++k) {
    options.progress("robust search", static_cast<double>(k) / static_cast<double>(order.size()),
                     fmt::format("hinges of design {} of {}", k + 1, order.size()));
    CurveCandidate& one = all[order[k]].candidate;
    const RobustCandidate found = judge(all[order[k]].file, all[order[k]].found);
    one.designed_mm = found.designed_mm;
    one.as_made_mm = found.as_made_mm;
    one.as_made_p95 = found.as_made_p95;
    one.is_allowed = found.is_allowed;
    one.in_matter = true;
    if (k > 0 && is_more_robust(weight, one, all[best].candidate)) best = order[k];
  }
  return best;
}

RobustCurve chosen_of(std::vector<Tried> all, std::size_t best) {
  RobustCurve out;
  for (const Tried& one : all) out.tried.push_back(one.candidate);
  out.found = std::move(all[best].found);
  out.size = all[best].file.size;
  out.hinge = all[best].file.hinge;
  out.hinge_parts = all[best].file.hinge_parts;
  out.chosen = best;
  return out;
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
                         const optim::MultiStartOptions& search, const RunOptions& options,
                         const StripOf& strip_of, const StripJudge& judge) {
  std::vector<Tried> all = {{file, plain, judged(file, plain, strip_of, options)}};
  std::size_t best = 0;
  const auto take = [&](Tried next) {
    all.push_back(std::move(next));
    if (is_more_robust(*file.robust, all.back().candidate, all[best].candidate)) best = all.size() - 1;
  };
  const std::vector<int> columns = columns_of(file);
  const double rounds = static_cast<double>(columns.size()) * thetas;
  optim::MultiStartOptions quiet = search;
  quiet.ended = {};
  for (const int count : columns)
    for (int k = 0; k < thetas && !options.stop.stop_requested(); ++k) {
      options.progress("robust search", static_cast<double>(all.size() - 1) / rounds,
                       fmt::format("design {} of {:.0f}, prints of the best {:.2g} mm off", all.size(),
                                   rounds, all[best].candidate.as_made_mm));
      take(tried(with(file, count, theta_at(file, k)), quiet, strip_of, options));
    }
  if (has_gap(file.hinge)) {
    const Tried strip = all[best];
    for (const double share : strip_gap_shares)
      if (const auto other = with_gaps(strip.file, share); other && !options.stop.stop_requested())
        take({*other, strip.found, judged(*other, strip.found, strip_of, options)});
  }
  if (file.hinge.model == HingeSection::Model::elastic) best = best_in_matter(all, judge, options);
  return chosen_of(std::move(all), best);
}

}  // namespace kinetix::app
