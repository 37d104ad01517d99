#include "model/elastic/rest_hinge.hpp"

#include <cmath>

namespace kinetix {

RestHinge rest_hinge(const Hinge& hinge) {
  const auto& [t, alpha, beta] = hinge.parameters;
  const Axis axis = hinge.wall.axis;
  RestHinge out;
  out.lower = hinge.lower;
  out.upper = hinge.upper;
  out.edge = edge_direction(axis);
  out.lower_arm = t * out.edge;
  out.upper_arm = (t - 1) * out.edge;
  out.axis = hinge_axis(axis, hinge.parameters);
  out.axis_alpha = -std::sin(alpha) * out.edge + std::cos(alpha) * wall_up(axis, beta);
  out.axis_beta = std::sin(alpha) * wall_up(axis, beta + pi / 2);
  return out;
}

}  // namespace kinetix
