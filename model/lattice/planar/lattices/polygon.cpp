#include "model/lattice/planar/lattices/polygon.hpp"

#include <cmath>

#include "model/base/angle.hpp"

namespace kinetix::model {

std::vector<Eigen::Vector2d> regular_polygon(int walls, double first, const Eigen::Vector2d& middle) {
  const double radius = 0.5 / std::sin(pi / walls);
  std::vector<Eigen::Vector2d> corners;
  for (int k = 0; k < walls; ++k) {
    const double angle = first + 2 * pi * k / walls;
    corners.push_back(middle + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

}  // namespace kinetix::model
