#pragma once

#include "optim/surface/fit_surface.hpp"
#include "targets/surface/gauss_curvature.hpp"

namespace kinetix::optim {

/// Returns the middles of a sheet's facets, mm. Each facet has two vertices in either layer. The middles are
/// therefore on the surface between the layers, without the zigzags of the folds.
targets::PointGrid middle_of(const SurfaceDesign& design);

/// Returns points of a surface below a grid, evenly between its points and within the surface's rim. mm
std::vector<Eigen::Vector3d> points_below(const targets::SurfacePatch& surface,
                                          const targets::PointGrid& grid);

/// Returns the least rms distance of points from any cylinder or cone, mm: the limit of a sheet of paper that
/// bends in one direction. For a cone of axis a through b, of half angle w and radius r about b, the distance
/// is d = cos w |(p - b) x a| - sin w (p - b) . a - r. It is a cylinder for w = 0. Cones whose tip is over
/// the points are excluded, since a tip is curved in both directions. Solved by least squares from eight
/// directions of a.
/// @pre at least 7 points, not all on one line
double rms_from_best_cone(const std::vector<Eigen::Vector3d>& points);

}  // namespace kinetix::optim
