#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/lattice/planar/planar_motion.hpp"

namespace kinetix::model {

/// Where the axis of a hinge leans to, of its wall from class A to class B or back alike: the axis over its part
/// along z is z + lean. Its length is the tangent of the tilt. @pre alpha and beta lie in their ranges
Eigen::Vector2d lean(const PlanarStructure& structure, int hinge);

/// Leans the axis of a hinge along a line of any length but 0, to the side of the class of each of its bodies, so that at
/// theta > 0 what lies on both sides of the line rises by 2 atan(multiplier sin(theta)); it sinks where that is negative.
/// @pre the wall crosses the line
void set_fold(PlanarStructure& structure, int hinge, const Eigen::Vector2d& line, double multiplier);

/// A crease between two facets: the hinges that join them, whose axes lean along one line.
struct PlanarCrease {
  int from = 0, to = 0;     ///< facets
  std::vector<int> hinges;  ///< at least one, in their order along the line
  /// Unit direction of the line times the fold multiplier c, of the first hinge: `to` is turned against `from` about it
  /// by -2 atan(c sin(theta)). A mountain and a valley have opposite directions.
  Eigen::Vector2d line = Eigen::Vector2d::Zero();
};

/// What hinges that lean make of a structure: facets, whose bodies hang together by upright hinges, and creases
/// between them.
struct PlanarCreases {
  std::vector<int> facet_of;       ///< of each body
  int facets = 0;                  ///< their number
  std::vector<PlanarCrease> list;  ///< in the order of their first hinges
  std::vector<int>
      of_hinge;            ///< index in `list`, -1 of upright hinges and of those that lean inside one facet
  std::vector<int> loose;  ///< hinges that lean inside one facet: their crease ends in it
};
PlanarCreases find_creases(const PlanarStructure& structure);

/// `line` as the hinge itself has it, from facet `from` to facet `to` of its crease.
Eigen::Vector2d line_of(const PlanarStructure& structure, const PlanarCreases& creases, int hinge);

/// The hinge point moves as cos(theta) p + i sin(theta) q. Cell edges.
struct HingePath {
  Eigen::Vector2d p, q;
  Eigen::Vector3d at(double theta) const;
};
HingePath hinge_path(const PlanarStructure& structure, const Redrawing& y, int hinge);

/// How far a hinge leaves the line of its crease, cell edges: at rest, and times sin(theta) as it moves.
struct LeftLine {
  int hinge = -1;  ///< that leaves it farthest, -1 where all stay on it
  double at_rest = 0, moving = 0;
  double worst() const;
};
/// Of all hinges of a crease from the line through the first one.
LeftLine left_line(const PlanarStructure& structure, const Redrawing& y, const PlanarCrease& crease);

/// A linear condition on s = 2 t_A - 1 of some walls: the sum of rate times change of s is `missing`.
struct WallCondition {
  struct Part {
    int wall = 0;
    double rate = 0;  ///< cell edges
  };
  std::vector<Part> parts;
  double missing = 0;  ///< cell edges
};
/// Two for each hinge of a crease but its first: its point is on the line, and stays so (kinematics.md section 6).
std::vector<WallCondition> straight_lines(const PlanarStructure& structure, const PlanarCreases& creases);

}  // namespace kinetix::model
