#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "optim/doe/sampling.hpp"

namespace kinetix::testing {

/// Functions whose Sobol indices are known in closed form, with them.
struct KnownFunction {
  std::vector<optim::Factor> factors;
  double (*value)(const std::vector<double>&);
  double mean, variance;
  std::vector<double> first, total;
};

/// Ishigami, Homma, 1990, with a = 7, b = 0.1: sin x0 + a sin^2 x1 + b x2^4 sin x0 on [-pi, pi]^3.
inline KnownFunction ishigami() {
  constexpr double pi = std::numbers::pi, a = 7, b = 0.1;
  const double of_0 = 0.5 * std::pow(1 + b * std::pow(pi, 4) / 5, 2), of_1 = a * a / 8;
  const double of_0_and_2 = 8 * b * b * std::pow(pi, 8) / 225, all = of_0 + of_1 + of_0_and_2;
  KnownFunction f;
  for (const char* name : {"x0", "x1", "x2"}) f.factors.push_back({name, optim::UniformRange{-pi, pi}});
  f.value = [](const std::vector<double>& x) {
    return std::sin(x[0]) + a * std::pow(std::sin(x[1]), 2) + b * std::pow(x[2], 4) * std::sin(x[0]);
  };
  f.mean = a / 2;
  f.variance = all;
  f.first = {of_0 / all, of_1 / all, 0};
  f.total = {(of_0 + of_0_and_2) / all, of_1 / all, of_0_and_2 / all};
  return f;
}

/// Dimensionless: a factor of weight 0 counts most, one of 99 hardly at all.
inline constexpr double g_weights[] = {0, 0.5, 3, 9, 99, 99};

/// Sobol's g-function (Saltelli, Sobol, 1995): product of (|4 x - 2| + a) / (1 + a) on the unit cube.
inline KnownFunction g_function() {
  KnownFunction f;
  f.value = [](const std::vector<double>& x) {
    double product = 1;
    for (std::size_t j = 0; j < x.size(); ++j)
      product *= (std::abs(4 * x[j] - 2) + g_weights[j]) / (1 + g_weights[j]);
    return product;
  };
  double all = 1;
  for (const double a : g_weights) all *= 1 + 1 / (3 * (1 + a) * (1 + a));
  f.mean = 1;
  f.variance = all - 1;
  for (const double a : g_weights) {
    const double alone = 1 / (3 * (1 + a) * (1 + a));
    f.factors.push_back({"x" + std::to_string(f.factors.size()), optim::UniformRange{0, 1}});
    f.first.push_back(alone / (all - 1));
    f.total.push_back(alone * all / (1 + alone) / (all - 1));
  }
  return f;
}

inline Eigen::MatrixXd table(const optim::SamplePlan& plan) {
  const auto rows = static_cast<Eigen::Index>(plan.size()),
             columns = static_cast<Eigen::Index>(plan.factors().size());
  Eigen::MatrixXd samples(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const std::vector<double> row = plan.sample(i);
    for (Eigen::Index j = 0; j < columns; ++j) samples(i, j) = row[j];
  }
  return samples;
}

template <class Function>
std::vector<double> responses(const optim::SamplePlan& plan, const Function& f) {
  std::vector<double> values;
  for (std::uint64_t i = 0; i < plan.size(); ++i) values.push_back(f(plan.sample(i)));
  return values;
}

}  // namespace kinetix::testing
