#include "model/lattice/planar/regular_lattices.hpp"

/// A lattice in one file: stacked rectangles of 2 x 1 with a vertex in the middle of their long sides.
namespace kinetix::model {
namespace {

std::vector<Eigen::Vector2d> corners(int i, int j, double) {
  const Eigen::Vector2d at(2 * i, j);
  std::vector<Eigen::Vector2d> out;
  for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}})
    out.push_back(at + Eigen::Vector2d(x, y));
  return out;
}

// Name, meaning, corners of a cell.
const PlanarLattice window_lattice = {"window", "rectangles of 2 x 1 with a vertex in their long sides",
                                      corners};

[[maybe_unused]] const bool lattice_registered = (add_planar_lattice(window_lattice), true);

}  // namespace
}  // namespace kinetix::model
