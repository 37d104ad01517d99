#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/assembly/assembly.hpp"
#include "model/assembly/deployment.hpp"

namespace kinetix::model {

/// Two tiles that share a corner.
struct TileJoint {
  int first = 0, first_corner = 0;    ///< tile, and its corner
  int second = 0, second_corner = 0;  ///< likewise
  bool both_faces =
      false;  ///< held at both faces of the sheet, so that it turns about the tiles' normal alone
};

/// Flat polygons joined at corners: how the literature on kirigami writes its sheets.
struct TileSheet {
  std::vector<std::vector<Eigen::Vector3d>>
      tiles;  ///< corners of each in their order, in the unit of its file
  std::vector<TileJoint> joints;
  std::vector<std::vector<Eigen::Vector3d>>
      target;  ///< where the same corners are to go, in that unit; empty: nowhere
};

/// How tiles become bodies.
struct TileMake {
  double scale_mm = 1;      ///< mm of the sheet's unit, > 0
  double thickness_mm = 1;  ///< of the sheet, half of it to each side of the corners, > 0
  double kerf_mm = 0.6;     ///< width of the cuts: half of it is taken off each edge, >= 0
};

/// The median edge of its tiles, in its own unit.
double median_edge(const TileSheet& sheet);

/// Prisms joined where corners are: by balls, or, at both faces of tiles that lie in one plane to a degree, by hinges about
/// their normal. Corners that a file has a little apart are joined half way. Named tile_1, joint_1 and on.
/// @throws InvalidInput, naming the tile or joint, from 1: fewer than three corners, tiles that are not flat to a hundredth of
/// their size, not convex or narrower than the kerf, corners or tiles that are not there, corners that are further apart than a
/// twentieth of an edge, a tile that hangs on no chain of joints
Assembly assembly_of_tiles(const TileSheet& sheet, const TileMake& make);

/// The poses that carry each tile as near to its target as a rigid body goes, and by how much corners then miss it.
struct TileTarget {
  State poses;         ///< mm
  double off_max = 0;  ///< of a corner, over the median edge: what a target asks tiles to stretch
};
/// @pre the sheet has a target with the same corners
TileTarget target_of_tiles(const TileSheet& sheet, const Assembly& assembly, double scale_mm);

}  // namespace kinetix::model
