#pragma once

#include "optim/ribs/fit_layout.hpp"

namespace kinetix::optim {

/// Spine along the plane x = crown.x, from rim to rim over the crown; ribs evenly along it, each in the plane
/// normal to the spine, down to the rim or to where it would meet its neighbours.
/// @throws InvalidInput where the ribs would overlap flat, the head has no surface along a ray from within,
/// or cells are larger than what they are to cover
RibsLayout plan_helmet(const targets::MeshDistance& head, const Eigen::Vector3d& crown, const RibsSpec& spec);

/// Plans a fishbone, fits tilts, theta and place, and shortens ribs whose walls meet those of others while it
/// folds; where walls of one rib meet (over bumps and hollows), fits anew with gentler tilts.
/// @param crown of the head, in its frame, mm
/// @throws InvalidInput as plan_helmet
RibsDesign fit_helmet(const targets::MeshDistance& head, const Eigen::Vector3d& crown, const RibsSpec& spec,
                      const SolverOptions& options);

}  // namespace kinetix::optim
