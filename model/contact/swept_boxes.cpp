#include "model/contact/swept_boxes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

constexpr double no_direction = 1e-6;  // of a cross product of unit vectors: below, it is mostly rounding

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
  double lost_;  ///< mm: margin, and what the straight path leaves out
};

}  // namespace

bool stay_apart_by_faces(const SweptBoxes& boxes) {
  const SweptGap gap(boxes);
  for (const Vector3d& normal : face_normals(boxes.still))
    if (gap.along(normal)) return true;
  return false;
}

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

}  // namespace kinetix::model
