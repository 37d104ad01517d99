#pragma once

#include <optional>

#include "optim/fold/folded_net.hpp"

namespace kinetix::optim {

/// Two faces that come too close.
struct FaceCrossing {
  int first = 0, second = 0;  ///< indices of the faces
  double theta = 0;           ///< rad; apart up to here
};

/// Whether faces that no crease joins stay apart on the way from flat to theta, with the thickness and height
/// of their walls. No motion between the looks is missed: a step of theta is no longer than the gap of two
/// faces over the largest speed at which they can come closer, which is bounded by the derivatives of the creases
/// between them times the length of net that these carry, the shortening of the lattice and the turn of the
/// bodies.
/// @return the first two faces whose walls come within a fiftieth of the cell edge
std::optional<FaceCrossing> first_face_crossing(const FoldedNet& folded);

}  // namespace kinetix::optim
