#include "app/goals/curve/curve_points.hpp"

#include "app/run/midline.hpp"
#include "targets/curve/curve_error.hpp"
#include "targets/curve/polyline_tree.hpp"

namespace kinetix::app {

std::vector<model::ObservedPoint> curve_points(const targets::Curve& curve, const model::Sheet& sheet,
                                               const model::State& state, const model::State& upright) {
  const model::Pose motion = motion_onto(state, upright);
  const Eigen::Matrix3d back = motion.R.transpose();
  const model::State placed = moved(state, motion);
  const std::vector<Eigen::Vector2d> midline = column_midline(sheet, placed);
  const targets::PolylineTree goal(curve_error(midline, curve).goal_mm);
  const std::vector<std::vector<int>> columns = body_columns(sheet);
  std::vector<model::ObservedPoint> points;
  for (std::size_t k = 0; k < midline.size(); ++k) {
    const targets::ClosestPoint at = goal.nearest(midline[k]);
    const Eigen::Vector3d place(midline[k].x(), placed[columns[k][0]].p.y(), midline[k].y()),
        normal(at.normal.x(), 0, at.normal.y());
    points.push_back({columns[k], back * (place - motion.p), back * normal, at.distance});
  }
  return points;
}

}  // namespace kinetix::app
