#pragma once

#include <Eigen/Core>
#include <vector>

#include "optim/surface/fit_surface.hpp"
#include "targets/surface/gauss_curvature.hpp"

namespace kinetix::optim {

/// The middles of a sheet's facets, mm: each has two vertices in either layer, so that they lie on the surface between the
/// layers, without the zigzags of the folds.
targets::PointGrid middle_of(const SurfaceDesign& design);

/// Points of a surface below a grid, evenly between its points, without those beyond the surface's rim. mm
std::vector<Eigen::Vector3d> points_below(const targets::SurfacePatch& surface,
                                          const targets::PointGrid& grid);

/// Least rms distance of points from any cylinder or cone, mm: what a sheet of paper that bends one way can do. A cone of axis a
/// through b, of half angle w and radius r about b: d = cos w |(p - b) x a| - sin w (p - b) . a - r, a cylinder where w
/// is 0. Cones whose tip lies over the points do not count: a tip is curved both ways. By least squares from eight directions of a. @pre at least 7 points, not all on one line
double rms_from_best_cone(const std::vector<Eigen::Vector3d>& points);

}  // namespace kinetix::optim
