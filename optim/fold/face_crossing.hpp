#pragma once

#include <optional>

#include "optim/fold/folded_net.hpp"

namespace kinetix::optim {

/// Two faces that are too close.
struct FaceCrossing {
  int first = 0, second = 0;  ///< indices of the faces
  double theta = 0;           ///< rad; the faces are apart up to here
};

/// Checks whether faces without a common crease stay apart from flat to theta, with the thickness and height
/// of their walls. Steps of theta are short enough to miss no motion between them: the gap of two faces over
/// a bound of their closing speed. The bound contains the derivatives of the creases between them times the
/// length of net that these carry, the shortening of the lattice and the turn of the bodies.
/// @return the first two faces whose walls come within a fiftieth of the cell edge
std::optional<FaceCrossing> first_face_crossing(const FoldedNet& folded);

}  // namespace kinetix::optim
