#pragma once

#include "optim/ribs/ribs_layout.hpp"

namespace kinetix::optim {

/// What a helmet is to be.
using HelmetSpec = RibsSpec;

/// Spine along the plane x = crown.x, from rim to rim over the crown; ribs evenly along it, each in the plane
/// normal to the spine, down to the rim or to where it would meet its neighbours.
/// @throws InvalidInput where the ribs would overlap flat, the head has no surface along a ray from within,
/// or cells are larger than what they are to cover
RibsLayout plan_helmet(const targets::MeshDistance& head, const Eigen::Vector3d& crown,
                       const HelmetSpec& spec);

}  // namespace kinetix::optim
