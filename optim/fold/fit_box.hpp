#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "optim/fold/fit_fold.hpp"

namespace kinetix::optim {

/// A box of given size, as cells.
struct BoxInCells {
  std::array<int, 3> edges = {1, 1, 1};  ///< cells
  double edge_mm = 0;                    ///< of a cell, flat
  std::array<double, 3> folded_mm = {};  ///< edges of the solid that it folds to
};

/// The largest difference of two boxes' edges, over the edges of the second.
double size_miss(const std::array<double, 3>& mm, const std::array<double, 3>& asked_mm);

/// Edges of the solid that a box of these cells folds to: faces shrink by cos(theta), and each crease adds an inset at
/// both ends (targets::edge_inset), but for the end of a face that is left out.
/// @param open that face, by box_face_names   @param theta rad   @param columns of a crease, >= 1
std::array<double, 3> folded_box(const std::array<int, 3>& edges, const std::optional<int>& open,
                                 double edge_mm, double theta, int columns);

struct BoxOptions {
  std::array<double, 3> asked_mm = {};                  ///< > 0
  std::optional<int> open = {};                         ///< the face left out, by box_face_names
  int crease_columns = 0;                               ///< 0: for the search to choose
  std::optional<double> edge_mm = {};                   ///< of a cell, where it is given
  FoldOptions fold = {};                                ///< its size is set here
  std::function<model::CellSize(double edge_mm)> size;  ///< walls that go with a cell edge
};

/// Cells and their edge, so that the folded box comes nearest to its size: theta and the columns of the creases, on
/// which the folded size depends, are those that fit_fold finds for a box of at most four cells an edge. As few cells as miss no edge by more than 1.9 %. Where nothing folds, what would have the size if it did.
/// @throws InvalidInput where the cells would be more than targets::max_face_side, or the box thinner than its creases
BoxInCells fit_box(const BoxOptions& options);

inline constexpr int telling_cells = 4;  ///< along an edge: walls meet at creases, however wide the faces are
inline constexpr int most_cells_across = 10;  ///< along the shortest edge: more nobody wants to print

/// Large cells, their edge in whole hundredths of a mm, of which a box folds whose edges miss by no more than a share of them, as
/// fit_box and fit_fold find it where the edge is given: of 1, 2 and so on cells along the shortest edge the first. Nothing where none
/// up to most_cells_across does. @param options whose own edge does not count   @param tolerance ratio, > 0
std::optional<BoxInCells> other_cells(const BoxOptions& options, double tolerance);

/// Edges, in cells, of the boxes that other_cells folds where none of them does: those whose proportions come near enough.
std::vector<std::array<int, 3>> tried_cells(const BoxOptions& options, double tolerance);

}  // namespace kinetix::optim
