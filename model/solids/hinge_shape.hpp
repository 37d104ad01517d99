#pragma once

#include "model/linkage/linkage.hpp"
#include "model/material/manufactured_hinge.hpp"
#include "model/material/process.hpp"

namespace kinetix::model {

/// End of one half of a wall at its hinge, in the hinge's directions. The direction m goes from the half wall to the
/// axis and is normal to it, n goes across the wall, s along the axis. m is 0 on the axis, n in the middle of the
/// wall, s halfway up. Units are mm.
///
/// The wall's plate ends normal to m at -wall_end. Lugs of one section continue from there, each over a stretch of
/// the axis.
struct HingeEnd {
  /// A stretch of the axis over which the end continues beyond the plate.
  struct Lug {
    double from = 0, to = 0;  ///< range of s, mm
  };

  double wall_end = 0;     ///< end of the plate before the axis, > 0, mm
  double axis_across = 0;  ///< n of the axis, mm
  /// Convex, (m, n), mm: from (-wall_end, -T/2) around to (-wall_end, T/2)
  std::vector<Eigen::Vector2d> section = {};
  std::vector<Lug> lugs = {};              ///< upwards
  std::vector<Eigen::Vector2d> bore = {};  ///< through all lugs, (m, n), mm, around the axis; empty: none
  /// From the first lug to the second, (m, n), mm, around the axis; empty: none.
  std::vector<Eigen::Vector2d> rod = {};
  /// Inner edges of the flat rims of faces between fork and eye, (m, n), mm. Cones continue inwards to rod or bore.
  /// Empty: flat faces.
  std::vector<Eigen::Vector2d> rim = {};
  /// Height along s from the rim to rod or bore, mm: up from a fork's lower lug, into an eye.
  double cone = 0;
  /// Radii of the circles that section, bore, rod and rim approximate by polygons, mm; 0: none. They are about the
  /// axis; the circle of a knuckle may have its middle off the axis.
  double knuckle_radius = 0, bore_radius = 0, rod_radius = 0, rim_radius = 0;
  double knuckle_across = 0;  ///< n of the middle of its circle, mm
};

/// Parameters of a hinge in a process.
struct HingePrint {
  ManufacturedHinge made;
  double axial_clearance_mm = 0;  ///< between a pin's knuckles along the axis, mm, >= 0
  double knuckle_wall_mm = 0.8;   ///< around a pin's bore, mm, > 0
  double min_gap_mm = 0;          ///< least gap between two printed parts, mm, >= 0
  double turn = 0;  ///< largest turn of the upper half relative to the lower about the axis, rad, (-pi, pi)
  bool loose = false;          ///< true: a pin's rod is a separate part, pushed into bores of the fork
  double tolerance_mm = 0.01;  ///< largest deviation of a polygon from its circle, mm, > 0.
  /// Largest distance of a pin's axis from the middle of its wall, mm. Knuckles are then round caps about the middle,
  /// sized for the farthest axis, with their bores off the middle: all have one shape. 0: knuckles about their axes.
  double cap_across_mm = 0;
  /// Width of the flat rim of faces between fork and eye, mm, for a pin that is printed in place. Inside it they are
  /// cones about the rod, `cone_rise` times as high as wide, so that only the rim overhangs the clearance. 0: flat.
  double rim_mm = 0;
};

/// Returns the gap between each end of a pin and the knuckles of the other, mm: the clearance, or min_gap_mm if the bore
/// of a separate rod is tighter.
inline double gap_mm(const HingePrint& pin) { return std::max(pin.made.clearance_mm, pin.min_gap_mm); }

/// Height over width of the cones of pins: slightly steeper than the 45 degrees that FDM prints without support.
inline constexpr double cone_rise = 1.1;

/// Returns one end of a pin. The fork has two knuckles with the rod between them; the eye is between these and turns
/// on it.
/// Rod and bore are polygons whose gap is nowhere less than the clearance. The rod's corners and the middles of the
/// bore's sides are on their circles. A plate ends gap_mm() before the other's knuckles. It also ends before its
/// corners would meet the other's at the largest turn, on the side towards which the wall folds. Caps off their axis
/// approach as they turn, by the sine of the turn.
/// @param hinge with the turn of the other end relative to this one about s   @param axis_across n of the axis, mm
/// @param fork true for the fork, false for the eye
HingeEnd pin_end(const HingePrint& hinge, const CellSize& size, double axis_across, bool fork);

/// Returns an end of a wall at an elastomer block or film, half its gap before the axis. If the block extends beyond
/// the wall's face, a foot carries it. The foot is at 45 degrees up to the wall's thickness, and of that depth
/// beyond.
HingeEnd block_end(const HingePrint& hinge, const CellSize& size, double axis_across);

/// Returns half the distance between a wall's two ends at which their corners just do not meet, mm. @param turn as of
/// pin_end
double corner_room(double half_wall, double axis_across, double turn);

/// Returns the section of a pin's rod about its axis, with as many sides as its bores, mm.
std::vector<Eigen::Vector2d> rod_section(const HingePrint& hinge);

/// Returns pin_end() or block_end(), by the hinge's kind.
HingeEnd hinge_end(const HingePrint& hinge, const CellSize& size, double axis_across, bool fork);

/// Returns the number of sides of a regular polygon with corners on a circle and sides off it by at most the
/// tolerance. It is a multiple of four, at least 12.
int circle_sides(double radius_mm, double tolerance_mm);

/// Returns the hinge that a process assumes if the design does not describe it. A pin has the thinnest rod and the
/// smallest clearance of the process. The kind rod is a steel wire of usual_rod_mm in a tighter bore. An
/// elastomer block is of the process's rubber, as thick as the wall. A living hinge has the thickness of one line, or
/// the least that the process cuts. It is of the process's film material, or a strip of polypropylene if the process has
/// none. All are as high as the wall. Hinges that span a gap have none yet (open_gap_mm).
ManufacturedHinge open_hinge(HingeKind kind, const Process& process, const CellSize& size);

/// Returns the gap of a block or film that withstands its turn and stretch, mm, rounded up to whole tenths.
/// At this gap neither the corners of its wall nor those of the block meet.
/// @param offset_mm of the axis from the middle of the wall   @param turn largest, rad
/// @param stretch_mm by which its halves separate or approach
double open_gap_mm(const ManufacturedHinge& hinge, double wall_mm, double offset_mm, double turn,
                   double stretch_mm = 0);

}  // namespace kinetix::model
