#include "app/goals/curve/robust_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "app/files/structure_section.hpp"
#include "app/pipeline/as_made.hpp"
#include "app/pipeline/matter.hpp"
#include "app/pipeline/robust_search.hpp"
#include "app/run/design_hinges.hpp"
#include "model/base/invalid_input.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/lattice/lattice_motion.hpp"

namespace kinetix::app {
namespace {

// Numbers of columns to try, as ratios to the file's. Fewer columns have fewer hinge errors but larger design errors.
constexpr double column_shares[] = {1, 0.8, 0.65, 0.5};
// Number of starts per strip. The plain search uses more starts, and they lead to the same result.
constexpr int starts = 2;
constexpr int fewest_columns = 4;
// Gaps of elastomer and living hinges to try for the best strip, as ratios to the file's gap. Longer gaps turn more
// softly and are weaker across.
constexpr double strip_gap_shares[] = {0.5, 0.7, 1.4, 2};
// Margin (rad) below the theta at which basic cells with these walls close.
constexpr double below_closing = 0.02;

/// Returns the strip with its gaps scaled by `share`; nullopt if such a hinge cannot be made.
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

using FoundFor = std::function<Found(const CurveStrip&)>;

/// Fills in the candidate of a strip from its closed form and the first-order print tolerance.
CurveStrip judged(const Goal& goal, CurveStrip strip, const FoundFor& found_for, const RunOptions& options) {
  const optim::CurveDesign& design = strip.found.design;
  CurveCandidate out{not_judged(design.design.theta, strip.file.size.edge_mm, strip.file.hinge),
                     strip.file.columns, design.error.rms};
  out.designed_mm = design.error.rms * design.error.scale_mm;
  const Found found = planned(found_for(strip));
  const model::Lattice& sheet = found.design.structure;
  const auto printed = expected_of_prints(found, goal_drive(found, sheet, out.theta), found.own,
                                          goal.observe(found, sheet, found.own)->points);
  if (printed)
    std::tie(out.as_made_mm, out.as_made_p95) = std::pair{printed->made.rms_mm, printed->made.p95_mm};
  out.is_allowed = printed && printed->can_be_printed && !strip.found.contact.touches &&
                   withstands_strain(found.design, found.own) &&
                   design.error.rms <= strip.file.shape_tolerance &&
                   (!options.printable || options.printable(asked_design(found)).is_taken);
  strip.candidate = std::move(out);
  return strip;
}

/// Returns the k-th theta to try, rad.
double theta_at(const CurveFile& file, int k) {
  const double upper = std::min(file.theta.upper, closing_theta(file.size) - below_closing);
  return file.theta.lower + narrow_theta +
         (upper - file.theta.lower - 2 * narrow_theta) * k / (robust_thetas - 1);
}

/// Returns the file with theta fixed and, if the cell size is free, with cells that give the strip the curve's length.
CurveFile with(CurveFile file, int columns, double theta) {
  file.columns = columns;
  file.theta = {theta - narrow_theta / 2, theta + narrow_theta / 2};
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

/// Compensates the plain strip and the best strips by closed form for elastic hinges, and measures them again.
/// @return index of the best
std::size_t best_in_matter(const Goal& goal, std::vector<CurveStrip>& all, const FoundFor& found_for,
                           const RunOptions& options) {
  const double weight = *all.front().file.robust;
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin() + 1, order.end(), [&](std::size_t a, std::size_t b) {
    return is_more_robust(weight, all[a].candidate, all[b].candidate);
  });
  order.resize(std::min(order.size(), robust_finalists));
  RunOptions quiet = options;
  quiet.progress = {};
  std::size_t best = 0;
  for (std::size_t k = 0; k < order.size() && !options.stop.stop_requested(); ++k) {
    options.progress("robust search", static_cast<double>(k) / static_cast<double>(order.size()),
                     fmt::format("hinges of design {} of {}", k + 1, order.size()));
    CurveStrip& one = all[order[k]];
    static_cast<RobustCandidate&>(one.candidate) = robust_candidate(found_for(one), goal, quiet);
    one.candidate.in_matter = true;
    if (k > 0 && is_more_robust(weight, one.candidate, all[best].candidate)) best = order[k];
  }
  return best;
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

std::pair<CurveStrip, RobustCurve> robust_curve(const Goal& goal, CurveStrip plain,
                                                const optim::MultiStartOptions& search,
                                                const RunOptions& options, const FoundFor& found_for) {
  const CurveFile file = plain.file;
  std::vector<CurveStrip> all = {judged(goal, std::move(plain), found_for, options)};
  std::size_t best = 0;
  const auto take = [&](CurveStrip next) {
    all.push_back(judged(goal, std::move(next), found_for, options));
    if (is_more_robust(*file.robust, all.back().candidate, all[best].candidate)) best = all.size() - 1;
  };
  const std::vector<int> columns = columns_of(file);
  const double rounds = static_cast<double>(columns.size()) * robust_thetas;
  optim::MultiStartOptions quiet = search;
  quiet.ended = {};
  quiet.starts = std::min(search.starts, starts);
  for (const int count : columns)
    for (int k = 0; k < robust_thetas && !options.stop.stop_requested(); ++k) {
      options.progress("robust search", static_cast<double>(all.size() - 1) / rounds,
                       fmt::format("design {} of {:.0f}, prints of the best {:.2g} mm off", all.size(),
                                   rounds, all[best].candidate.as_made_mm));
      CurveFile next = with(file, count, theta_at(file, k));
      optim::FreeCurveDesign found =
          fit_free_curve(next.curve, curve_variables(next), next.size, quiet, next.shape_tolerance);
      take({std::move(next), std::move(found)});
    }
  if (has_gap(file.hinge)) {
    const CurveStrip strip = all[best];
    for (const double share : strip_gap_shares)
      if (const auto other = with_gaps(strip.file, share); other && !options.stop.stop_requested())
        take({*other, strip.found});
  }
  if (file.hinge.model == HingeSection::Model::elastic) best = best_in_matter(goal, all, found_for, options);
  RobustCurve choice{{}, best};
  for (const CurveStrip& one : all) choice.tried.push_back(one.candidate);
  return {std::move(all[best]), std::move(choice)};
}

}  // namespace kinetix::app
