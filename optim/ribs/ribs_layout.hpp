#pragma once

#include <functional>
#include <optional>
#include <string>

#include "optim/ribs/ribs_problem.hpp"
#include "targets/curve/space_curve.hpp"

namespace kinetix::optim {

/// What a fishbone is to be, in a frame with z up, y along the spine.
struct RibsSpec {
  model::CellSize size = {};
  int ribs = 8;                           ///< >= 1
  std::optional<double> spacing_mm;       ///< along the spine between the middles of ribs, mm; goes before
                                          ///< `ribs`, and is as near as even spaces come
  double clearance_mm = 5;                ///< from the surface, mm, >= 0
  double coverage_mm = 90;                ///< how far below the crown the rim is, mm, > 0
  double tilt = 60 * radians_per_degree;  ///< limit of all tilts, rad, (0, pi/2)
  AngleRange theta = {2 * radians_per_degree, 40 * radians_per_degree};
  double start_theta = 30 * radians_per_degree;  ///< that cells are counted at, rad
};

/// A fishbone that suits a surface, folded as well as its curves alone tell.
struct RibsLayout {
  model::FishboneLayout spine_and_ribs;
  RibsShape start;
  targets::SpaceCurve spine;  ///< at the clearance, from its end of least y over the crown, mm
  std::vector<std::array<targets::SpaceCurve, 2>>
      sections;                    ///< likewise of each rib, from the spine to -x and to +x
  double rim_z = 0;                ///< mm
  std::vector<std::string> notes;  ///< which ribs end above the rim, and why
};

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
RibsLayout layout_along(const targets::SpaceCurve& spine, double span_mm, const RibsSpec& spec,
                        const TraceRib& trace);

}  // namespace kinetix::optim
