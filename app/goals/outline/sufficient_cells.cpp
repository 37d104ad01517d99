#include "app/goals/outline/sufficient_cells.hpp"

#include <fmt/format.h>
#include <cmath>

#include "model/base/invalid_input.hpp"
#include "model/lattice/planar/regular_lattices.hpp"

namespace kinetix::app {
namespace {

constexpr double more_cells = 1.25;  // ratio of sides from one try to the next
// Share of the estimated side that is tried first: errors shrink as the cells do, or faster.
constexpr double first_side = 0.75;
constexpr int largest_side = 64;  // columns or rows
// Walls of all tries together: of the file's lattice, and with the others.
constexpr int most_tried_walls = 8'000, most_walls_in_all = 12'000;
// Sides of other lattices, relative to those of squares with as many walls.
constexpr double other_sides = 0.6;

/// Tries panels one after the other.
class CellLadder {
 public:
  CellLadder(const OutlineFile& file, const RunOptions& options) : file_(file), options_(options) {
    silent_.threads = options.threads;
    silent_.seed = options.seed;
    silent_.stop = options.stop;
  }

  /// Searches a panel with `side` columns or rows. @return whether it meets the goal
  bool meets(OutlineFile file, int side) {
    const double share = static_cast<double>(side) / std::max(file_.columns, file_.rows);
    file.columns = std::max(1, static_cast<int>(std::lround(share * file_.columns)));
    file.rows = std::max(1, static_cast<int>(std::lround(share * file_.rows)));
    options_.progress("search", -1);
    try {
      const FoundOutline found = search_alone(file, silent_);
      tried_walls_ += static_cast<int>(found.design.panel.graph.edges.size());
      if (found.design.stopped || !is_met(file, found.design)) return false;
    } catch (const InvalidInput&) {
      return false;  // walls that the file gives are too thick for such cells
    }
    std::string keys;
    if (file.lattice.name() != file_.lattice.name())
      keys += fmt::format("lattice: {}, ", file.lattice.name());
    if (file.trims != file_.trims) keys += "trim: outline, ";
    keys_ = fmt::format("structure: {{{}cells: [{}, {}]}}", keys, file.columns, file.rows);
    return true;
  }

  bool has_ended(int most_walls) const {
    return tried_walls_ >= most_walls || options_.stop.stop_requested();
  }
  const std::string& keys() const { return keys_; }

 private:
  const OutlineFile& file_;
  const RunOptions& options_;
  RunOptions silent_;
  int tried_walls_ = 0;
  std::string keys_;
};

int to_even(double side) { return 2 * static_cast<int>(std::ceil(side / 2 - 1e-9)); }

/// Climbs from a side to the largest. @return whether a panel meets the goal
bool climb(CellLadder& ladder, const OutlineFile& file, int first, int most_walls) {
  for (int side = first; side <= largest_side && !ladder.has_ended(most_walls);
       side = to_even(more_cells * side))
    if (ladder.meets(file, side)) return true;
  return false;
}

}  // namespace

std::string find_sufficient_cells(const OutlineFile& file, const optim::OutlineDesign& missed,
                                  const RunOptions& options) {
  const int side = std::max(file.columns, file.rows);
  CellLadder ladder(file, options);
  OutlineFile cut = file;
  cut.trims = !file.flat;
  if (cut.trims != file.trims && ladder.meets(cut, side)) return ladder.keys();
  const auto excess = [&](const targets::OutlineError& error) {
    const double shared = std::isfinite(error.iou) ? error.iou : 0;
    return std::max(error.rms / file.shape_tolerance,
                    (1 - shared) / (1 - std::min(0.99, file.iou_tolerance)));
  };
  const double estimate = side * std::max(excess(missed.error), file.flat ? excess(missed.flat) : 0);
  const int next = to_even(std::max(side + 2.0, std::min(first_side * estimate, 0.6 * largest_side)));
  if (climb(ladder, cut, next, most_tried_walls)) return ladder.keys();
  if (file.flat) return "";
  for (const model::PlanarLattice* lattice : {&model::octagon_lattice, &model::honeycomb_lattice}) {
    if (file.lattice.lattice == lattice) continue;
    cut.lattice.lattice = lattice;
    cut.lattice.closed_boundary = true;
    if (climb(ladder, cut, to_even(other_sides * next), most_walls_in_all)) return ladder.keys();
  }
  return "";
}

}  // namespace kinetix::app
