#pragma once

#include <stop_token>

#include "model/base/progress.hpp"
#include "optim/surface/surface_problem.hpp"

namespace kinetix::optim {

/// A search for a flat-foldable mesh that covers a surface.
struct SurfaceOptions {
  int columns = 8, rows = 8;              ///< of facets, >= 2
  double theta = 0.5;                     ///< rad, (0, pi/4)
  double tilt = 75 * radians_per_degree;  ///< largest of a hinge, rad, (0, pi/2)
  MeshBounds bounds = {};  ///< but for the multiplier, which follows from theta and tilt, and a quarter of
                           ///< which is the most that `least_fold` may be
  int starts = 8;          ///< >= 1
  int iterations = 300;    ///< >= 1: each start takes up to 0.7, those that go on up to 2 more
  /// Rounds of searches anew from the best sheet, shaken, >= 0: they find valleys beside its own that no regular
  /// start leads to. None follow once its rms is at most `enough`.
  int shakes = 0;
  double enough = 0;          ///< over the diagonal, >= 0
  int threads = 0;            ///< 0: all cores
  std::stop_token stop = {};  ///< where it asks to, the best so far is the answer

  /// @throws InvalidInput naming field, value and rule
  void validate() const;
};

/// How a mesh lies on a surface.
struct SurfaceError {
  double rms = 0;    ///< of all vertices from the two layers, over the diagonal
  double max = 0;    ///< likewise the largest, over the diagonal, ratio
  double cover = 0;  ///< area that mesh and surface share over the area of both, seen along z, [0, 1]
};

/// What came out.
struct SurfaceDesign {
  model::QuadMesh mesh;                   ///< flat, mm: folded it is cos(theta) as large
  std::vector<Eigen::Vector3d> vertices;  ///< folded and in place, mm
  double theta = 0;                       ///< rad
  double layer = 0;                       ///< half distance of the two layers, mm; < 0: odd columns are below
  SurfaceError error;
  std::array<double, 2> sector = {}, edge = {};  ///< least and largest: rad, over the mean edge
  double tilt = 0;                               ///< largest of a hinge, rad
  bool valid = false;                            ///< it folds flat, no facet turned over
  bool within = false;                           ///< bounds hold
  bool stopped = false;                          ///< before the search had come to its end
  int start = 0, starts = 0, evaluations = 0;    ///< the best one, of how many, residuals in all
  int shakes = 0;                                ///< searches from shaken sheets
};

/// Miura sheets of several proportions are laid on the surface and fitted to it: all for a while, then the better half
/// of them until they end by themselves. Errors creep down for hundreds of steps, and which start is among the best
/// shows long before.
/// @throws InvalidInput for options out of range
SurfaceDesign fit_surface(const targets::SurfacePatch& patch, const SurfaceOptions& options,
                          const Progress& progress = {});

}  // namespace kinetix::optim
