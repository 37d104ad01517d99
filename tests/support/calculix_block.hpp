#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/material/manufactured_hinge.hpp"
#include "tests/support/temporary_folder.hpp"

/// Stiffness of soft hinges from CalculiX, a finite-element program that shares none of their formulas.
namespace kinetix::testing {

/// Eighth of a block, of bricks with 20 nodes. It reaches from the block's middle to its end along the wall (x), to its
/// face across the wall (y) and to its end along the hinge's axis (z). Each motion of the ends is symmetric or
/// antisymmetric about the three middle planes, so the eighth gives the stiffness of the whole with the same bricks.
/// With reduced integration they do not lock where nu is near 0.5.
class Bricks {
 public:
  /// @param count of bricks in the whole block, even in each direction
  Bricks(const model::ManufacturedHinge& block, const std::array<int, 3>& count)
      : block_(block), count_{count[0] / 2, count[1] / 2, count[2] / 2} {
    for (int a = 0; a < count_[0]; ++a)
      for (int b = 0; b < count_[1]; ++b)
        for (int c = 0; c < count_[2]; ++c) add_brick(2 * a, 2 * b, 2 * c);
  }

  void write(std::ostream& out) const {
    out << "*NODE,NSET=ALL\n";
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      out << k + 1 << "," << nodes_[k].x() << "," << nodes_[k].y() << "," << nodes_[k].z() << "\n";
    out << "*ELEMENT,TYPE=C3D20R,ELSET=BLOCK\n";
    for (std::size_t k = 0; k < bricks_.size(); ++k) {
      out << k + 1;
      for (int n = 0; n < 20; ++n) out << (n == 10 ? ",\n" : ",") << bricks_[k][n];
      out << "\n";
    }
    out << "*MATERIAL,NAME=SOFT\n*ELASTIC\n"
        << block_.material.E_mpa << "," << block_.material.nu
        << "\n*SOLID SECTION,ELSET=BLOCK,MATERIAL=SOFT\n";
  }

  /// Writes a step that moves the end of the block as a rigid body by half of `amount`. The motion is a shift along an
  /// axis, or a turn about an axis through the middle. The other end moves by the same in the opposite direction.
  void write_step(std::ostream& out, bool turns, int axis, double amount) const {
    out << "*STEP\n*STATIC\n*BOUNDARY,OP=NEW\n";
    const Eigen::Vector3d motion = amount / 2 * Eigen::Vector3d::Unit(axis);
    for (const auto& [place, node] : numbers_) {
      const bool is_end = place[0] == 2 * count_[0];
      const Eigen::Vector3d moved = turns ? motion.cross(nodes_[node - 1]) : motion;
      for (int c = 0; c < 3; ++c)
        if (is_end || is_held(place, c, turns, axis))
          out << node << "," << c + 1 << "," << c + 1 << "," << (is_end ? moved[c] : 0) << "\n";
    }
    out << "*EL PRINT,ELSET=BLOCK,TOTALS=ONLY\nELSE\n*END STEP\n";
  }

 private:
  /// Returns whether a middle plane holds a component of a node. A symmetric motion has no component across the plane,
  /// an antisymmetric one has none in it.
  static bool is_held(const std::array<int, 3>& place, int component, bool turns, int axis) {
    for (int plane = 0; plane < 3; ++plane) {
      const bool keeps_end =
          turns == (axis == plane);  // a mirror in this plane leaves the end's motion as it is
      const bool is_symmetric = keeps_end != (plane == 0);  // a mirror in plane 0 exchanges the ends
      if (place[plane] == 0 && (component == plane) == is_symmetric) return true;
    }
    return false;
  }

  int number(int i, int j, int k) {
    const auto [at, is_new] = numbers_.try_emplace({i, j, k}, static_cast<int>(nodes_.size()) + 1);
    if (is_new)
      nodes_.emplace_back(block_.gap_mm * i / (4.0 * count_[0]), block_.thickness_mm * j / (4.0 * count_[1]),
                          block_.height_mm * k / (4.0 * count_[2]));
    return at->second;
  }

  void add_brick(int i, int j, int k) {
    // Corners, then middles of the edges below, above and between, as the program's manual orders them.
    constexpr int at[20][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2},
                               {0, 2, 2}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2},
                               {1, 2, 2}, {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}};
    std::array<int, 20> brick;
    for (int n = 0; n < 20; ++n) brick[n] = number(i + at[n][0], j + at[n][1], k + at[n][2]);
    bricks_.push_back(brick);
  }

  const model::ManufacturedHinge& block_;
  const std::array<int, 3> count_;             ///< of bricks in the eighth
  std::map<std::array<int, 3>, int> numbers_;  ///< from 1
  std::vector<Eigen::Vector3d> nodes_;
  std::vector<std::array<int, 20>> bricks_;
};

/// N/mm, N mm/rad
struct BlockStiffness {
  double axial, shear, along, twist, rocking, turn;
};

inline bool has_calculix() { return std::system("command -v ccx > /dev/null") == 0; }

/// Returns, for each of six motions by `amount` (mm, rad), twice the energy that it stores, over its square.
/// @param count of bricks along the wall, across it and along the axis, even   @return empty if the program fails
inline std::optional<BlockStiffness> calculix_stiffness(const model::ManufacturedHinge& block,
                                                        const std::array<int, 3>& count) {
  constexpr double amount = 1e-3;
  const TemporaryFolder folder;
  const Bricks bricks(block, count);
  std::ofstream input(folder.path("block.inp"));
  input.precision(14);
  bricks.write(input);
  for (const bool turns : {false, true})
    for (int axis = 0; axis < 3; ++axis) bricks.write_step(input, turns, axis, amount);
  input.close();
  const std::string run = "cd '" + folder.path("") + "' && OMP_NUM_THREADS=1 ccx block > log";
  if (std::system(run.c_str()) != 0) return std::nullopt;

  std::ifstream output(folder.path("block.dat"));
  std::vector<double> energies;
  for (std::string line; std::getline(output, line);) {
    if (line.find("total internal energy") == std::string::npos) continue;
    double energy = 0;
    output >> energy;
    energies.push_back(8 * 2 * energy / (amount * amount));
  }
  if (energies.size() != 6) return std::nullopt;
  return BlockStiffness{energies[0], energies[1], energies[2], energies[3], energies[4], energies[5]};
}

/// Returns a block of these proportions, its length and height over its thickness. @param nu Poisson's ratio
inline model::ManufacturedHinge block_of(double length, double height, double nu) {
  constexpr double t = 0.8;  // mm
  return {.kind = model::HingeKind::block,
          .material = {.E_mpa = 2, .nu = nu},
          .gap_mm = length * t,
          .thickness_mm = t,
          .height_mm = height * t};
}

/// Returns the stiffness from three bricks per thickness along the wall, at least six, and four across it.
inline std::optional<BlockStiffness> calculix_stiffness(const model::ManufacturedHinge& block) {
  const double length = block.gap_mm / block.thickness_mm, height = block.height_mm / block.thickness_mm;
  return calculix_stiffness(block,
                            {2 * std::max(3, static_cast<int>(1.5 * length)), 4, height > 8 ? 20 : 12});
}

}  // namespace kinetix::testing
