#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/base/decompositions.hpp"
#include "optim/space_curve/fit_space_curve.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;

constexpr int directions = 2000;     // on half a sphere: about 3 degrees apart
constexpr double first_step = 0.03;  // rad: about half their spacing
constexpr double last_step = 1e-7;   // rad: below the accuracy of slopes
constexpr double slow = 1e-3;        // of a step: one that lowers the slope by less moves along a ridge
constexpr int max_stretches = 400;   // of a goal; slopes vary little from one to the next

struct Stretches {
  std::vector<Vector3d> along;  ///< unit
  std::vector<double> arc_mm;
};

Stretches stretches_of(const targets::SpaceCurve& line, double stretch) {
  Stretches out;
  for (int k = 0; k < max_stretches; ++k) {
    const double s = line.length() * (k + 0.5) / max_stretches;
    out.along.push_back(line.direction(s, stretch / 2));
    out.arc_mm.push_back(s);
  }
  return out;
}

/// Returns the largest component of a stretch along y, the sine of its slope, and sets the index of that
/// stretch.
double steepest(const Stretches& all, const Vector3d& y, std::size_t& where) {
  double most = -1;
  for (std::size_t k = 0; k < all.along.size(); ++k)
    if (const double part = std::abs(all.along[k].dot(y)); part > most) {
      most = part;
      where = k;
    }
  return most;
}

/// Returns whether the largest component is below `least`, and then lowers `least` to it.
bool lowers(const Stretches& all, const Vector3d& y, double& least) {
  double most = -1;
  for (const Vector3d& along : all.along) {
    most = std::max(most, std::abs(along.dot(y)));
    if (!(most < least)) return false;
  }
  least = most;
  return true;
}

/// Returns point k, evenly spread over half a sphere (Fibonacci's spiral).
Vector3d spread(int k) {
  const double z = (k + 0.5) / directions, turn = k * std::numbers::pi * (3 - std::sqrt(5.0));
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

Vector3d first_direction(const Stretches& all) {
  Vector3d best = Vector3d::UnitY();
  double least = std::numeric_limits<double>::infinity();
  lowers(all, best, least);
  for (int k = 0; k < directions; ++k)
    if (const Vector3d y = spread(k); lowers(all, y, least)) best = y;
  return best;
}

/// Refines a direction by steps to eight sides, halved when none is much better.
Vector3d refined(const Stretches& all, Vector3d y) {
  double least = std::numeric_limits<double>::infinity();
  lowers(all, y, least);
  for (double step = first_step; step > last_step;) {
    const Vector3d u = y.unitOrthogonal(), v = y.cross(u);
    const double before = least;
    Vector3d better = y;
    for (int k = 0; k < 8; ++k) {
      const double turn = k * std::numbers::pi / 4;
      const Vector3d next = (y + step * (std::cos(turn) * u + std::sin(turn) * v)).normalized();
      if (lowers(all, next, least)) better = next;
    }
    if (!(before - least > slow * step)) step /= 2;
    y = better;
  }
  return y;
}

/// Returns a direction with its largest slope.
Across across_along(const Stretches& all, const Vector3d& direction) {
  Across out;
  out.direction = direction;
  std::size_t where = 0;
  const double part = steepest(all, direction, where);
  out.slope = part < 1 ? part / std::sqrt(1 - part * part) : std::numeric_limits<double>::infinity();
  out.arc_mm = all.arc_mm[where];
  return out;
}

}  // namespace

Across mean_slope(const targets::SpaceGoal& goal, double stretch) {
  const Stretches all = stretches_of(goal.line(), stretch);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Vector3d& along : all.along) sum += along * along.transpose();
  return across_along(all, principal_axes(sum).axes.col(0));
}

Across min_slope(const targets::SpaceGoal& goal, double stretch) {
  const Stretches all = stretches_of(goal.line(), stretch);
  return across_along(all, refined(all, first_direction(all)));
}

Eigen::Matrix3d frame_across(const targets::SpaceGoal& goal, const Vector3d& y) {
  const Vector3d chord = goal.points()[1] - goal.points()[0];
  const Vector3d seen = chord - chord.dot(y) * y;
  const Vector3d x = seen.norm() > 1e-9 * chord.norm() ? seen.normalized() : y.unitOrthogonal();
  Eigen::Matrix3d frame;
  frame << x, y, x.cross(y);
  return frame;
}

}  // namespace kinetix::optim
