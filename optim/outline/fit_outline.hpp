#pragma once

#include "model/base/progress.hpp"
#include "model/lattice/planar/planar_lattice.hpp"
#include "optim/outline/outline_problem.hpp"
#include "targets/outline/outline.hpp"

namespace kinetix::optim {

/// Returns cuts of a lattice that resemble an outline when flat: the cells whose middle is inside it. The
/// outline fills the rectangle of columns x rows, is a little smaller or larger, and is shifted by half a
/// cell. Each cut is connected by walls and has at least four cells; no cut occurs twice. Columns and rows
/// are moved to start at 0 (rows by an even number, since odd ones may be shifted).
/// @param angle rad, of lattices with an angle
std::vector<std::vector<model::LatticeCell>> trimmed_cells(const model::PlanarLattice& lattice, double angle,
                                                           int columns, int rows,
                                                           const targets::Outline& outline);

/// Options of the search for a panel whose boundary takes the shape of an outline.
struct OutlineOptions {
  std::array<double, 2> theta = {0.35, 0.70};  ///< range, rad, within (0, pi/2)
  double offset = 0.08;                        ///< largest |offset| of a hinge, cell edges, [0, 0.5); 0: none
  std::array<double, 2> t = {0.12, 0.88};  ///< range, fractions; the bound nearer to 0.5 limits both sides
  int thetas = 4;                          ///< tried, evenly between the ends of the range, >= 1
  /// Shape of the panel at which the search starts, at theta[1] alone. Null: the panel as it is, at several thetas.
  const OutlineShape* start = nullptr;
  int threads = 1;            ///< that try them, 0: all cores; the result does not depend on it
  std::stop_token stop = {};  ///< on request, the best so far is the result
};

/// Panel found.
struct OutlineDesign {
  model::PlanarStructure panel;  ///< with its hinges; its size's edge_mm is still that of the input
  model::ParallelDrawing y;      ///< of each vertex
  double theta = 0;              ///< rad
  double scale = 1;              ///< mm of the outline per cell edge
  OutlineShape shape;            ///< of the panel in the search, for the start of a finer one
  /// Position of the outline's origin in the frame of the states that y gives, at theta, cell edges.
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  targets::OutlineError error;  ///< of the boundary's vertices at theta
  targets::OutlineError flat;   ///< of the boundary's vertices at rest, if prescribed
  double offset = 0;            ///< largest |offset|, cell edges
  double shift = 0;             ///< largest |2 t - 1|, ratio
  double at_bounds_offset = 0;  ///< share of the walls with the largest allowed |offset|, [0, 1]
  double at_bounds_shift = 0;   ///< share of walls at their limit of |2 t - 1| (less for walls that met)
  bool clear = false;           ///< no walls meet during the motion
  bool settled = false;         ///< no vertex moved any more in the last round at this theta
  bool stopped = false;         ///< stopped before the end of the search
  int rounds = 0;               ///< convex problems solved, in all
  int clearance_rounds = 0;     ///< at this theta, with less turning of the walls that met
};

/// Fits the boundary at theta. Every intermediate panel is an exact motion with all hinges closed. If walls
/// would meet before theta, those walls turn less. The boundary has all symmetries that panel and outlines share.
/// @param panel its hinge positions have no effect.
/// @param flat outline of its boundary at rest, in its size's edge_mm, with the panel's vertices as
/// variables; null: the vertices stay.
/// @throws InvalidInput for options out of range
OutlineDesign fit_outline(const model::PlanarStructure& panel, const targets::Outline& folded,
                          const targets::Outline* flat, const OutlineOptions& options,
                          const Progress& progress = {});

}  // namespace kinetix::optim
