#pragma once

#include <stop_token>

#include "model/base/progress.hpp"
#include "optim/outline/outline_problem.hpp"

namespace kinetix::optim {

/// A search for a panel whose rim takes the shape of an outline.
struct OutlineOptions {
  std::array<double, 2> theta = {0.35, 0.70};  ///< range, rad, within (0, pi/2)
  double offset = 0.08;                        ///< largest |offset| of a hinge, cell edges, [0, 0.5); 0: none
  std::array<double, 2> t = {0.12, 0.88};      ///< range; the side that is nearer to 0.5 counts for both
  int thetas = 4;                              ///< tried between the ends of its range, >= 1
  int threads = 1;            ///< on which they are tried, 0: all cores; the answer does not depend on it
  std::stop_token stop = {};  ///< where it asks to, the best so far is the answer
};

/// A panel that came out.
struct OutlineDesign {
  model::PlanarStructure panel;  ///< with its hinges; its size's edge_mm is still the one that came in
  model::Redrawing y;            ///< of each vertex
  double theta = 0;              ///< rad
  double scale = 1;              ///< mm of the outline a cell edge
  /// Where the outline's origin lies in the frame of the states that y gives, at theta, cell edges.
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  targets::OutlineError error;  ///< of the rim's vertices at theta
  targets::OutlineError flat;   ///< likewise at rest, where that is prescribed
  double offset = 0;            ///< largest |offset|, cell edges
  double shift = 0;             ///< largest |2 t - 1|, ratio
  double at_bounds_offset = 0;  ///< share of the walls whose offset is as large as is allowed, [0, 1]
  double at_bounds_shift = 0;   ///< likewise of 2 t - 1, [0, 1]; walls that met have a lower bound
  bool clear = false;           ///< no walls meet on the way
  bool settled = false;      ///< no vertex moved any more when the search at this theta took no more rounds
  bool stopped = false;      ///< before the search had come to its end
  int rounds = 0;            ///< convex problems solved, in all
  int clearance_rounds = 0;  ///< at this theta, with less turning of the walls that met
};

/// Fits the rim at theta. Every panel on the way is an exact motion with all hinges closed; where walls would meet
/// before theta, those turn less.
/// @param panel where its hinges sit has no effect   @param flat of its rim at rest, in its size's edge_mm: its
/// vertices are then variables; nothing: they stay
/// @throws InvalidInput for options out of range
OutlineDesign fit_outline(const model::PlanarStructure& panel, const targets::Outline& folded,
                          const targets::Outline* flat, const OutlineOptions& options,
                          const Progress& progress = {});

}  // namespace kinetix::optim
