#pragma once

#include <array>
#include <optional>

#include "model/lattice/square/structure.hpp"

namespace kinetix::model {

/// A symmetry of the rectangle that a sheet's cells lie in: left and right alike, front and back, or both at once, as
/// after half a turn.
class SheetSymmetry {
 public:
  SheetSymmetry() = default;  ///< none
  SheetSymmetry(const Structure& sheet, bool mirrors_x, bool mirrors_y);

  bool any() const { return mirrors_x_ || mirrors_y_; }
  Cell image(const Cell& cell) const;
  /// The hinge on the image of a hinge's wall; nothing where there is none.
  std::optional<int> image(const Structure& sheet, int hinge) const;
  /// What `other`, the image of `hinge`, must be for both to be alike: points and axes are each other's image.
  HingeParameters image(const Structure& sheet, int hinge, int other) const;

 private:
  bool mirrors_x_ = false, mirrors_y_ = false;
  std::array<int, 2> extent_ = {};  ///< cells
};

/// Whether the sheet has that cell.
bool has_cell(const Structure& sheet, const Cell& cell);

/// Whether a cell lies beside the origin or beyond it in both directions.
bool is_countable(const Cell& cell);

}  // namespace kinetix::model
