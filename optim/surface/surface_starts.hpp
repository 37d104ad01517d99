#pragma once

#include "optim/surface/surface_variables.hpp"
#include "targets/surface/surface_patch.hpp"

namespace kinetix::optim {

/// Miura sheet to start from.
struct MiuraStart {
  double angle = 1.13;  ///< of its parallelograms, rad
  double fold = 0.8;    ///< tan(rho / 2) of its rising creases, dimensionless
  int side = 1;         ///< 1: odd columns of vertices are above, -1: below
  int turn = 1;         ///< sign of the level creases: its zigzags start upwards or downwards
};

/// Sheet as large as the surface's rectangle, in its plane.
struct SurfaceStart {
  SurfaceVariables variables;
  Eigen::VectorXd x;  ///< in the rad and ratios of SurfaceVariables
};
SurfaceStart start_on(const targets::SurfacePatch& patch, int columns, int rows, const MiuraStart& miura);

}  // namespace kinetix::optim
