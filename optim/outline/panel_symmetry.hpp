#pragma once

#include "model/lattice/planar/planar_structure.hpp"
#include "targets/outline/outline.hpp"

namespace kinetix::optim {

/// Mirroring or turn about the middle that maps a panel and its outlines onto themselves.
struct PanelSymmetry {
  Eigen::Matrix2d map;        ///< orthogonal, ratios
  std::vector<int> vertices;  ///< image of each vertex
  std::vector<int> edges;     ///< image of each wall
};

/// Returns all symmetries that a panel at rest and its outlines share, except the identity. They form a group with it:
/// turns by multiples of 30 deg, and mirrorings with axes at multiples of 15 deg. An outline has a symmetry if its
/// image is off it by at most 0.2 % of its diagonal.
/// @param flat outline of the panel at rest; null: none is prescribed
std::vector<PanelSymmetry> find_symmetries(const model::PlanarStructure& panel,
                                           const targets::Outline& folded, const targets::Outline* flat);

/// Replaces places by the mean of their images under all symmetries. Symmetric places stay as they are.
/// @param middle fixed point of the symmetries
void symmetrise(const std::vector<PanelSymmetry>& symmetries, const Eigen::Vector2d& middle,
                std::vector<Eigen::Vector2d>& places);

}  // namespace kinetix::optim
