#include "app/goals/outline/outline_search.hpp"

#include <fmt/format.h>
#include <cmath>

#include "model/lattice/planar/regular_lattices.hpp"

namespace kinetix::app {
namespace {

using targets::DocumentChanges;

constexpr double more_cells = 1.25;  // ratio of sides from one change to the next
// Share of the estimated side that comes first: errors shrink as the cells do, or faster.
constexpr double first_side = 0.75;
constexpr int largest_side = 64;  // columns or rows
// Walls of all changes together: of the file's lattice, and with the others. Their searches take about half a minute.
constexpr int most_walls = 4'000, most_walls_in_all = 6'000;
// Sides of other lattices, relative to those of squares with as many walls.
constexpr double other_sides = 0.6;

int to_even(double side) { return 2 * static_cast<int>(std::ceil(side / 2 - 1e-9)); }

/// Adds changes to more and more columns and rows.
class CellLadder {
 public:
  explicit CellLadder(const OutlineFile& file) : file_(file), side_(std::max(file.columns, file.rows)) {}

  int side() const { return side_; }

  /// Adds one panel with `side` columns or rows. @param lattice empty for the file's
  void add(int side, const std::string& trim, const std::string& lattice = "") {
    const double share = static_cast<double>(side) / side_;
    const int columns = std::max(1, static_cast<int>(std::lround(share * file_.columns)));
    const int rows = std::max(1, static_cast<int>(std::lround(share * file_.rows)));
    DocumentChanges change = {{"structure.cells", fmt::format("[{}, {}]", columns, rows)}};
    if (!lattice.empty()) change.emplace_back("structure.lattice", lattice);
    if (!trim.empty()) change.emplace_back("structure.trim", trim);
    changes_.push_back(std::move(change));
    walls_ += 2 * columns * rows;
  }

  /// Adds panels from a side to the largest, until they have a number of walls together.
  void climb(int first, int walls, const std::string& trim, const std::string& lattice = "") {
    for (int side = first; side <= largest_side && walls_ < walls; side = to_even(more_cells * side))
      add(side, trim, lattice);
  }

  std::vector<DocumentChanges> changes() && { return std::move(changes_); }

 private:
  const OutlineFile& file_;
  const int side_;
  int walls_ = 0;
  std::vector<DocumentChanges> changes_;
};

}  // namespace

double outline_excess(const OutlineFile& file, const targets::OutlineError& error) {
  const double shared = std::isfinite(error.iou) ? error.iou : 0;
  return std::max(error.rms / file.shape_tolerance, (1 - shared) / (1 - std::min(0.99, file.iou_tolerance)));
}

std::vector<DocumentChanges> outline_remedies(const OutlineFile& file, const optim::OutlineDesign& missed) {
  CellLadder ladder(file);
  const int side = ladder.side();
  const std::string trim = file.trims == !file.flat ? "" : file.flat ? "none" : "outline";
  if (!trim.empty()) ladder.add(side, trim);
  const double excess =
      std::max(outline_excess(file, missed.error), file.flat ? outline_excess(file, missed.flat) : 0);
  const int next = to_even(std::max(side + 2.0, std::min(first_side * side * excess, 0.6 * largest_side)));
  ladder.climb(next, most_walls, trim);
  if (!file.flat)
    for (const model::PlanarLattice* lattice : {&model::octagon_lattice, &model::honeycomb_lattice})
      if (file.lattice.lattice != lattice)
        ladder.climb(to_even(other_sides * next), most_walls_in_all, trim, std::string(lattice->name));
  return std::move(ladder).changes();
}

}  // namespace kinetix::app
