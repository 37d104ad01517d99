#pragma once

#include <optional>
#include <string>

#include "optim/helmet/helmet_problem.hpp"
#include "targets/curve/space_curve.hpp"

namespace kinetix::optim {

/// What a helmet is to be, in a frame with z up, y along the spine.
struct HelmetSpec {
  model::CellSize size = {};
  int ribs = 8;                           ///< >= 1
  std::optional<double> spacing_mm;       ///< along the spine between the middles of ribs, mm; goes before
                                          ///< `ribs`
  double clearance_mm = 5;                ///< from the head, mm, >= 0
  double coverage_mm = 90;                ///< how far below the crown the rim is, mm, > 0
  double tilt = 60 * radians_per_degree;  ///< limit of all tilts, rad, (0, pi/2)
  AngleRange theta = {2 * radians_per_degree, 40 * radians_per_degree};
  double start_theta = 30 * radians_per_degree;  ///< that cells are counted at, rad
};

/// A fishbone that suits a head, folded as well as its curves alone tell.
struct HelmetLayout {
  model::FishboneLayout spine_and_ribs;
  HelmetShape start;
  targets::SpaceCurve spine;  ///< at the clearance, from its end of least y over the crown, mm
  std::vector<std::array<targets::SpaceCurve, 2>>
      sections;                    ///< likewise of each rib, from the spine to -x and to +x
  double rim_z = 0;                ///< mm
  std::vector<std::string> notes;  ///< which ribs end above the rim, and why
};

/// Spine along the plane x = crown.x, from rim to rim over the crown; ribs evenly along it, each in the plane
/// normal to the spine, down to the rim or to where it would meet its neighbours.
/// @throws InvalidInput where the ribs would overlap flat, the head has no surface along a ray from within,
/// or cells are larger than what they are to cover
HelmetLayout plan_helmet(const targets::MeshDistance& head, const Eigen::Vector3d& crown,
                         const HelmetSpec& spec);

}  // namespace kinetix::optim
