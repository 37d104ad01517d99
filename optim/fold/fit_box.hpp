#pragma once

#include "optim/fold/fit_fold.hpp"

namespace kinetix::optim {

/// Box of given size, in cells.
struct BoxInCells {
  std::array<int, 3> edges = {1, 1, 1};  ///< cells
  double edge_mm = 0;                    ///< of a flat cell
  std::array<double, 3> folded_mm = {};  ///< edges of the folded solid
};

/// Returns the largest difference of two boxes' edges, relative to the edges of the second.
double size_miss(const std::array<double, 3>& mm, const std::array<double, 3>& required_mm);

/// Returns the edges of the solid that a box of these cells folds to. Faces shrink by cos(theta), and each
/// crease adds an inset (targets::edge_inset) at either end. The end of the omitted face has none.
/// @param open the omitted face, by box_face_names   @param theta rad   @param columns of a crease, >= 1
std::array<double, 3> folded_box(const std::array<int, 3>& edges, const std::optional<int>& open,
                                 double edge_mm, double theta, int columns);

struct BoxOptions {
  std::array<double, 3> required_mm = {};               ///< > 0
  std::optional<int> open = {};                         ///< the omitted face, by box_face_names
  int crease_columns = 0;                               ///< 0: chosen by the search
  std::optional<double> edge_mm = {};                   ///< of a cell, if given
  FoldOptions fold = {};                                ///< its size is set here
  std::function<model::CellSize(double edge_mm)> size;  ///< walls for a cell edge
};

/// Returns the cells and their edge with which the folded box is nearest to its size. The folded size depends
/// on theta and the columns of the creases. fit_fold finds both for a box of at most four cells per edge. The
/// result has the fewest cells that miss no edge by more than 1.9 %. If a box does
/// not fold, the result is for the last theta and columns, at first the usual ones.
/// @throws InvalidInput if the cells would be more than targets::max_face_side, or the box thinner than its
/// creases
BoxInCells fit_box(const BoxOptions& options);

inline constexpr int test_box_cells = 4;  ///< along an edge of the test box: walls meet at creases, however
                                          ///< wide faces are
inline constexpr int max_cells_across = 10;  ///< along the shortest edge: finer sheets are impractical to
                                             ///< print

/// Returns large cells with which a box folds and misses its edges by at most `tolerance`. fit_box and
/// fit_fold check the box with this edge given. Tries 1, 2 and so on cells along the shortest edge and
/// returns the first that succeeds. Cell edges are whole hundredths of a mm. Returns nullopt if none up to
/// max_cells_across succeeds.
/// @param options their cell edge has no effect   @param tolerance ratio, > 0
std::optional<BoxInCells> other_cells(const BoxOptions& options, double tolerance);

/// Returns the edges, in cells, of boxes whose proportions are near enough: those that other_cells tried in
/// vain.
std::vector<std::array<int, 3>> tried_cells(const BoxOptions& options, double tolerance);

}  // namespace kinetix::optim
