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

/// A block of bricks with 20 nodes, x along the wall from 0 to L, y across it, z along the hinge's axis. With
/// reduced integration they do not lock where nu is near 0.5.
class Bricks {
 public:
  Bricks(const model::MadeHinge& block, std::array<int, 3> count) : block_(block), count_(count) {
    for (int a = 0; a < count[0]; ++a)
      for (int b = 0; b < count[1]; ++b)
        for (int c = 0; c < count[2]; ++c) add_brick(2 * a, 2 * b, 2 * c);
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
    out << "*NSET,NSET=HELD\n";
    for (const auto& [place, node] : numbers_)
      if (place[0] == 0) out << node << ",\n";
    out << "*MATERIAL,NAME=SOFT\n*ELASTIC\n"
        << block_.material.E_mpa << "," << block_.material.nu
        << "\n*SOLID SECTION,ELSET=BLOCK,MATERIAL=SOFT\n";
  }

  /// Writes a step that holds one end and moves the other as a rigid body: a shift, and a turn about the middle of the
  /// block.
  void write_step(std::ostream& out, const Eigen::Vector3d& shift, const Eigen::Vector3d& turn) const {
    out << "*STEP\n*STATIC\n*BOUNDARY,OP=NEW\nHELD,1,3\n";
    const Eigen::Vector3d middle(block_.gap_mm / 2, 0, 0);
    for (const auto& [place, node] : numbers_) {
      if (place[0] != 2 * count_[0]) continue;
      const Eigen::Vector3d moved = shift + turn.cross(nodes_[node - 1] - middle);
      for (int c = 0; c < 3; ++c) out << node << "," << c + 1 << "," << c + 1 << "," << moved[c] << "\n";
    }
    out << "*EL PRINT,ELSET=BLOCK,TOTALS=ONLY\nELSE\n*END STEP\n";
  }

 private:
  int number(int i, int j, int k) {
    const auto [at, is_new] = numbers_.try_emplace({i, j, k}, static_cast<int>(nodes_.size()) + 1);
    if (is_new)
      nodes_.emplace_back(block_.gap_mm * i / (2.0 * count_[0]),
                          block_.thickness_mm * (j / (2.0 * count_[1]) - 0.5),
                          block_.height_mm * (k / (2.0 * count_[2]) - 0.5));
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

  const model::MadeHinge& block_;
  const std::array<int, 3> count_;
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
/// @param count of bricks along the wall, across it and along the axis   @return empty if the program fails
inline std::optional<BlockStiffness> calculix_stiffness(const model::MadeHinge& block,
                                                        const std::array<int, 3>& count) {
  constexpr double amount = 1e-3;
  const TemporaryFolder folder;
  const Bricks bricks(block, count);
  std::ofstream input(folder.path("block.inp"));
  input.precision(14);
  bricks.write(input);
  for (int c = 0; c < 3; ++c)
    bricks.write_step(input, amount * Eigen::Vector3d::Unit(c), Eigen::Vector3d::Zero());
  for (int c = 0; c < 3; ++c)
    bricks.write_step(input, Eigen::Vector3d::Zero(), amount * Eigen::Vector3d::Unit(c));
  input.close();
  const std::string run = "cd '" + folder.path("") + "' && OMP_NUM_THREADS=1 ccx block > log";
  if (std::system(run.c_str()) != 0) return std::nullopt;

  std::ifstream output(folder.path("block.dat"));
  std::vector<double> energies;
  for (std::string line; std::getline(output, line);) {
    if (line.find("total internal energy") == std::string::npos) continue;
    double energy = 0;
    output >> energy;
    energies.push_back(2 * energy / (amount * amount));
  }
  if (energies.size() != 6) return std::nullopt;
  return BlockStiffness{energies[0], energies[1], energies[2], energies[3], energies[4], energies[5]};
}

/// Returns a block of these proportions, its length and height over its thickness. @param nu Poisson's ratio
inline model::MadeHinge block_of(double length, double height, double nu) {
  constexpr double t = 0.8;  // mm
  return {.kind = model::HingeKind::block,
          .material = {.E_mpa = 2, .nu = nu},
          .gap_mm = length * t,
          .thickness_mm = t,
          .height_mm = height * t};
}

/// Returns the stiffness from three bricks per thickness along the wall, at least six, and four across it.
inline std::optional<BlockStiffness> calculix_stiffness(const model::MadeHinge& block) {
  const double length = block.gap_mm / block.thickness_mm, height = block.height_mm / block.thickness_mm;
  return calculix_stiffness(block, {std::max(6, static_cast<int>(3 * length)), 4, height > 8 ? 20 : 12});
}

}  // namespace kinetix::testing
