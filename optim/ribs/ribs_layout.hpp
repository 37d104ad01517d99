#pragma once

#include <functional>
#include <optional>
#include <string>

#include "optim/ribs/ribs_problem.hpp"
#include "targets/curve/space_curve.hpp"

namespace kinetix::optim {

/// Specification of a fishbone, in a frame with z up, y along the spine.
struct RibsSpec {
  model::CellSize size = {};
  int ribs = 8;                           ///< >= 1
  std::optional<double> spacing_mm;       ///< between the middles of ribs along the spine, mm;
                                          ///< overrides `ribs`, rounded to even spaces
  double clearance_mm = 5;                ///< from the surface, mm, >= 0
  double coverage_mm = 90;                ///< height of the crown above the rim, mm, > 0
  double tilt = 60 * radians_per_degree;  ///< limit of all tilts, rad, (0, pi/2)
  AngleRange theta = {2 * radians_per_degree, 40 * radians_per_degree};
  double start_theta = 30 * radians_per_degree;  ///< theta at which cells are counted, rad
};

/// Fishbone that suits a surface, folded as its curves alone suggest.
struct RibsLayout {
  model::FishboneLayout spine_and_ribs;
  RibsShape start;
  targets::SpaceCurve spine;  ///< at the clearance, from its end of least y over the crown, mm
  std::vector<std::array<targets::SpaceCurve, 2>>
      sections;                    ///< curves of each rib, from the spine to -x and to +x
  double rim_z = 0;                ///< mm
  std::vector<std::string> notes;  ///< ribs that end above the rim, with the reason
};

/// Plane of a rib, normal to the spine.
struct RibPlane {
  Eigen::Vector3d p, along;  ///< a point of the spine, mm, and the spine's direction there
  double beyond(const Eigen::Vector3d& q) const { return (q - p).dot(along); }
  Eigen::Vector3d outward() const { return Eigen::Vector3d::UnitX().cross(along); }
};

/// Planes of all ribs, with the room that a rib needs.
struct RibPlanes {
  std::vector<RibPlane> planes;  ///< of all ribs
  double width = 0;              ///< least distance of a rib from the plane of its neighbour, mm
  double pitch = 0;              ///< pitch of folded cells, mm

  /// Returns whether the rib meets its neighbour at p. Every other rib ends next to its neighbours; those
  /// between continue until they meet each other.
  bool meets_neighbour(std::size_t rib, const Eigen::Vector3d& p) const;
};

/// Returns the line of a rib from the spine to its end, to -x (side -1) or +x (side 1).
using TraceRib = std::function<targets::SpaceCurve(const RibPlanes& planes, std::size_t rib, int side)>;

/// Lays out ribs evenly along a spine, with as many cells on each as its line is long. Tilts follow from the
/// slopes.
/// @param spine in a plane x = const, from its end of least y.
/// @param span_mm to either side, for directions of curves, mm, > 0.
/// @return rim_z and notes are left to the caller.
/// @throws InvalidInput for a spine shorter than two cells, and ribs that overlap flat
RibsLayout layout_along(const targets::SpaceCurve& spine, double span_mm, const RibsSpec& spec,
                        const TraceRib& trace);

}  // namespace kinetix::optim
