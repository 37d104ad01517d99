#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "model/base/invalid_input.hpp"

namespace kinetix::app {

/// A sheet cut into tiles that a printer's bed holds, in a grid whose columns and rows are about equally wide.
struct Tiles {
  int columns = 1, rows = 1;
  int with_bodies = 1;       ///< places of the grid that hold any: each is a tile, the others are none
  std::vector<int> of_body;  ///< the tile of each body, row by row from the lower left
  std::optional<Eigen::Vector2d> bed_mm = {};  ///< that was asked for, mm
  bool turned = false;                         ///< on that bed, by a quarter

  int count() const { return with_bodies; }
};

/// A bed that does not hold one body: larger cells make it worse.
class BedTooSmall : public InvalidInput {
 public:
  using InvalidInput::InvalidInput;
};

/// Whether a rectangle fits on a bed, as it lies or turned by a quarter, both mm.
bool fits_on_bed(const Eigen::Vector2d& size_mm, const Eigen::Vector2d& bed_mm);

/// As few columns and rows as hold all bodies, one of each where the bed holds the whole; turned on the bed by a quarter
/// where that takes fewer.
/// @param boxes of the bodies with what is printed with each, where they are in the flat sheet, mm; empty: nothing is
/// printed of it   @param bed_mm along x and y
/// @throws BedTooSmall
Tiles cut_into_tiles(const std::vector<Eigen::AlignedBox2d>& boxes, const Eigen::Vector2d& bed_mm);

}  // namespace kinetix::app
