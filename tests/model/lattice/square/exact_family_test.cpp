#include <ceres/jet.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <limits>
#include <string>

#include "model/base/invalid_input.hpp"
#include "model/lattice/square/family/exact_derivatives.hpp"
#include "model/lattice/square/family/exact_family.hpp"
#include "tests/support/derivatives.hpp"
#include "tests/support/exact_derivatives.hpp"
#include "tests/support/random_designs.hpp"

namespace kinetix::model {
namespace {

using testing::random_design;
using testing::structure_of;

TEST(ReflectionChain, ClosesEveryLoopOfARandomSheet) {
  std::mt19937 random(7);
  for (const Family family : {Family::F1, Family::F2, Family::F3})
    for (const auto& [columns, rows] : {std::pair{1, 1}, {1, 9}, {17, 2}, {40, 1}, {100, 100}}) {
      const auto design = random_design(family, columns, rows, random);
      const Structure structure = structure_of(design);
      const HingeGaps gaps = hinge_gaps(structure, fold(design, structure));
      EXPECT_LE(gaps.max, 1e-12) << to_string(family) << " " << columns << "x" << rows;
      EXPECT_LE(gaps.axis_max, 1e-12) << to_string(family) << " " << columns << "x" << rows;
    }
}

TEST(ReflectionChain, RefusesNumbersThatNoSheetHas) {
  State poses;
  const auto refuses = [&](ExactDesign<double> design, double edge, const char* words) {
    try {
      fold(design, edge, poses);
      ADD_FAILURE() << words;
    } catch (const InvalidInput& e) {
      EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    }
  };
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const auto design = ExactDesign<double>::basic(3, 2);
  EXPECT_NO_THROW(fold(design, 10, poses));
  for (const double edge : {-10.0, 0.0, nan, infinity}) refuses(design, edge, "the cell edge is");
  for (const double theta : {99.0, -1.6, nan, infinity}) {
    auto turned = design;
    turned.theta = theta;
    refuses(turned, 10, "theta is");
  }
  for (const auto member : {&ExactDesign<double>::beta, &ExactDesign<double>::t, &ExactDesign<double>::s})
    for (const double odd : {nan, -infinity}) {
      auto changed = design;
      (changed.*member)[1] = odd;
      refuses(changed, 10, "not finite");
    }
  auto leaning = design;
  leaning.gamma = nan;
  refuses(leaning, 10, "gamma is");
  auto short_of = design;
  short_of.t.pop_back();
  refuses(short_of, 10, "must have one for each");
  for (const auto& [columns, rows] : {std::pair{-3, 1}, {1, 0}, {0, 0}, {-1, -1}}) {
    EXPECT_THROW(ExactDesign<double>::basic(columns, rows), InvalidInput);
    EXPECT_THROW(rectangle(columns, rows), InvalidInput);
  }
  EXPECT_THROW(rectangle(100'000, 100'000), InvalidInput);
}

TEST(ReflectionChain, StartsFlat) {
  std::mt19937 random(8);
  for (const Family family : {Family::F1, Family::F2, Family::F3}) {
    auto design = random_design(family, 5, 4, random);
    design.theta = 0;
    const Structure structure = structure_of(design);
    EXPECT_LE(aligned_distance(structure, fold(design, structure), rest_state(structure)).max, 1e-13);
  }
}

TEST(ReflectionChain, FoldsOneBendingColumnByTwicePsi) {
  auto design = ExactDesign<double>::basic(5, 1);
  design.beta[2] = std::atan(std::sqrt(2.0));
  design.theta = pi / 4;
  State poses;
  fold(design, 10.0, poses);
  const Eigen::Vector3d up_before = poses[0].R.col(2), up_after = poses[10].R.col(2);
  EXPECT_NEAR(std::acos(up_before.dot(up_after)), pi / 2, 1e-14);
}

TEST(ReflectionChain, JacobianMatchesCentralDifferences) {
  std::mt19937 random(9);
  for (const Family family : {Family::F1, Family::F2, Family::F3})
    for (const double theta : {0.0, 1e-9, 0.3, 0.76}) {
      auto design = random_design(family, 6, 3, random);
      design.theta = theta;
      design.beta[3] = 0;
      EXPECT_LE(testing::jacobian_mismatch(design, 10.0), 1e-7) << to_string(family) << " theta " << theta;
    }
}

TEST(ReflectionChain, JacobianMatchesDualNumbers) {
  constexpr int parameters = 2 * 4 + 2 + 2;
  using Jet = ceres::Jet<double, parameters>;
  std::mt19937 random(10);
  const auto design = random_design(Family::F3, 4, 2, random);
  const Eigen::VectorXd x = testing::pack(design);
  std::vector<Jet> dual(parameters);
  for (int k = 0; k < parameters; ++k) dual[k] = Jet(x[k], k);
  std::vector<PoseOf<Jet>> dual_poses;
  fold(testing::unpack<Jet>(dual, 4, 2), 10.0, dual_poses);

  State poses;
  ExactJacobian jacobian;
  fold_with_jacobian(design, 10.0, poses, jacobian);
  for (std::size_t b = 0; b < poses.size(); ++b)
    for (int k = 0; k < parameters; ++k) {
      const Twist& twist = jacobian.twist(k, static_cast<int>(b));
      for (int d = 0; d < 3; ++d) {
        EXPECT_NEAR(twist.v[d], dual_poses[b].p[d].v[k], 1e-11);
        const Eigen::Vector3d column_rate = twist.omega.cross(poses[b].R.col(d));
        for (int e = 0; e < 3; ++e) EXPECT_NEAR(column_rate[e], dual_poses[b].R(e, d).v[k], 1e-11);
      }
    }
}

/// Linear function of a state. It sums, over all bodies, place times a vector and orientation times a matrix, entry by
/// entry.
struct LinearInState {
  std::vector<Eigen::Vector3d> places;
  std::vector<Eigen::Matrix3d> turns;

  explicit LinearInState(int bodies) {
    for (int b = 0; b < bodies; ++b) {
      places.push_back(Eigen::Vector3d::Random());
      turns.push_back(10 * Eigen::Matrix3d::Random());
    }
  }

  double of(const State& poses) const {
    double sum = 0;
    for (std::size_t b = 0; b < poses.size(); ++b)
      sum += places[b].dot(poses[b].p) + turns[b].cwiseProduct(poses[b].R).sum();
    return sum;
  }

  Eigen::VectorXd by_state(const State& poses) const {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(6 * static_cast<Eigen::Index>(poses.size()));
    for (std::size_t b = 0; b < poses.size(); ++b) {
      for (int d = 0; d < 3; ++d) out.segment<3>(6 * b) += poses[b].R.col(d).cross(turns[b].col(d));
      out.segment<3>(6 * b + 3) = places[b];
    }
    return out;
  }
};

TEST(ReflectionChain, GradientMatchesCentralDifferences) {
  std::srand(11);
  std::mt19937 random(11);
  for (const Family family : {Family::F1, Family::F2, Family::F3})
    for (const double theta : {0.0, 1e-9, 0.3, 0.76})
      for (const auto& [columns, rows] : {std::pair{1, 1}, {6, 3}}) {
        auto design = random_design(family, columns, rows, random);
        design.theta = theta;
        const LinearInState function((columns + 1) * (rows + 1));
        State poses;
        fold(design, 10.0, poses);
        ExactDesign<double> gradient;
        fold_gradient(design, 10.0, poses, function.by_state(poses), gradient);
        const auto f = [&, c = columns, r = rows](const Eigen::VectorXd& x) {
          State there;
          fold(testing::unpack<double>(x, c, r), 10.0, there);
          return Eigen::VectorXd::Constant(1, function.of(there));
        };
        testing::expect_jacobian(f, testing::pack(design), testing::pack(gradient).transpose());
      }
}

TEST(ReflectionChain, GradientOfDesignsSideBySideHasTheSameBits) {
  std::mt19937 random(12);
  const ExactDesign<double> designs[] = {random_design(Family::F2, 7, 2, random),
                                         random_design(Family::F2, 7, 2, random)};
  auto both = ExactDesign<Lanes>::basic(7, 2);
  for (int lane = 0; lane < Lanes::count; ++lane) {
    const ExactDesign<double>& one = designs[lane];
    for (int c = 0; c < 7; ++c) both.beta[c].set(lane, one.beta[c]);
    for (int c = 0; c < 7; ++c) both.t[c].set(lane, one.t[c]);
    for (int r = 0; r < 2; ++r) both.s[r].set(lane, one.s[r]);
    both.gamma.set(lane, one.gamma);
    both.theta.set(lane, one.theta);
  }
  const Eigen::VectorXd by_state = Eigen::VectorXd::LinSpaced(6 * 8 * 3, -1, 2);
  std::vector<PoseOf<Lanes>> poses;
  ExactDesign<Lanes> gradient;
  fold(both, 10.0, poses);
  fold_gradient<Lanes>(both, 10.0, poses, by_state.cast<Lanes>(), gradient);
  for (int lane = 0; lane < Lanes::count; ++lane) {
    State alone;
    ExactDesign<double> of_one;
    fold(designs[lane], 10.0, alone);
    fold_gradient(designs[lane], 10.0, alone, by_state, of_one);
    ASSERT_GT(of_one.theta * of_one.theta, 0);
    EXPECT_EQ(gradient.theta[lane], of_one.theta);
    for (int c = 0; c < 7; ++c) EXPECT_EQ(gradient.beta[c][lane], of_one.beta[c]);
    for (int c = 0; c < 7; ++c) EXPECT_EQ(gradient.t[c][lane], of_one.t[c]);
    for (int r = 0; r < 2; ++r) EXPECT_EQ(gradient.s[r][lane], of_one.s[r]);
  }
}

}  // namespace
}  // namespace kinetix::model
