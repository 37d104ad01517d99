#include "targets/outline/orientation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "model/base/angle.hpp"

namespace kinetix::targets {
namespace {

using Complex = std::complex<double>;
using Eigen::Vector2d;

constexpr int most_folds =
    6;  // largest order of a rotational symmetry that still has a direction: a hexagon's sides.
// Least moment, as a fraction of the moment of |z|^n. Below it, turning leaves an outline as good as unchanged, as it
// does a disc of 24 points.
constexpr double vanishing = 1e-3;
constexpr double same_reach = 1e-9;  // fraction of the moment of |z|^3: rounding
constexpr double aside =
    0.3;  // rad: first points that lie between two directions of a shape seldom lie so far off

/// Moments of the area within an outline about its middle, mm^(n + 2).
struct AreaMoments {
  std::array<Complex, most_folds + 1> of_power = {};  ///< integral z^n dA
  std::array<double, most_folds + 1> of_size = {};    ///< integral |z|^n dA
  Complex lopsided = 0;                               ///< integral |z|^2 z dA
};

/// Integrates over triangles from the middle to each side: z = r s, s on the side, dA = |middle, a, b| r dr du.
AreaMoments moments_of(const Outline& outline) {
  // The rule is Gauss-Legendre with four points per side, exact to degree 7.
  const double inner = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(1.2)),
               outer = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(1.2));
  const double heavy = (18 + std::sqrt(30.0)) / 72, light = (18 - std::sqrt(30.0)) / 72;
  const std::pair<double, double> points[] = {
      {(1 - outer) / 2, light}, {(1 - inner) / 2, heavy}, {(1 + inner) / 2, heavy}, {(1 + outer) / 2, light}};
  AreaMoments out;
  const auto& corners = outline.points();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector2d a = corners[k] - outline.middle(),
                   b = corners[(k + 1) % corners.size()] - outline.middle();
    const double twice = a.x() * b.y() - a.y() * b.x();
    for (const auto& [u, weight] : points) {
      const Vector2d p = a + u * (b - a);
      const Complex z(p.x(), p.y());
      for (int n = 2; n <= most_folds; ++n) {
        out.of_power[n] += weight * twice / (n + 2) * std::pow(z, n);
        out.of_size[n] += weight * twice / (n + 2) * std::pow(std::abs(z), n);
      }
      out.lopsided += weight * twice / 5 * std::norm(z) * z;
    }
  }
  return out;
}

}  // namespace

std::optional<double> direction_of(const Outline& outline) {
  const AreaMoments moments = moments_of(outline);
  const Vector2d first = outline.points().front() - outline.middle();
  const Complex from_middle(first.x(), first.y());
  for (int n = 2; n <= most_folds; ++n) {
    if (!(std::abs(moments.of_power[n]) > vanishing * std::abs(moments.of_size[n]))) continue;
    double best = 0, most = -INFINITY, nearest = -INFINITY;
    for (int k = 0; k < n; ++k) {
      const double angle = (std::arg(moments.of_power[n]) + 2 * pi * k) / n;
      const double far = (moments.lopsided * std::polar(1.0, -angle)).real();
      const double near = (from_middle * std::polar(1.0, aside - angle)).real();
      const double same = same_reach * moments.of_size[3];
      if (far < most - same || (far <= most + same && near <= nearest)) continue;
      best = angle, most = far, nearest = near;
    }
    return std::remainder(best, 2 * pi);
  }
  return std::nullopt;
}

double smallest_diagonal(const Outline& outline) {
  const auto diagonal = [&](double angle) {
    const Eigen::Rotation2Dd turn(angle);
    Eigen::AlignedBox2d box;
    for (const Vector2d& p : outline.points()) box.extend(turn * p);
    return box.sizes().norm();
  };
  const std::optional<double> direction = direction_of(outline);
  if (!direction) return diagonal(0);
  // A quarter of a turn more gives the same boxes.
  return std::min(diagonal(-*direction), diagonal(pi / 4 - *direction));
}

Outline turned(const Outline& outline, double angle) {
  if (angle == 0) return outline;
  const Eigen::Rotation2Dd turn(angle);
  std::vector<Vector2d> points;
  for (const Vector2d& p : outline.points()) points.push_back(turn * p);
  return Outline(std::move(points));
}

}  // namespace kinetix::targets
