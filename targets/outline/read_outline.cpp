#include "targets/outline/read_outline.hpp"

#include <utility>

namespace kinetix::targets {
namespace {

const std::string second_axis = "y";

}  // namespace

const KeyTable& outline_target_keys() {
  static const KeyTable keys({
      goal_kind_key("outline"),
      {"points", points_type(second_axis), needed,
       "outline of the panel when it is pressed, in mm: closed, not crossing itself. The CSV file has the "
       "header "
       "`x,y`, then one point a row; the first point need not come again"},
      {"flat", points_type(second_axis), otherwise("the panel's own"),
       "outline of the panel as it is printed, in mm, likewise: its walls then have the lengths that it "
       "takes"},
  });
  return keys;
}

Outline read_outline(const Node& points) {
  return made_of(read_points(points, second_axis),
                 [](std::vector<Eigen::Vector2d> read) { return Outline(std::move(read)); });
}

}  // namespace kinetix::targets
