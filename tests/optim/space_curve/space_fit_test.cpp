#include "optim/space_curve/space_fit.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <iostream>
#include <numbers>

#include "model/base/invalid_input.hpp"
#include "optim/space_curve/fit_space_curve.hpp"
#include "tests/support/derivatives.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;

targets::SpaceGoal helix(double turns, double radius, double pitch,
                         const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity()) {
  std::vector<Vector3d> points;
  for (int k = 0; k <= 480; ++k) {
    const double a = 2 * std::numbers::pi * turns * k / 480;
    points.push_back(
        turn * Vector3d(radius * std::cos(a), radius * std::sin(a), pitch * a / (2 * std::numbers::pi)));
  }
  return targets::SpaceGoal(points);
}

TEST(SpaceFit, AHelixOfTwoTurnsIsFollowed) {
  for (const int columns : {48, 96, 192}) {
    const auto begin = std::chrono::steady_clock::now();
    SpaceVariables v;
    v.columns = columns;
    const SpaceDesign found = fit_space_curve(helix(2, 40, 40), v, {});
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    std::cout << columns << " rms " << found.error.rms << " max " << found.error.max << " theta "
              << to_degrees(found.design.theta) << " free " << found.walls_are_free << " s " << time.count()
              << " slope " << found.across.slope << " y " << found.across.direction.transpose() << " "
              << to_string(found.search.status) << found.error.settled << "\n";
    EXPECT_LE(found.error.rms, 2.4e-3 * 96 / columns);
  }
}

}  // namespace
}  // namespace kinetix::optim
