#pragma once

#include "model/assembly/assembly.hpp"
#include "model/assembly/deployment.hpp"

namespace kinetix::model {

/// Two tiles that share a corner.
struct TileJoint {
  int first = 0, first_corner = 0;    ///< tile, and its corner
  int second = 0, second_corner = 0;  ///< tile, and its corner
  bool both_faces = false;            ///< held at both faces of the sheet: turns only about the tiles' normal
};

/// Flat polygons joined at corners, as in the literature on kirigami.
struct TileSheet {
  std::vector<std::vector<Eigen::Vector3d>> tiles;  ///< corners of each in order, in the unit of its file
  std::vector<TileJoint> joints;
  /// Target position of each corner, in that unit; empty: none
  std::vector<std::vector<Eigen::Vector3d>> target;
};

/// Parameters that convert tiles to bodies.
struct TileMake {
  double scale_mm = 1;      ///< mm per unit of the sheet, > 0
  double thickness_mm = 1;  ///< thickness of the sheet, half of it to each side of the corners, > 0
  double kerf_mm = 0.6;     ///< width of the cuts: half of it is taken off each edge, >= 0
};

/// Returns the median edge of the tiles, in the unit of the sheet.
double median_edge(const TileSheet& sheet);

/// Creates prisms joined at corners by ball joints. Joints at both faces of tiles in one plane, within a degree, are
/// hinges about the normal. Corners that are slightly apart in a file are joined half way. Names are tile_1, joint_1
/// and so on.
/// @throws InvalidInput, naming the tile or joint, counted from 1. Tiles need three corners, must be flat to a
/// hundredth of their size, convex, and wider than the kerf. Joints need existing corners and tiles, with corners at
/// most a twentieth of an edge apart. Each tile needs a chain of joints to the others.
Assembly assembly_of_tiles(const TileSheet& sheet, const TileMake& make);

/// Rigid poses of the tiles nearest to their targets, with the remaining error of their corners.
struct TileTarget {
  State poses;         ///< mm
  double off_max = 0;  ///< largest corner error over the median edge: the stretch that the target would need
};
/// Fits each tile to its target. @pre the sheet has a target with the same corners
TileTarget target_of_tiles(const TileSheet& sheet, const Assembly& assembly, double scale_mm);

}  // namespace kinetix::model
