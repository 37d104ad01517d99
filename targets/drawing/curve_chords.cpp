#include "targets/drawing/curve_chords.hpp"

#include <algorithm>
#include <cmath>

#include "model/base/geometry.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;

constexpr double chord_step = 5 * radians_per_degree;  // rad: chords leave a circle by 0.1 % of its radius
constexpr int chords_per_piece = 24;                   // of Bézier curves and of pieces of splines
constexpr double straightness = 1e-6;                  // of the chord: control points that near are on it

bool is_straight(const ChordPoints& control) {
  const Vector2d a = control.front(), along = control.back() - a;
  const double length = along.norm();
  return std::all_of(control.begin(), control.end(), [&](const Vector2d& p) {
    const double part = length > 0 ? (p - a).dot(along) / (length * length) : 0;
    return (p - a - std::clamp(part, 0.0, 1.0) * along).norm() <= straightness * length;
  });
}

/// Returns the point of a Bézier curve by de Casteljau's algorithm.
Vector2d bezier_point(ChordPoints control, double t) {
  for (std::size_t left = control.size() - 1; left > 0; --left)
    for (std::size_t k = 0; k < left; ++k) control[k] += t * (control[k + 1] - control[k]);
  return control[0];
}

}  // namespace

ChordPoints ellipse_chords(const Vector2d& middle, const Vector2d& major, const Vector2d& minor, double from,
                           double to) {
  constexpr double most = 1000;
  const int count = static_cast<int>(std::clamp(std::ceil(std::abs(to - from) / chord_step), 1.0, most));
  ChordPoints points;
  for (int k = 0; k <= count; ++k) {
    const double angle = from + (to - from) * k / count;
    points.push_back(middle + std::cos(angle) * major + std::sin(angle) * minor);
  }
  return points;
}

ChordPoints bezier_chords(const ChordPoints& control) {
  if (is_straight(control)) return {control.front(), control.back()};
  ChordPoints points;
  for (int k = 0; k <= chords_per_piece; ++k)
    points.push_back(bezier_point(control, static_cast<double>(k) / chords_per_piece));
  return points;
}

ChordPoints bulge_chords(const Vector2d& from, const Vector2d& to, double bulge) {
  const Vector2d half = (to - from) / 2;
  const Vector2d middle = from + half + (1 - bulge * bulge) / (2 * bulge) * Vector2d(-half.y(), half.x());
  const Vector2d arm = from - middle;
  ChordPoints points = ellipse_chords(middle, arm, {-arm.y(), arm.x()}, 0, 4 * std::atan(bulge));
  points.front() = from;
  points.back() = to;
  return points;
}

ChordPoints svg_arc_chords(const Vector2d& from, const Vector2d& to, Vector2d radii, double tilt,
                           bool is_large, bool is_clockwise) {
  radii = radii.cwiseAbs();
  if (from == to || !(radii.minCoeff() > 0)) return {from, to};
  Eigen::Matrix2d axes;
  axes << std::cos(tilt), -std::sin(tilt), std::sin(tilt), std::cos(tilt);
  const Vector2d half = axes.transpose() * (from - to) / 2;
  const double excess = half.cwiseQuotient(radii).norm();
  if (excess > 1) radii *= excess;
  const Vector2d unit = half.cwiseQuotient(radii);
  const double side =
      std::sqrt(std::max(0.0, 1 / unit.squaredNorm() - 1)) * (is_large == is_clockwise ? -1 : 1);
  const Vector2d centre = side * Vector2d(unit.y(), -unit.x());
  const Vector2d start = unit - centre, end = -unit - centre;
  const double first = std::atan2(start.y(), start.x());
  double turn = std::atan2(end.y(), end.x()) - first;
  if (is_clockwise && turn < 0) turn += 2 * pi;
  if (!is_clockwise && turn > 0) turn -= 2 * pi;
  const Vector2d middle = axes * centre.cwiseProduct(radii) + (from + to) / 2;
  ChordPoints points =
      ellipse_chords(middle, axes.col(0) * radii.x(), axes.col(1) * radii.y(), first, first + turn);
  points.front() = from;
  points.back() = to;
  return points;
}

ChordPoints spline_chords(int degree, const std::vector<double>& knots, const ChordPoints& control,
                          const std::vector<double>& weights) {
  if (weights.empty() && is_straight(control)) return {control.front(), control.back()};
  const auto at = [&](std::size_t span, double t) {
    std::vector<Eigen::Vector3d> d;
    for (std::size_t k = span - degree; k <= span; ++k) {
      const double w = weights.empty() ? 1 : weights[k];
      d.emplace_back(w * control[k].x(), w * control[k].y(), w);
    }
    for (int r = 1; r <= degree; ++r)
      for (int k = degree; k >= r; --k) {
        const double low = knots[span - degree + k], high = knots[span + 1 + k - r];
        const double part = high > low ? (t - low) / (high - low) : 0;
        d[k] = (1 - part) * d[k - 1] + part * d[k];
      }
    return Vector2d(d[degree].head<2>() / d[degree].z());
  };
  ChordPoints points;
  for (std::size_t span = degree; span < control.size(); ++span) {
    if (!(knots[span + 1] > knots[span])) continue;
    for (int k = points.empty() ? 0 : 1; k <= chords_per_piece; ++k)
      points.push_back(at(
          span, knots[span] + (knots[span + 1] - knots[span]) * k / static_cast<double>(chords_per_piece)));
  }
  return points;
}

}  // namespace kinetix::targets
