#include "model/lattice/planar/lattices/brick.hpp"

#include <cmath>

namespace kinetix::model {
namespace {

using Eigen::Vector2d;

std::vector<Vector2d> brick_corners(int i, int j, double) {
  const Vector2d at(2 * i + odd_row(j), j);
  std::vector<Vector2d> out;
  for (const Vector2d& corner :
       {Vector2d(0, 0), Vector2d(1, 0), Vector2d(2, 0), Vector2d(2, 1), Vector2d(1, 1), Vector2d(0, 1)})
    out.push_back(at + corner);
  return out;
}

}  // namespace

// Name, meaning, brick_corners of a cell.
const PlanarLattice brick_lattice = {
    "brick",
    "rectangles of 2 x 1 with a vertex in the middle of their long sides, odd rows shifted by half a brick",
    brick_corners};

}  // namespace kinetix::model
