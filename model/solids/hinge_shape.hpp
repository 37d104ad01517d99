#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/linkage/cell_size.hpp"
#include "model/matter/made_hinge.hpp"

namespace kinetix::model {

/// What one half of a wall ends in at its hinge, in the hinge's own directions: m from the half wall towards the
/// axis and square to it, n across the wall, s along the axis. m is 0 on the axis, n in the middle of the wall, s
/// halfway up. mm
///
/// The wall's plate ends square to m at -wall_end. From there lugs go on, which all have the same section, each over
/// a stretch of the axis.
struct HingeEnd {
  /// A stretch of the axis over which the end goes on beyond the plate.
  struct Lug {
    double from = 0, to = 0;  ///< of s, mm
  };

  double wall_end = 0;     ///< of the plate, before the axis, > 0, mm
  double axis_across = 0;  ///< n of the axis, mm
  std::vector<Eigen::Vector2d> section =
      {};                      ///< convex, (m, n), mm: from (-wall_end, -T/2) round to (-wall_end, T/2)
  std::vector<Lug> lugs = {};  ///< upwards
  std::vector<Eigen::Vector2d> bore = {};  ///< through all lugs, (m, n), mm, round the axis; empty: none
  std::vector<Eigen::Vector2d> rod = {};   ///< from the first lug to the second, likewise; empty: none
  /// Where the flat rims of faces between fork and eye end, likewise: within, cones go on to rod or bore. Empty: flat.
  std::vector<Eigen::Vector2d> rim = {};
  double cone = 0;  ///< along s from the rim to rod or bore, mm: up from a fork's lower lug, into an eye
  /// The circles about the axis that section, bore, rod and rim are polygons of, mm; 0: none. A knuckle's may have its
  /// middle beside the axis.
  double knuckle_radius = 0, bore_radius = 0, rod_radius = 0, rim_radius = 0;
  double knuckle_across = 0;  ///< n of the middle of its circle, mm
};

/// How a hinge is made by a process.
struct HingePrint {
  MadeHinge made;
  double axial_clearance_mm = 0;  ///< of a pin, between its knuckles along the axis, mm, >= 0
  double knuckle_wall_mm = 0.8;   ///< of a pin, round its bore, mm, > 0
  double turn = 0;     ///< of the upper half against the lower about the axis, the largest, rad, (-pi, pi)
  bool loose = false;  ///< a pin's rod is a part of its own, pushed into bores of the fork
  double tolerance_mm = 0.01;  ///< by which a polygon may differ from its circle, mm, > 0
  /// Of a pin: how far axes are from the middle of their walls at most, mm. Its knuckles are then round caps about the
  /// middle, as large as the furthest axis asks for, with their bores beside it: so all look alike. 0: about their axes.
  double cap_across_mm = 0;
  /// Of a pin that is printed in place: width of the flat rim of faces between fork and eye, mm; within, they are cones about
  /// the rod, `cone_rise` times as high as wide, so that nothing but the rim hangs over the clearance. 0: flat.
  double rim_mm = 0;
};

/// Of the cones of pins: a little steeper than the 45 degrees that FDM prints without support.
inline constexpr double cone_rise = 1.1;

/// Both ends of a pin: a fork of two knuckles with the rod between them, and an eye between these that turns on it.
/// Rod and bore are polygons whose gap is nowhere less than the clearance: the rod's corners and the middles of the
/// bore's sides are on their circles. A plate ends its clearance before the other's knuckles, and before its corners would
/// meet the other's at the largest turn: those on the side towards which the wall folds. Caps beside their axis come nearer
/// as they turn, by the sine of it.
/// @param hinge with the turn of the other end against this one about s   @param axis_across of the wall's middle, mm
/// @param fork whether it is the fork
HingeEnd pin_end(const HingePrint& hinge, const CellSize& size, double axis_across, bool fork);

/// An end of a wall at a block or film, half its gap before the axis. Where the block sits beyond the wall's face, a
/// foot carries it, at 45 degrees as far as the wall is thick and from there on that deep.
HingeEnd block_end(const HingePrint& hinge, const CellSize& size, double axis_across);

/// Half the distance between a wall's two ends that its corners need so as not to meet, mm. @param turn as of pin_end
double corner_room(double half_wall, double axis_across, double turn);

/// Of a pin's rod about its axis, as many sides as its bores have, mm.
std::vector<Eigen::Vector2d> rod_section(const HingePrint& hinge);

/// By the hinge's kind.
HingeEnd hinge_end(const HingePrint& hinge, const CellSize& size, double axis_across, bool fork);

/// Number of sides of a regular polygon whose corners are on a circle and whose sides leave it by at most the
/// tolerance: a multiple of four, at least 12.
int circle_sides(double radius_mm, double tolerance_mm);

}  // namespace kinetix::model
