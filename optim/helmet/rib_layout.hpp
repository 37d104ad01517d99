#pragma once

#include <functional>

#include "optim/helmet/helmet_layout.hpp"

namespace kinetix::optim {

/// Plane of a rib, normal to the spine.
struct RibPlane {
  Eigen::Vector3d p, along;  ///< a point of the spine, mm, and the spine's direction there
  double beyond(const Eigen::Vector3d& q) const { return (q - p).dot(along); }
  Eigen::Vector3d outward() const { return Eigen::Vector3d::UnitX().cross(along); }
};

/// What a rib that runs in one of the planes needs to know.
struct RibPlanes {
  std::vector<RibPlane> planes;  ///< of all ribs
  double width = 0;              ///< that a rib takes up to each side, mm
  double pitch = 0;              ///< of folded cells, mm

  /// Every other rib ends beside its neighbours, so that those between run on to where they meet each other.
  bool meets_neighbour(std::size_t rib, const Eigen::Vector3d& p) const;
};

/// The line of a rib from the spine to where it ends, to -x (side -1) or +x (side 1).
using TraceRib = std::function<targets::SpaceCurve(const RibPlanes& planes, std::size_t rib, int side)>;

/// Ribs evenly along a spine, as many cells on each as its line is long, and the tilts that follow from
/// slopes.
/// @param spine in a plane x = const, from its end of least y   @param span_mm to either side, for directions
/// of curves, mm, > 0
/// @return rim_z and notes are the caller's to fill in
/// @throws InvalidInput for a spine shorter than two cells, and ribs that overlap flat
HelmetLayout layout_along(const targets::SpaceCurve& spine, double span_mm, const HelmetSpec& spec,
                          const TraceRib& trace);

}  // namespace kinetix::optim
