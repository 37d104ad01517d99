#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinetix::targets {

/// Points of a line or curve in order, from its start to its end.
using ChordPoints = std::vector<Eigen::Vector2d>;

/// Returns points of an ellipse from one parameter to another, at most 5 degrees apart.
/// @param major, minor half axes as vectors   @param from, to rad
ChordPoints ellipse_chords(const Eigen::Vector2d& middle, const Eigen::Vector2d& major,
                           const Eigen::Vector2d& minor, double from, double to);

/// Returns points of a Bézier curve of any degree: its two ends alone if the curve is straight.
/// @param control control points, at least two
ChordPoints bezier_chords(const ChordPoints& control);

/// Returns points of an arc in a polyline of DXF. @param bulge tangent of a quarter of its angle; positive if it turns
/// counter-clockwise
ChordPoints bulge_chords(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double bulge);

/// Returns points of an elliptical arc of an SVG path. The rules are those of
/// https://www.w3.org/TR/SVG11/implnote.html#ArcImplementationNotes.
/// @param radii of the ellipse   @param tilt rad, of its first axis
ChordPoints svg_arc_chords(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Eigen::Vector2d radii,
                           double tilt, bool is_large, bool is_clockwise);

/// Returns points of a B-spline, weighted or not. @param knots as many as control points plus degree plus 1, in order
/// @param weights of the control points, or empty
ChordPoints spline_chords(int degree, const std::vector<double>& knots, const ChordPoints& control,
                          const std::vector<double>& weights);

}  // namespace kinetix::targets
