#include "model/lattice/planar/lattices/octagon.hpp"

#include <cmath>

#include "model/base/angle.hpp"
#include "model/lattice/planar/lattices/polygon.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;

std::vector<Vector2d> octagon_corners(int i, int j, double) {
  const double pitch = 1 + std::sqrt(2.0);
  return regular_polygon(8, pi / 8, {pitch * i, pitch * j});
}

}  // namespace

// Name, meaning, octagon_corners of a cell.
const PlanarLattice octagon_lattice = {"octagon", "regular octagons with the squares between them",
                                       octagon_corners};

}  // namespace kinetix::model
