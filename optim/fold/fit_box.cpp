#include "optim/fold/fit_box.hpp"

#include <fmt/format.h>

#include <limits>
#include <tuple>

#include "model/base/invalid_input.hpp"

namespace kinetix::optim {
namespace {

using Lengths = std::array<double, 3>;

constexpr int typical_columns = 2;  // of a right angle: with one, walls meet early
constexpr double typical_theta =
    26 * radians_per_degree;    // rad, until a search has found one: typical of boxes
constexpr int fewest = 3;       // cells along the shortest edge: fewer hardly form a face
constexpr double good = 0.019;  // relative miss that needs no finer cells: 0.8 mm of 40
constexpr int rounds = 6;       // cells and theta depend on each other: two or three rounds settle
constexpr double settled_edge =
    1e-9;  // change of the cell edge over itself: rounding, far below the resolution of a print

/// Returns the pitches that creases of `columns` columns add along x, y and z: one inset at either end, none
/// at the end of an omitted face.
Lengths insets(const std::optional<int>& open, int columns) {
  const double inset = targets::edge_inset(pi / 2, columns);
  Lengths out = {2 * inset, 2 * inset, 2 * inset};
  if (open) out[targets::box_face_axis(*open)] = inset;
  return out;
}

/// Returns the lengths of the edges in pitches.
Lengths pitches(const std::array<int, 3>& edges, const Lengths& insets) {
  Lengths out;
  for (int k = 0; k < 3; ++k) out[k] = edges[k] + insets[k];
  return out;
}

/// Returns the pitch at which the largest and the smallest edge have equal relative errors.
double best_pitch(const Lengths& required_mm, const Lengths& pitches) {
  double least = pitches[0] / required_mm[0], largest = least;
  for (int k = 1; k < 3; ++k) {
    least = std::min(least, pitches[k] / required_mm[k]);
    largest = std::max(largest, pitches[k] / required_mm[k]);
  }
  return 2 / (least + largest);
}

/// Returns the cells nearest to the edges, at a pitch in mm.
std::array<int, 3> cells_at(const Lengths& required_mm, double pitch, const Lengths& insets) {
  std::array<int, 3> out;
  for (int k = 0; k < 3; ++k)
    out[k] = std::max(1, static_cast<int>(std::lround(required_mm[k] / pitch - insets[k])));
  return out;
}

double miss_at(const Lengths& required_mm, Lengths in_pitches, double pitch) {
  for (double& length : in_pitches) length *= pitch;
  return size_miss(in_pitches, required_mm);
}

/// Returns the cells of a box with `count` cells along the shortest edge.
std::array<int, 3> cells_with_shortest(const Lengths& required_mm, int count, const Lengths& insets) {
  const auto shortest = std::min_element(required_mm.begin(), required_mm.end());
  return cells_at(required_mm, *shortest / (count + insets[shortest - required_mm.begin()]), insets);
}

/// Returns the cells with the nearest proportions. Fewer cells win if they are good enough.
std::array<int, 3> nearest_cells(const Lengths& required_mm, const Lengths& insets) {
  std::array<int, 3> best = {};
  double least = std::numeric_limits<double>::infinity();
  for (int count = fewest; count <= max_cells_across && !(least <= good); ++count) {
    const auto cells = cells_with_shortest(required_mm, count, insets);
    if (*std::max_element(cells.begin(), cells.end()) > targets::max_face_side) break;
    const Lengths lengths = pitches(cells, insets);
    const double miss = miss_at(required_mm, lengths, best_pitch(required_mm, lengths));
    if (miss < least) std::tie(least, best) = std::pair{miss, cells};
  }
  if (!std::isfinite(least))
    throw InvalidInput(
        fmt::format("the longest edge of the box needs more than {} cells. Give edges that differ by a "
                    "factor of at most {}",
                    targets::max_face_side, targets::max_face_side / fewest));
  return best;
}

class BoxSearch {
 public:
  /// @param shortest cells along the shortest edge; 0: any
  explicit BoxSearch(const BoxOptions& options, int shortest = 0) : options_(options), shortest_(shortest) {
    if (options.crease_columns > 0) columns_ = options.crease_columns;
  }

  BoxInCells run() {
    choose();
    for (int round = 0; round < rounds; ++round) {
      const BoxInCells before = now_;
      if (!look()) break;
      choose();
      if (now_.edges == before.edges &&
          std::abs(now_.edge_mm - before.edge_mm) <= settled_edge * now_.edge_mm)
        break;
    }
    return now_;
  }

 private:
  Lengths added() const { return insets(options_.open, columns_); }

  void choose() {
    if (options_.edge_mm) {
      now_.edge_mm = *options_.edge_mm;
      now_.edges = cells_at(options_.required_mm, now_.edge_mm * std::cos(theta_), added());
    } else {
      now_.edges = shortest_ > 0 ? cells_with_shortest(options_.required_mm, shortest_, added())
                                 : nearest_cells(options_.required_mm, added());
      now_.edge_mm = best_pitch(options_.required_mm, pitches(now_.edges, added())) / std::cos(theta_);
    }
    now_.folded_mm = folded_box(now_.edges, options_.open, now_.edge_mm, theta_, columns_);
  }

  /// Sets theta and the columns from the fold of a small box of such cells. @return whether it folds
  bool look() {
    std::array<int, 3> edges = now_.edges;
    for (int& edge : edges) edge = std::min(edge, test_box_cells);
    FoldOptions fold = options_.fold;
    fold.size = options_.size(now_.edge_mm);
    const FoldDesign design =
        fit_fold(targets::box_goal(edges, options_.open, options_.crease_columns), fold);
    if (!design.folds) return false;
    theta_ = design.folded.theta;
    columns_ = design.folded.layout.creases[0].columns();
    return true;
  }

  const BoxOptions& options_;
  const int shortest_;
  double theta_ = typical_theta;  // rad
  int columns_ = typical_columns;
  BoxInCells now_;
};

constexpr double proposed_parts_per_mm = 100;  // per mm: cell edges are proposed in whole parts
constexpr double thickest_share = 0.5;         // of a cell edge: thicker walls leave no room between them

/// Returns the smallest possible miss with `shortest` cells along the shortest edge, for any cell edge and
/// theta.
double min_miss(const BoxOptions& options, int shortest) {
  const int given = options.crease_columns;
  double least = std::numeric_limits<double>::infinity();
  for (int columns = std::max(given, 1); columns <= (given > 0 ? given : targets::max_crease_columns);
       ++columns) {
    const Lengths added = insets(options.open, columns);
    const Lengths lengths = pitches(cells_with_shortest(options.required_mm, shortest, added), added);
    least = std::min(least, miss_at(options.required_mm, lengths, best_pitch(options.required_mm, lengths)));
  }
  return least;
}

/// Returns the box with the cell edge of the options as a search folds it, or nullopt if its size misses by
/// more than the tolerance.
std::optional<BoxInCells> folded_within(const BoxOptions& options, double tolerance) {
  BoxInCells box = fit_box(options);
  FoldOptions fold = options.fold;
  fold.size = options.size(box.edge_mm);
  const FoldDesign design =
      fit_fold(targets::box_goal(box.edges, options.open, options.crease_columns), fold);
  if (!design.folds) return std::nullopt;
  box.folded_mm = folded_box(box.edges, options.open, box.edge_mm, design.folded.theta,
                             design.folded.layout.creases[0].columns());
  return size_miss(box.folded_mm, options.required_mm) <= tolerance ? std::optional(box) : std::nullopt;
}

/// @param shortest cells along the shortest edge
std::optional<BoxInCells> folded_with(BoxOptions options, int shortest, double tolerance) {
  if (!(min_miss(options, shortest) <= tolerance)) return std::nullopt;
  options.edge_mm.reset();
  const BoxInCells about = BoxSearch(options, shortest).run();
  if (*std::max_element(about.edges.begin(), about.edges.end()) > targets::max_face_side) return std::nullopt;
  if (!(size_miss(about.folded_mm, options.required_mm) <= tolerance)) return std::nullopt;
  options.edge_mm = std::round(about.edge_mm * proposed_parts_per_mm) / proposed_parts_per_mm;
  if (!(options.size(*options.edge_mm).thickness_mm < thickest_share * *options.edge_mm)) return std::nullopt;
  return folded_within(options, tolerance);
}

}  // namespace

double size_miss(const Lengths& mm, const Lengths& required_mm) {
  double most = 0;
  for (int k = 0; k < 3; ++k) most = std::max(most, std::abs(mm[k] - required_mm[k]) / required_mm[k]);
  return most;
}

Lengths folded_box(const std::array<int, 3>& edges, const std::optional<int>& open, double edge_mm,
                   double theta, int columns) {
  Lengths out = pitches(edges, insets(open, columns));
  for (double& length : out) length *= edge_mm * std::cos(theta);
  return out;
}

BoxInCells fit_box(const BoxOptions& options) { return BoxSearch(options).run(); }

std::optional<BoxInCells> other_cells(const BoxOptions& options, double tolerance) {
  for (int shortest = 1; shortest <= max_cells_across && !options.fold.stop.stop_requested(); ++shortest)
    try {
      if (const auto box = folded_with(options, shortest, tolerance)) return box;
    } catch (const InvalidInput&) {
      continue;  // such cells have no room for the walls
    }
  return std::nullopt;
}

std::vector<std::array<int, 3>> tried_cells(const BoxOptions& options, double tolerance) {
  const Lengths added =
      insets(options.open, options.crease_columns > 0 ? options.crease_columns : typical_columns);
  std::vector<std::array<int, 3>> out;
  for (int shortest = 1; shortest <= max_cells_across; ++shortest) {
    if (!(min_miss(options, shortest) <= tolerance)) continue;
    const auto cells = cells_with_shortest(options.required_mm, shortest, added);
    if (*std::max_element(cells.begin(), cells.end()) <= targets::max_face_side) out.push_back(cells);
  }
  return out;
}

}  // namespace kinetix::optim
