#include "optim/fold/fit_box.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "model/base/invalid_input.hpp"

namespace kinetix::optim {
namespace {

using Lengths = std::array<double, 3>;

constexpr int usual_columns = 2;  // of a right angle: one makes walls meet early
constexpr double usual_theta =
    26 * radians_per_degree;  // rad, until a search has found one: that of most boxes
constexpr int fewest = 3,
              most = 10;  // cells along the shortest edge: fewer are no face, more nobody wants to print
constexpr double good = 0.019;  // a miss over the edge that more cells need not mend: 0.8 mm of 40
constexpr int telling = 4;      // cells along an edge: walls meet at creases, however wide the faces are
constexpr int rounds = 6;       // cells and theta depend on each other: two or three settle
constexpr double settled_edge =
    1e-9;  // change of the cell edge over itself: rounding, far below what a print shows

/// Lengths of the edges in pitches.
Lengths pitches(const std::array<int, 3>& edges, double inset) {
  Lengths out;
  for (int k = 0; k < 3; ++k) out[k] = edges[k] + 2 * inset;
  return out;
}

/// The pitch with which all edges miss alike.
double best_pitch(const Lengths& asked_mm, const Lengths& pitches) {
  double least = pitches[0] / asked_mm[0], largest = least;
  for (int k = 1; k < 3; ++k) {
    least = std::min(least, pitches[k] / asked_mm[k]);
    largest = std::max(largest, pitches[k] / asked_mm[k]);
  }
  return 2 / (least + largest);
}

/// Cells nearest to the edges, at a pitch in mm.
std::array<int, 3> cells_at(const Lengths& asked_mm, double pitch, double inset) {
  std::array<int, 3> out;
  for (int k = 0; k < 3; ++k)
    out[k] = std::max(1, static_cast<int>(std::lround(asked_mm[k] / pitch - 2 * inset)));
  return out;
}

double miss_at(const Lengths& asked_mm, Lengths in_pitches, double pitch) {
  for (double& length : in_pitches) length *= pitch;
  return size_miss(in_pitches, asked_mm);
}

/// Cells whose proportions come nearest, among few first.
std::array<int, 3> nearest_cells(const Lengths& asked_mm, double inset) {
  const double shortest = *std::min_element(asked_mm.begin(), asked_mm.end());
  std::array<int, 3> best = {};
  double least = std::numeric_limits<double>::infinity();
  for (int count = fewest; count <= most && !(least <= good); ++count) {
    const auto cells = cells_at(asked_mm, shortest / (count + 2 * inset), inset);
    if (*std::max_element(cells.begin(), cells.end()) > targets::max_face_side) break;
    const Lengths lengths = pitches(cells, inset);
    const double miss = miss_at(asked_mm, lengths, best_pitch(asked_mm, lengths));
    if (miss < least) std::tie(least, best) = std::pair{miss, cells};
  }
  if (!std::isfinite(least))
    throw InvalidInput(
        fmt::format("the longest edge of the box would take more than {} cells; its edges may differ by a "
                    "factor of {} at most",
                    targets::max_face_side, targets::max_face_side / fewest));
  return best;
}

class BoxSearch {
 public:
  explicit BoxSearch(const BoxOptions& options) : options_(options) {
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
  double inset() const { return targets::edge_inset(pi / 2, columns_); }

  void choose() {
    if (options_.edge_mm) {
      now_.edge_mm = *options_.edge_mm;
      now_.edges = cells_at(options_.asked_mm, now_.edge_mm * std::cos(theta_), inset());
    } else {
      now_.edges = nearest_cells(options_.asked_mm, inset());
      now_.edge_mm = best_pitch(options_.asked_mm, pitches(now_.edges, inset())) / std::cos(theta_);
    }
    now_.folded_mm = folded_box(now_.edges, now_.edge_mm, theta_, columns_);
  }

  /// What theta and columns such cells fold with. @return false where they do not
  bool look() {
    std::array<int, 3> edges = now_.edges;
    for (int& edge : edges) edge = std::min(edge, telling);
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
  double theta_ = usual_theta;  // rad
  int columns_ = usual_columns;
  BoxInCells now_;
};

}  // namespace

double size_miss(const Lengths& mm, const Lengths& asked_mm) {
  double most = 0;
  for (int k = 0; k < 3; ++k) most = std::max(most, std::abs(mm[k] - asked_mm[k]) / asked_mm[k]);
  return most;
}

Lengths folded_box(const std::array<int, 3>& edges, double edge_mm, double theta, int columns) {
  Lengths out = pitches(edges, targets::edge_inset(pi / 2, columns));
  for (double& length : out) length *= edge_mm * std::cos(theta);
  return out;
}

BoxInCells fit_box(const BoxOptions& options) { return BoxSearch(options).run(); }

}  // namespace kinetix::optim
