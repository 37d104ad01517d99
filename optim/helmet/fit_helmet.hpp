#pragma once

#include "optim/helmet/helmet_layout.hpp"
#include "optim/ribs/fit_layout.hpp"

namespace kinetix::optim {

/// Plans a fishbone, fits tilts, theta and place, and shortens ribs whose walls meet those of others while it
/// folds; where walls of one rib meet (over bumps and hollows), fits anew with gentler tilts.
/// @param crown of the head, in its frame, mm
/// @throws InvalidInput as plan_helmet
RibsDesign fit_helmet(const targets::MeshDistance& head, const Eigen::Vector3d& crown, const HelmetSpec& spec,
                      const SolverOptions& options);

}  // namespace kinetix::optim
