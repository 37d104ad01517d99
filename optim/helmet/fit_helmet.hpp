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

/// The paper's way, on the same fishbone: one tilt for all creases, bent all to the inside.
struct UniformHelmet {
  double tilt = 0, theta = 0;  ///< rad
  RibsError before;  ///< with the mean of the fitted tilts at the layout's theta, placed on the crown
  RibsError after;   ///< with the best tilt, theta and place
};
UniformHelmet fit_uniform_helmet(const RibsDesign& design, const targets::MeshDistance& head,
                                 const Eigen::Vector3d& crown, const HelmetSpec& spec,
                                 const SolverOptions& options);

}  // namespace kinetix::optim
