#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace kinetix::app::cad {

/// Solid of a CAD file, placed as in the file's assembly.
struct FoundSolid {
  std::string name;                     ///< as the file has it; empty: none
  std::string colour;                   ///< #rrggbb; empty: none
  std::vector<Eigen::Vector3d> points;  ///< mm
  std::vector<std::array<int, 3>>
      triangles;  ///< counter-clockwise from outside; faces of the solid share no points
};

// Encoding by which kinetix-read-step passes solids to the program that started it.

std::string to_bytes(const std::vector<FoundSolid>& solids);

/// @throws std::runtime_error for bytes that end early, and for triangles with missing points
std::vector<FoundSolid> read_solids(std::string_view bytes);

}  // namespace kinetix::app::cad
