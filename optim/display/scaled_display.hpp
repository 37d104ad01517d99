#pragma once

#include <array>
#include <optional>
#include <vector>

#include "model/lattice/planar/planar_motion.hpp"
#include "model/linkage/axis.hpp"

namespace kinetix::optim {

/// A search for a panel that shows a picture without any strain, by the scales of its walls.
struct ScaledDisplayOptions {
  model::Axis axis = model::Axis::y;  ///< normal of the plates
  /// By the plates, fraction of their distance at rest, within (0, 0.5]: as far as walls stay apart.
  std::array<double, 2> compression = {0.185, 0.185};
  double offset = 0.08;                  ///< largest |offset| of a hinge, cell edges, (0, 0.5)
  std::array<double, 2> t = {0.2, 0.8};  ///< range; the side that is nearer to 0.5 counts for both
  /// Of the last row in the redrawing (WallScales::drop), cell edges, >= 0; at most an eightieth of the panel's
  /// height is used.
  double drop = 0.15;
  /// theta, rad, (0, pi/2), to which a driven hinge takes the panel: no plates, no straight rows, and what is
  /// said of plates above has no effect. Nothing: plates.
  std::optional<double> free_to = {};
  std::optional<int> hinge = {};  ///< the driven one; nothing: middle_hinge()
};

/// A panel that came out, at the drive's goal.
struct ScaledDisplay {
  model::Redrawing y;      ///< of each body
  double compression = 0;  ///< by the plates, fraction of their distance at rest; 0 where a hinge is driven
  double theta = 0;        ///< rad, there
  double offset = 0;       ///< largest |offset|, cell edges
  double shift = 0;        ///< largest |2 t - 1|, ratio
  bool converged = false;  ///< as ScaledWalls
  int rounds = 0;          ///< convex problems solved, with less and less turning until walls stay apart
  int iterations = 0;      ///< in all
  bool clear = false;      ///< no walls meet on the way
  double clear_to = 0;     ///< rad; where the first walls meet, or a little beyond theta where none do
};

/// theta, rad, at which a panel with this drop is compressed so far: rows are H cos(theta) - drop sin(theta)
/// apart, with H their distance at rest, cell edges. @pre compression in (0, 1), drop >= 0, height > 0
double theta_of_compression(double compression, double drop, double height);
/// And back.
double compression_at(double theta, double drop, double height);

/// Scales walls of cells with high levels up, those of others down (scale_walls), rows at the plates straight or,
/// where a hinge is driven, all of them free: then cells of the picture grow by more against the others.
/// Where walls would meet before the goal, again with less turning.
/// @param panel where its hinges sit has no effect   @param levels of its first cells, [0, 1], not all the same;
/// those after them have none and keep their size
/// @throws InvalidInput for options out of range, and a panel that its plates would touch at one vertex alone
ScaledDisplay scale_display(const model::PlanarStructure& panel, const std::vector<double>& levels,
                            const ScaledDisplayOptions& options);

}  // namespace kinetix::optim
