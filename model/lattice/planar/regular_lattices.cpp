#include "model/lattice/planar/regular_lattices.hpp"

#include <cmath>

#include "model/base/geometry.hpp"

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

namespace {

using Eigen::Vector2d;

std::vector<Vector2d> honeycomb_corners(int i, int j, double) {
  return regular_polygon(6, pi / 2, {std::sqrt(3.0) * (i + 0.5 * odd_row(j)), 1.5 * j});
}

}  // namespace

// Name, meaning, honeycomb_corners of a cell.
const PlanarLattice honeycomb_lattice = {
    "honeycomb", "regular hexagons, two walls of each upright, odd rows shifted by half a hexagon",
    honeycomb_corners};

namespace {

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

namespace {

std::vector<Vector2d> octagon_corners(int i, int j, double) {
  const double pitch = 1 + std::sqrt(2.0);
  return regular_polygon(8, pi / 8, {pitch * i, pitch * j});
}

}  // namespace

// Name, meaning, octagon_corners of a cell.
const PlanarLattice octagon_lattice = {"octagon", "regular octagons with the squares between them",
                                       octagon_corners};

namespace {

std::vector<Vector2d> rhombus_corners(int i, int j, double angle) {
  const Vector2d along(1, 0), across(std::cos(angle), std::sin(angle)), at = i * along + j * across;
  return {at, at + along, at + along + across, at + across};
}

}  // namespace

// Name, meaning, corners of a cell, whether the angle shapes it.
const PlanarLattice rhombus_lattice = {
    "rhombus", "rhombi whose walls along the rows and across them enclose `angle_deg`", rhombus_corners,
    true};

PlanarGraph square_graph(int columns, int rows) {
  return lattice_graph(rhombus_lattice, columns, rows, pi / 2);
}

namespace {

std::vector<const PlanarLattice*>& lattices() {
  static std::vector<const PlanarLattice*> all = {
      &honeycomb_lattice,
      &brick_lattice,
      &rhombus_lattice,
      &octagon_lattice,
  };
  return all;
}

}  // namespace

const std::vector<const PlanarLattice*>& planar_lattices() { return lattices(); }

void add_planar_lattice(const PlanarLattice& lattice) { lattices().push_back(&lattice); }

}  // namespace kinetix::model
