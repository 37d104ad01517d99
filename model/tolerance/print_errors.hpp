#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "model/tolerance/as_made.hpp"

namespace kinetix::model {

/// Generator of errors of one print after the other: one column per hinge with t (fraction), alpha, beta
/// (rad) and offset (cell edges). Normally distributed, by Box and Muller: the distributions of the standard
/// library differ between implementations.
class PrintErrors {
 public:
  PrintErrors(const HingeScatter& scatter, Eigen::Index hinges, unsigned seed)
      : sd_(scatter.by_hinge(hinges)), random_(seed) {}

  Eigen::Matrix4Xd next() {
    Eigen::Matrix4Xd errors(4, sd_.cols());
    for (double& entry : errors.reshaped()) entry = normal();
    return sd_.cwiseProduct(errors);
  }

 private:
  double even() {
    return (static_cast<double>(random_()) + 1) / (static_cast<double>(std::mt19937::max()) + 2);
  }
  double normal() {
    const double radius = std::sqrt(-2 * std::log(even()));
    return radius * std::cos(2 * std::numbers::pi * even());
  }

  const Eigen::Matrix4Xd sd_;
  std::mt19937 random_;
};

}  // namespace kinetix::model
