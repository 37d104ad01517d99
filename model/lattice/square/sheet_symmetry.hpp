#pragma once

#include "model/lattice/square/structure.hpp"

namespace kinetix::model {

/// Motions of the plane that may map a panel onto itself.
enum class PlaneMotion { none, mirror_x, mirror_y, half_turn, quarter_turn };

/// Image of a wall under a motion.
struct WallImage {
  int hinge = 0;
  bool reversed = false;  ///< true: its ends are exchanged
};

/// Returns the image of a hinge's wall. @pre the panel is a rectangle from [0, 0]; square for a quarter turn
WallImage image(const Structure& panel, const Hinge& hinge, PlaneMotion motion);

/// A symmetry of the rectangle of a sheet's cells: left-right, front-back, or both at once, as after half a turn.
class SheetSymmetry {
 public:
  SheetSymmetry() = default;  ///< none
  SheetSymmetry(const Structure& sheet, bool mirrors_x, bool mirrors_y);

  bool any() const { return mirrors_x_ || mirrors_y_; }
  Cell image(const Cell& cell) const;
  /// Returns the hinge on the image of a hinge's wall; empty if there is none.
  std::optional<int> image(const Structure& sheet, int hinge) const;
  /// Returns the parameters of `other`, the image of `hinge`, that make the pair symmetric: points and axes are each
  /// other's image.
  HingeParameters image(const Structure& sheet, int hinge, int other) const;

 private:
  bool mirrors_x_ = false, mirrors_y_ = false;
  std::array<int, 2> extent_ = {};  ///< cells
};

/// Returns true if the sheet has that cell.
bool has_cell(const Structure& sheet, const Cell& cell);

/// Returns true if a cell has no negative index.
bool is_countable(const Cell& cell);

}  // namespace kinetix::model
