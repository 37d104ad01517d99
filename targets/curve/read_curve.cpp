#include "targets/curve/read_curve.hpp"

#include <utility>

namespace kinetix::targets {
namespace {

const std::string second_axis = "z";

Curve make_curve(std::vector<Eigen::Vector2d> points) { return Curve(std::move(points)); }

}  // namespace

const KeyTable& curve_target_keys() {
  static const KeyTable keys({
      goal_kind_key("curve"),
      {"points", points_type(second_axis), needed,
       "the goal, in mm: open, not crossing itself. The CSV file has the header `x,z`, then one point a row"},
  });
  return keys;
}

Curve read_curve_csv(const std::string& file) {
  return made_of(read_points_csv(file, second_axis), make_curve);
}

Curve read_curve(const Node& points) { return made_of(read_points(points, second_axis), make_curve); }

}  // namespace kinetix::targets
