#include "model/soft_aperture.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace kinetix {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr int most_steps = 40;
constexpr double settled = 1e-12;
constexpr double longest_step = 0.1;

/// Distance from a wall to a point, with the foot on the wall and whether that is an end of it.
struct Distance {
  double value, at;
  Vector2d normal;

  Distance(const Opening::Side& side, const Vector2d& point) {
    const Vector2d along = side.knee - side.vertex, from = point - side.vertex;
    at = std::clamp(from.dot(along) / along.squaredNorm(), 0.0, 1.0);
    const Vector2d apart = from - at * along;
    value = apart.norm();
    normal = apart / std::max(value, 1e-12);
  }
  bool at_end() const { return at <= 0 || at >= 1; }
};

/// The soft minimum of the distances at a point, with gradient and Hessian by the point.
struct Clearance {
  double value = 0;
  Vector2d gradient = Vector2d::Zero();
  Matrix2d hessian = Matrix2d::Zero();
  std::array<double, 8> weights = {};

  Clearance(const Opening& opening, const Vector2d& point, double sharpness) {
    std::vector<Distance> distances;
    for (const Opening::Side& side : opening.sides) distances.emplace_back(side, point);
    double least = std::numeric_limits<double>::infinity(), sum = 0;
    for (const Distance& d : distances) least = std::min(least, d.value);
    for (std::size_t k = 0; k < weights.size(); ++k)
      sum += weights[k] = std::exp(-sharpness * (distances[k].value - least));
    value = least - std::log(sum) / sharpness;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      const Distance& d = distances[k];
      weights[k] /= sum;
      const Matrix2d across = d.normal * d.normal.transpose();
      gradient += weights[k] * d.normal;
      hessian -= sharpness * weights[k] * across;
      if (d.at_end()) hessian += weights[k] / d.value * (Matrix2d::Identity() - across);
    }
    hessian += sharpness * gradient * gradient.transpose();
  }
};

struct Pocket {
  Vector2d middle;
  Clearance clearance;
};

/// Uphill where the Hessian does not curve down, else Newton's step.
Vector2d step_from(const Clearance& c) {
  const bool curves_down = c.hessian.determinant() > 0 && c.hessian.trace() < 0;
  Vector2d step = c.gradient;
  if (curves_down) step = -c.hessian.inverse() * c.gradient;
  return step.norm() > longest_step ? Vector2d(step * longest_step / step.norm()) : step;
}

Pocket climb(const Opening& opening, const Vector2d& start, double sharpness) {
  Pocket pocket{start, Clearance(opening, start, sharpness)};
  for (int k = 0; k < most_steps && pocket.clearance.gradient.norm() > settled; ++k) {
    Vector2d step = step_from(pocket.clearance);
    Pocket next{pocket.middle + step, Clearance(opening, pocket.middle + step, sharpness)};
    while (!(next.clearance.value > pocket.clearance.value) && step.norm() > settled) {
      step /= 4;
      next = {pocket.middle + step, Clearance(opening, pocket.middle + step, sharpness)};
    }
    if (!(next.clearance.value > pocket.clearance.value)) break;
    pocket = next;
  }
  return pocket;
}

std::vector<Vector2d> starts(const Opening& opening) {
  Vector2d middle = Vector2d::Zero();
  for (int k = 0; k < 8; k += 2) middle += opening.sides[k].vertex / 4;
  std::vector<Vector2d> points = {middle};
  for (int k = 0; k < 8; k += 2)
    points.push_back(middle / 2 + (opening.sides[k].knee + opening.sides[k + 1].knee) / 4);
  return points;
}

std::optional<Pocket> widest_pocket(const Opening& opening, double sharpness) {
  std::optional<Pocket> widest;
  for (const Vector2d& start : starts(opening)) {
    if (!opening.contains(start)) continue;
    const Pocket pocket = climb(opening, start, sharpness);
    if (!opening.contains(pocket.middle)) continue;
    if (!widest || pocket.clearance.value > widest->clearance.value) widest = pocket;
  }
  return widest;
}

}  // namespace

CellReading soft_aperture(const Opening& opening, double sharpness) {
  CellReading reading;
  const std::optional<Pocket> pocket = widest_pocket(opening, sharpness);
  reading.value = pocket ? 2 * (pocket->clearance.value - opening.half_thickness) : NAN;
  for (std::size_t k = 0; pocket && k < opening.sides.size(); ++k) {
    const Opening::Side& side = opening.sides[k];
    const Distance d(side, pocket->middle);
    const double w = -2 * pocket->clearance.weights[k];
    const Vector2d arm = d.at * (side.knee - side.vertex), n = d.normal;
    reading.bodies.col(side.body) += w * Eigen::Vector3d(n.y() * arm.x() - n.x() * arm.y(), n.x(), n.y());
    if (d.at >= 1) reading.t[side.hinge] += w * side.sign * n.dot((side.knee - side.vertex).normalized());
  }
  return reading;
}

CellReading area_reading(const Opening& opening) {
  CellReading reading;
  reading.value = area(opening);
  const auto corner = [&](std::size_t k, bool knee) {
    const Opening::Side& side = opening.sides[k % 8];
    return knee ? side.knee : side.vertex;
  };
  const auto add_corner = [&](std::size_t k, bool knee, const Vector2d& before, const Vector2d& after) {
    const Opening::Side& side = opening.sides[k];
    const Vector2d by(0.5 * (after.y() - before.y()), 0.5 * (before.x() - after.x()));
    const Vector2d arm = corner(k, knee) - side.vertex;
    reading.bodies.col(side.body) += Eigen::Vector3d(by.y() * arm.x() - by.x() * arm.y(), by.x(), by.y());
    if (knee) reading.t[side.hinge] += side.sign * by.dot(arm.normalized());
  };
  for (std::size_t k = 0; k < 8; k += 2) {
    add_corner(k, false, corner(k + 7, true), corner(k, true));
    add_corner(k, true, corner(k, false), corner(k + 1, true));
    add_corner(k + 1, true, corner(k, true), corner(k + 2, false));
  }
  return reading;
}

}  // namespace kinetix
