#include "model/contact/swept_pair.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/base/oriented_box.hpp"
#include "model/contact/swept_motion.hpp"

namespace kinetix::model {
namespace {

/// A box at rest and a box that moves relative to it. Both are in the frame of the first one's body, in the middle of
/// an interval of theta, mm.
struct SweptBoxes {
  const OrientedBox& still;
  const OrientedBox& moving;
  const SweptMotion& motion;
  double half_width;  ///< of the interval, rad
  double margin;      ///< required distance, mm
};

using Eigen::Vector3d;

// Length of a cross product of unit vectors: below it, rounding dominates
constexpr double no_direction = 1e-6;

class SweptGap {
 public:
  explicit SweptGap(const SweptBoxes& boxes)
      : boxes_(boxes),
        apart_(boxes.moving.center - boxes.still.center),
        speed_(boxes.motion.speed(boxes.moving.center)),
        lost_(boxes.margin + boxes.motion.change(boxes.moving.center, radius(boxes.moving)) *
                                 boxes.half_width * boxes.half_width / 2) {}

  /// @param direction unit
  bool along(Vector3d direction) const {
    if (direction.dot(apart_) < 0) direction = -direction;
    const double free = direction.dot(apart_) - support(boxes_.still, direction) - lost_;
    const Vector3d turned = direction.cross(boxes_.motion.omega());
    const auto gap = [&](double tau) {
      return free + tau * direction.dot(speed_) - support(boxes_.moving, -direction - tau * turned);
    };
    return gap(boxes_.half_width) > 0 && gap(-boxes_.half_width) > 0;
  }

 private:
  const SweptBoxes& boxes_;
  Vector3d apart_, speed_;
  double lost_;  ///< mm: margin, and the deviation from the straight path
};

/// Returns true if one face normal of the box at rest proves that the two boxes stay apart over the whole interval.
/// Along a direction n the gap at theta = middle + tau is at least
///   n . (c + tau c') - s(-(n + tau n x w)) - (that of the box at rest along n) - change half_width^2 / 2.
/// The convex function s is the reach of the moving box from its center along a direction. The bound `change` is that
/// of the second derivative of every corner. The gap is concave in tau, so its minimum is at an end.
bool stay_apart_by_faces(const SweptBoxes& boxes) {
  const SweptGap gap(boxes);
  for (const Vector3d& normal : face_normals(boxes.still))
    if (gap.along(normal)) return true;
  return false;
}

/// Returns true if a direction normal to an edge of each box proves that they stay apart over the interval.
bool stay_apart_by_edges(const SweptBoxes& boxes) {
  const SweptGap gap(boxes);
  for (const Vector3d& still : edge_directions(boxes.still))
    for (const Vector3d& moving : edge_directions(boxes.moving)) {
      const Vector3d across = still.cross(moving);
      const double length = across.norm();
      if (length > no_direction && gap.along(across / length)) return true;
    }
  return false;
}

}  // namespace

SweptPair::SweptPair(const LinkagePlates& plates, const ThetaInterval& interval, const PlatesOfPair& pair,
                     double margin_mm)
    : plates_(plates),
      interval_(interval),
      pair_(pair),
      margin_mm_(margin_mm),
      second_(interval.relative(pair.first, pair.second)),
      there_(interval.motion(pair.first, pair.chain)) {}

bool SweptPair::is_apart() const {
  const double reach = plates_.reach[pair_.first] + plates_.reach[pair_.second];
  return second_.p.norm() - reach - there_.way(second_.p, plates_.reach[pair_.second]) > margin_mm_;
}

bool SweptPair::is_apart(const WallPair& walls) {
  const bool in_order = plates_.walls[walls.first].body == pair_.first;
  const OrientedBox& own = plates_.walls[in_order ? walls.first : walls.second].box;
  const HalfWall& other = plates_.walls[in_order ? walls.second : walls.first];
  const Eigen::Vector3d center = second_.p + second_.R * other.box.center;
  const double around = radius(other.box);
  if ((center - own.center).norm() - radius(own) - around - there_.way(center, around) > margin_mm_)
    return true;
  const OrientedBox moving = placed(other, second_);
  const SweptBoxes forth{own, moving, there_, interval_.half_width(), margin_mm_};
  return stay_apart_by_faces(forth) || is_apart_from_there(own, other.box) || stay_apart_by_edges(forth);
}

bool SweptPair::is_apart_from_there(const OrientedBox& own, const OrientedBox& other) {
  if (!back_) back_ = interval_.motion(pair_.second, reversed(pair_.chain));
  const Pose first = interval_.relative(pair_.second, pair_.first);
  const OrientedBox moving{first.p + first.R * own.center, first.R * own.axes, own.half, own.slant};
  return stay_apart_by_faces({other, moving, *back_, interval_.half_width(), margin_mm_});
}

}  // namespace kinetix::model
