#include "model/contact/swept_boxes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

constexpr double no_direction = 1e-6;  // of a cross product of unit vectors: below, it is mostly rounding

/// How far a box reaches along a direction from its centre.
double extent(const OrientedBox& box, const Vector3d& direction) {
  return (box.axes.transpose() * direction).cwiseAbs().dot(box.half);
}

class SweptGap {
 public:
  explicit SweptGap(const SweptBoxes& boxes)
      : boxes_(boxes),
        apart_(boxes.moving.center - boxes.still.center),
        speed_(boxes.motion.speed(boxes.moving.center)),
        lost_(boxes.margin + boxes.motion.change(boxes.moving.center, boxes.moving.half.norm()) *
                                 boxes.half_width * boxes.half_width / 2) {}

  /// @param direction unit
  bool along(Vector3d direction) const {
    if (direction.dot(apart_) < 0) direction = -direction;
    const double free = direction.dot(apart_) - extent(boxes_.still, direction) - lost_;
    const Vector3d turned = direction.cross(boxes_.motion.omega());
    const auto gap = [&](double tau) {
      return free + tau * direction.dot(speed_) - extent(boxes_.moving, direction + tau * turned);
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
  for (int k = 0; k < 3; ++k)
    if (gap.along(boxes.still.axes.col(k))) return true;
  return false;
}

bool stay_apart_by_edges(const SweptBoxes& boxes) {
  const SweptGap gap(boxes);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Vector3d across = boxes.still.axes.col(i).cross(boxes.moving.axes.col(j));
      const double length = across.norm();
      if (length > no_direction && gap.along(across / length)) return true;
    }
  return false;
}

}  // namespace kinetix::model
