#pragma once

#include "model/base/progress.hpp"
#include "model/lattice/origami/origami_sheet.hpp"
#include "optim/surface/surface_problem.hpp"
#include "targets/surface/gauss_curvature.hpp"

namespace kinetix::optim {

/// Options of the search for a flat-foldable mesh that covers a surface.
struct SurfaceOptions {
  int columns = 8, rows = 8;              ///< of facets, >= 2
  double theta = 0.5;                     ///< rad, (0, pi/4)
  double tilt = 75 * radians_per_degree;  ///< largest tilt of a hinge, rad, (0, pi/2)
  MeshBounds bounds = {};  ///< its multiplier is replaced by the one of theta and tilt, and `min_fold` is
                           ///< at most a quarter of that
  int starts = 8;          ///< >= 1
  int iterations = 300;    ///< >= 1: each start takes up to 0.7 of it, the better half up to 2 more
  /// Number of rounds of new searches from the best sheet, shaken, >= 0. They find minima near it that no
  /// regular start leads to. They end once its rms is at most `enough`.
  int shakes = 0;
  double enough = 0;          ///< over the diagonal, >= 0
  int threads = 0;            ///< 0: all cores
  std::stop_token stop = {};  ///< on request, the best so far is the result

  /// @throws InvalidInput naming field, value and rule
  void validate() const;
};

/// Error of a mesh on a surface.
struct SurfaceError {
  double rms = 0;    ///< of all vertices from the two layers, over the diagonal
  double max = 0;    ///< largest distance of a vertex, over the diagonal, ratio
  double cover = 0;  ///< area common to mesh and surface over the area of both, seen along z, [0, 1]
};

/// Sheet found.
struct SurfaceDesign {
  model::QuadMesh mesh;                   ///< flat, mm; the folded mesh is scaled by cos(theta)
  std::vector<Eigen::Vector3d> vertices;  ///< folded and in place, mm
  double theta = 0;                       ///< rad
  double layer = 0;                       ///< half distance of the two layers, mm; < 0: odd columns are below
  SurfaceError error;
  std::array<double, 2> sector = {}, edge = {};  ///< least and largest: rad, and over the mean edge
  double tilt = 0;                               ///< largest tilt of a hinge, rad
  bool valid = false;                            ///< it folds flat, with no facet inverted
  bool within = false;                           ///< it is within all bounds
  bool stopped = false;                          ///< stopped before the end of the search
  int start = 0, starts = 0, evaluations = 0;    ///< index of the best start, their number, all residual
                                                 ///< evaluations
  int shakes = 0;                                ///< searches from shaken sheets
};

/// Fits Miura sheets of several proportions to the surface. All are searched for a while, then the better
/// half until they converge. Errors decrease slowly for hundreds of steps, but the best starts show long
/// before that.
/// @throws InvalidInput for options out of range
SurfaceDesign fit_surface(const targets::SurfacePatch& patch, const SurfaceOptions& options,
                          const Progress& progress = {});

/// Returns the largest height of plates, cell edges, up to `most`, at which no two walls of a sheet meet from
/// flat to theta. 0 if they meet even as threads. Found by bisection with 40 states per motion; the thickness
/// is that of the sheet.
double free_height(const model::OrigamiSheet& sheet, double theta, double most = 1);

/// Returns whether no walls meet at the sheet's own height.
bool is_free(const model::OrigamiSheet& sheet, double theta);

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
