#pragma once

#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "model/base/invalid_input.hpp"
#include "model/lattice/square/family/exact_family.hpp"
#include "targets/curve/curve.hpp"

namespace kinetix::testing {

/// Polyline of count points along f(0..1).
template <class Function>
targets::Curve sampled(const Function& f, int count) {
  std::vector<Eigen::Vector2d> points;
  for (int k = 0; k < count; ++k) points.push_back(f(static_cast<double>(k) / (count - 1)));
  return targets::Curve(points);
}

inline targets::Curve half_circle(double radius = 100, int count = 481) {
  return sampled(
      [&](double f) { return Eigen::Vector2d(-radius * std::cos(pi * f), radius * std::sin(pi * f)); },
      count);
}

inline targets::Curve s_curve(int count = 481) {
  return sampled([](double f) { return Eigen::Vector2d(240 * f, 40 * std::sin(2 * pi * f)); }, count);
}

/// Cell edge that gives a straight strip at theta = 30 deg the curve's length.
inline double fitting_cell(const targets::Curve& curve, int columns) {
  return curve.length() / (columns * std::cos(pi / 6));
}

/// Returns the folded midline of a strip with random tilts up to 40 deg at a random theta in 10..40 deg. A design
/// reaches this curve exactly. Empty if the midline crosses itself.
inline std::optional<targets::Curve> reachable_curve(int columns, double cell_mm, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  auto design = model::ExactDesign<double>::basic(columns, 1);
  design.s.clear();  // a chain without rows
  for (double& beta : design.beta) beta = 40 * radians_per_degree * unit(random);
  design.theta = (25 + 15 * unit(random)) * radians_per_degree;
  model::State poses;
  fold_unchecked(design, cell_mm, poses);
  std::vector<Eigen::Vector2d> points;
  for (const model::Pose& pose : poses) points.emplace_back(pose.p.x(), pose.p.z());
  try {
    return targets::Curve(points);
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
}

}  // namespace kinetix::testing
