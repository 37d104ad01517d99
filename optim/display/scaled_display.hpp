#pragma once

#include "model/closure/closure.hpp"
#include "model/lattice/planar/planar_motion.hpp"
#include "model/linkage/linkage.hpp"

namespace kinetix::optim {

/// Returns the hinge by which a panel is best turned as a whole. In the middle half, across and up, the path
/// to every other hinge is short. Of its hinges the one with the least offset is chosen, whose wall scales
/// least; ties go to the nearest to the middle. A strip has no hinge in its middle half: then the nearest to
/// the middle is chosen.
int middle_hinge(const model::PlanarStructure& panel, const model::ParallelDrawing& y);

/// Returns the turn of that hinge at which the panel reaches theta, rad.
model::HingeTurn turn_to(const model::PlanarStructure& panel, int hinge, double theta);

/// Options of the search for a panel that shows a picture without any strain, by the scales of its walls.
struct ScaledDisplayOptions {
  model::Axis axis = model::Axis::y;  ///< normal of the plates
  /// Compression by the plates, fraction of their distance at rest, within (0, 0.5]: used as far as walls
  /// stay apart.
  std::array<double, 2> compression = {0.185, 0.185};
  double offset = 0.08;                  ///< largest |offset| of a hinge, cell edges, (0, 0.5)
  std::array<double, 2> t = {0.2, 0.8};  ///< range, fractions; the bound nearer to 0.5 limits both sides
  /// Drop of the last row in the parallel drawing (WallScales::drop), cell edges, >= 0. At most an eightieth
  /// of the panel's height is used.
  double drop = 0.15;
  /// theta, rad, (0, pi/2), to which a driven hinge moves the panel. Without plates no rows are straight, and
  /// the options of plates above have no effect. Unset: plates.
  std::optional<double> free_to = {};
  std::optional<int> hinge = {};  ///< index of the driven hinge; unset: middle_hinge()
};

/// Panel found, at the drive's goal.
struct ScaledDisplay {
  model::ParallelDrawing y;  ///< of each body
  double compression = 0;    ///< by the plates, fraction of their distance at rest; 0 with a driven hinge
  double theta = 0;          ///< rad, at that compression
  double offset = 0;         ///< largest |offset|, cell edges
  double shift = 0;          ///< largest |2 t - 1|, ratio
  bool converged = false;    ///< as in ScaledWalls
  int rounds = 0;            ///< convex problems solved, with less and less turning until walls stay apart
  int iterations = 0;        ///< in all
  bool clear = false;        ///< no walls meet during the motion
  double clear_to = 0;       ///< rad, first contact of walls, or a little beyond theta without contact
};

/// Returns theta, rad, at which a panel with this drop has this compression. Rows are H cos(theta) - drop
/// sin(theta) apart, where H is their distance at rest, cell edges.
/// @pre compression in (0, 1), drop >= 0, height > 0
double theta_of_compression(double compression, double drop, double height);
/// Returns the compression at theta, the inverse of theta_of_compression().
double compression_at(double theta, double drop, double height);

/// Scales walls of cells with high levels up and those of others down (scale_walls). Rows at the plates stay
/// straight. With a driven hinge all rows are free, which lets cells of the picture grow by more against the
/// others. If walls would meet before the goal, it repeats with less turning.
/// @param panel its hinge positions have no effect.
/// @param levels of its first cells, [0, 1], not all the same; the cells behind them keep their size.
/// @throws InvalidInput for options out of range, and a panel that its plates would touch at one vertex only
ScaledDisplay scale_display(const model::PlanarStructure& panel, const std::vector<double>& levels,
                            const ScaledDisplayOptions& options);

}  // namespace kinetix::optim
