#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace kinetix::app::cad {

/// A solid that a CAD file holds, at its place.
struct FoundSolid {
  std::string name;                     ///< as the file has it; empty: none
  std::string colour;                   ///< #rrggbb; empty: none
  std::vector<Eigen::Vector3d> points;  ///< mm
  std::vector<std::array<int, 3>>
      triangles;  ///< counter-clockwise from outside; faces of the solid share no points
};

}  // namespace kinetix::app::cad
