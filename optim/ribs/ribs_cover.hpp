#pragma once

#include <limits>

#include "model/lattice/square/structure.hpp"
#include "model/linkage/state.hpp"
#include "targets/mesh/triangle_tree.hpp"

namespace kinetix::optim {

/// Folded cells of a fishbone, spine and ribs, moved towards the surface by the clearance. They give the
/// distance of any place of the surface from the nearest cell.
class RibsReach {
 public:
  /// @param state of the structure, in the frame of the surface, mm   @pre at least one cell
  RibsReach(const model::Structure& structure, const model::State& state,
            const targets::MeshDistance& surface, double clearance_mm);

  /// Returns the distance from p to the nearest cell, mm.
  double distance(const Eigen::Vector3d& p) const;
  /// Returns the distance within which a place counts as covered: one cell edge.
  double edge_mm() const { return edge_mm_; }

 private:
  double edge_mm_;
  targets::TriangleTree cells_;
};

/// Returns the parts of a line that are further than one cell edge from every rib, of at least two points,
/// for pictures.
std::vector<std::vector<Eigen::Vector3d>> uncovered_parts(const RibsReach& ribs,
                                                          const std::vector<Eigen::Vector3d>& line);

/// Coverage of a surface by the ribs over it, weighted by area.
struct RibsCover {
  double share = 0;  ///< of the area within one cell edge of a rib, [0, 1]
  double rms = 0;    ///< distance of the surface from the nearest rib, mm
  double max = 0;    ///< largest distance of the surface from the nearest rib, mm
};

/// Measures the coverage at points spread evenly over the triangles of a surface.
/// @param lowest_z points below are ignored, mm
RibsCover cover_by(const RibsReach& ribs, const targets::TriangleMesh& surface,
                   double lowest_z = -std::numeric_limits<double>::infinity());

}  // namespace kinetix::optim
