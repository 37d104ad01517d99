#include "optim/surface/surface_variables.hpp"

#include <cmath>

namespace kinetix::optim {

int SurfaceVariables::size() const {
  const int p = columns - 1, q = rows - 1;
  return p + q + q + (p - 1) + (p - 1) + (q - 1) + 2 * q + 2 * p + 8 + 7;
}

Eigen::VectorXd variables_of(const SurfaceVariables& v, const model::MarchData& d, double layer) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(v.size());
  int at = 0;
  for (const auto* multipliers : {&d.rising, &d.level})
    for (const double c : *multipliers) x[at++] = std::log(std::abs(c));
  for (const double angle : d.left_angle) x[at++] = angle;
  for (std::size_t i = 1; i < d.bottom_angle.size(); ++i) x[at++] = d.bottom_angle[i];
  for (const auto* lengths : {&d.bottom_length, &d.left_length, &d.west, &d.east, &d.south, &d.north})
    for (const double length : *lengths) x[at++] = length / v.unit;
  for (const auto& corner : d.corners)
    for (int k = 0; k < 2; ++k) x[at++] = corner[k] / v.unit;
  x[at] = layer / v.unit;
  return x;
}

}  // namespace kinetix::optim
