#pragma once

#include "model/lattice/planar/planar_motion.hpp"

namespace kinetix::model {

/// Returns the lean of a hinge axis: the axis divided by its component along z is z + lean. The axis is that of the
/// wall from sublattice A to B, or equally from B to A. The length of the lean is the tangent of the tilt. @pre alpha
/// and beta are in their ranges
Eigen::Vector2d lean(const PlanarStructure& structure, int hinge);

/// Leans the axis of a hinge along a line of any length but 0, with the sign of each body's sublattice. At theta > 0
/// both sides of the line then rise by 2 atan(multiplier sin(theta)); for a negative value they sink.
/// @pre the wall crosses the line
void set_fold(PlanarStructure& structure, int hinge, const Eigen::Vector2d& line, double multiplier);

/// A crease between two facets: the hinges that join them, whose axes lean along one line.
struct PlanarCrease {
  int from = 0, to = 0;     ///< facets
  std::vector<int> hinges;  ///< at least one, in order along the line.
  /// Unit direction of the line times the fold multiplier c, at the first hinge. `to` turns relative to `from` about
  /// it by -2 atan(c sin(theta)). A mountain and a valley have opposite directions.
  Eigen::Vector2d line = Eigen::Vector2d::Zero();
};

/// Division of a structure by its leaning hinges: facets, whose bodies are connected by upright hinges, and creases
/// between them.
struct PlanarCreases {
  std::vector<int> facet_of;       ///< facet of each body
  int facets = 0;                  ///< number of facets
  std::vector<PlanarCrease> list;  ///< in the order of their first hinges
  std::vector<int> of_hinge;  ///< index in `list`; -1 for upright hinges and those that lean inside one facet
  std::vector<int> loose;     ///< hinges that lean inside one facet: their crease ends in it
};
PlanarCreases find_creases(const PlanarStructure& structure);

/// Returns `line` at a hinge, from facet `from` to facet `to` of its crease.
Eigen::Vector2d line_of(const PlanarStructure& structure, const PlanarCreases& creases, int hinge);

/// Path of a hinge point: cos(theta) p + i sin(theta) q, cell edges.
struct HingePath {
  Eigen::Vector2d p, q;
  Eigen::Vector3d at(double theta) const;
};
HingePath hinge_path(const PlanarStructure& structure, const ParallelDrawing& y, int hinge);

/// Distance of a hinge from the line of its crease, cell edges: at rest, and as the factor of sin(theta) in motion.
struct CreaseOffset {
  int hinge = -1;  ///< hinge with the largest distance; -1 if all stay on the line
  double at_rest = 0, moving = 0;
  double worst() const;
};
/// Returns the largest distance of a crease's hinges from the line through the first one.
CreaseOffset left_line(const PlanarStructure& structure, const ParallelDrawing& y,
                       const PlanarCrease& crease);

/// A linear condition on s = 2 t_A - 1 of some walls: the sum of rate times change of s is `missing`.
struct WallCondition {
  struct Part {
    int wall = 0;
    double rate = 0;  ///< cell edges
  };
  std::vector<Part> parts;
  double missing = 0;  ///< cell edges
};
/// Returns two conditions for each hinge of a crease except its first: its point is on the line, and stays on it
/// (kinematics.md section 6).
std::vector<WallCondition> straight_lines(const PlanarStructure& structure, const PlanarCreases& creases);

}  // namespace kinetix::model
