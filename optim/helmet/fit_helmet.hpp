#pragma once

#include "optim/ribs/fit_layout.hpp"

namespace kinetix::optim {

/// Plans the spine along the plane x = crown.x, from rim to rim over the crown. Ribs are evenly spaced along
/// it, each in the plane normal to the spine. They end at the rim or where they would meet their neighbours.
/// @throws InvalidInput if the ribs would overlap flat, if a ray from within does not hit the head, or if
/// cells are larger than the area to cover
RibsLayout plan_helmet(const targets::MeshDistance& head, const Eigen::Vector3d& crown, const RibsSpec& spec);

/// Plans a fishbone, fits tilts, theta and place, and shortens ribs whose walls meet those of other ribs
/// while it folds. If walls of one rib meet (over bumps and hollows), it fits again with gentler tilts.
/// @param crown of the head, in its frame, mm
/// @throws InvalidInput as plan_helmet
RibsDesign fit_helmet(const targets::MeshDistance& head, const Eigen::Vector3d& crown, const RibsSpec& spec,
                      const SolverOptions& options);

}  // namespace kinetix::optim
