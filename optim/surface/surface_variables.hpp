#pragma once

#include <Eigen/Core>

#include "model/lattice/origami/march.hpp"

namespace kinetix::optim {

/// Variables of a search for a surface, in the order of its vector x.
/// - Logarithms of the magnitudes of the fold multipliers times sin(theta).
/// - Angles, rad.
/// - Lengths over `unit`.
/// - Half distance of the two layers of vertices over `unit`.
/// - Pose of the middle facet relative to the start (turn vector, rad, and shift over `unit`).
struct SurfaceVariables {
  int columns = 0, rows = 0;                           ///< of facets, >= 2
  double unit = 1;                                     ///< of lengths, mm
  std::vector<int> rising_sign, level_sign;            ///< of the multipliers
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< of the middle facet at the start
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();     ///< of its lower left corner at the start, mm

  int size() const;
  /// Returns the index of the half distance of the layers. The pose follows it.
  int layer() const { return size() - 7; }
};

/// Returns x of these data. @param layer half distance of the two layers of vertices, mm
Eigen::VectorXd variables_of(const SurfaceVariables& v, const model::MarchData& data, double layer);

/// Returns the march's data at x, lengths in mm, multipliers times sin(theta). @param x of size() entries
template <class T>
model::MarchDataOf<T> march_data(const SurfaceVariables& v, const T* x) {
  using std::exp;
  const int p = v.columns - 1, q = v.rows - 1;
  model::MarchDataOf<T> d;
  const auto logarithms = [&](std::vector<T>& to, const std::vector<int>& signs) {
    for (const int sign : signs) to.push_back(T(sign) * exp(*x++));
  };
  const auto angles = [&](std::vector<T>& to, int count) {
    for (int k = 0; k < count; ++k) to.push_back(*x++);
  };
  const auto lengths = [&](std::vector<T>& to, int count) {
    for (int k = 0; k < count; ++k) to.push_back(*x++ * T(v.unit));
  };
  logarithms(d.rising, v.rising_sign);
  logarithms(d.level, v.level_sign);
  angles(d.left_angle, q);
  d.bottom_angle.push_back(d.left_angle[0]);
  angles(d.bottom_angle, p - 1);
  lengths(d.bottom_length, p - 1);
  lengths(d.left_length, q - 1);
  for (auto* side : {&d.west, &d.east}) lengths(*side, q);
  for (auto* side : {&d.south, &d.north}) lengths(*side, p);
  for (auto& corner : d.corners)
    for (int k = 0; k < 2; ++k) corner[k] = *x++ * T(v.unit);
  return d;
}

}  // namespace kinetix::optim
