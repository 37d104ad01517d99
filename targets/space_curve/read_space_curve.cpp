#include "targets/space_curve/read_space_curve.hpp"

namespace kinetix::targets {

const KeyTable& space_curve_target_keys() {
  static const KeyTable keys({
      goal_kind_key("space_curve"),
      {"points", space_points_type(max_space_points), needed,
       "the goal, in mm: open, not meeting itself. The CSV file has the header `x,y,z`, then one point a "
       "row"},
  });
  return keys;
}

ReadSpaceGoal read_space_goal(const Node& points) {
  SpacePoints read = read_space_points(points, max_space_points);
  std::vector<Place> places = read.places;
  return {made_of(std::move(read), [](std::vector<Eigen::Vector3d> p) { return SpaceGoal(std::move(p)); }),
          std::move(places)};
}

}  // namespace kinetix::targets
