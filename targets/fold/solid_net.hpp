#pragma once

#include "model/lattice/planar/planar_structure.hpp"
#include "targets/fold/fold_error.hpp"
#include "targets/fold/solid.hpp"

namespace kinetix::targets {

/// A face of a solid in its flat net: quadrilateral cells between its middle, the middles of its sides and its corners.
struct SolidFace {
  std::vector<int> bodies;             ///< ascending; the first is in the middle
  std::vector<Eigen::Vector2d> ideal;  ///< of each body: its place on the flat face, cell edges
  std::vector<std::vector<int>>
      sides;  ///< of each side, from its first corner: bodies from which walls cross it
};

/// The fold between two faces, over strips of walls one after the other.
struct SolidCrease {
  int first = 0, second = 0;
  double angle = 0;                      ///< rad, > 0: the faces rise
  std::vector<std::vector<int>> hinges;  ///< of each column, one a wall across it
  Eigen::Vector2d line =
      Eigen::Vector2d::UnitX();  ///< unit vector along its fold lines in the net, dimensionless
};

/// Solid cut open and laid flat as one sheet (kinematics.md section 6). Its faces consist of quadrilateral cells.
/// Walls to the next face are at right angles to the fold lines, which halve them. All hinges have t = 1/2, and all
/// are upright before fold_solid().
struct SolidNet {
  Solid solid;
  int columns = 1;  ///< of each crease
  double edge = 0;  ///< shortest, of the folded solid if its cells are as large as flat, cell edges
  model::PlanarStructure structure;
  std::vector<SolidFace> faces;
  std::vector<SolidCrease> creases;
};

/// Lays a solid flat as one sheet.
/// @param cells per half side of a face, >= 1. @param columns fold lines per crease, >= 1.
/// @throws InvalidInput for sizes that make_planar_structure refuses. It also throws if no cut has been found that
/// lays the solid flat without overlap.
SolidNet lay_out(const Solid& solid, int cells, int columns, const model::CellSize& size);

/// Leans the hinges of all creases so that at theta they fold by their angles. @param theta rad, (0, pi/2)
/// @return tilt of each crease, rad
std::vector<double> fold_solid(SolidNet& net, double theta);

/// Computes the deviation of a state from its solid: folds by planes through the bodies of faces, distances of bodies
/// over the edge of the solid. The solid, its edges cos(theta) times as long as the net's, is laid over all faces
/// together. NaN gives NaN.
FoldError solid_error(const SolidNet& net, const model::State& state, double theta);

/// Returns the places of the bodies of all faces on the ideal solid, laid over a state, mm. @pre the state is finite
std::vector<IdealPoint> ideal_places(const SolidNet& net, const model::State& state, double theta);

}  // namespace kinetix::targets
