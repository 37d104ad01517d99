#pragma once

#include "model/base/oriented_box.hpp"
#include "model/contact/swept_motion.hpp"

namespace kinetix::model {

/// A box at rest, and one that moves against it: both where they are in the middle of an interval of theta, in the frame of
/// the first one's body, mm.
struct SweptBoxes {
  const OrientedBox& still;
  const OrientedBox& moving;
  const SweptMotion& motion;
  double half_width;  ///< of the interval, rad
  double margin;      ///< how far apart they have to stay, mm
};

/// Whether the two are proven to stay apart over the whole interval by one direction that separates them, of the faces of
/// the box at rest. Along a direction n the gap at theta = middle + tau is at least
///   n . (c + tau c') - s(-(n + tau n x w)) - (that of the box at rest along n) - change half_width^2 / 2
/// with s how far the moving box reaches from its center along a direction (convex),
/// where change bounds the second derivative of every corner; concave in tau, so least at an end.
bool stay_apart_by_faces(const SweptBoxes& boxes);
/// Likewise by the directions across an edge of each.
bool stay_apart_by_edges(const SweptBoxes& boxes);

}  // namespace kinetix::model
