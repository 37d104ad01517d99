#include "model/elastic/contact/piece_contact.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <memory>
#include <random>

#include "model/assembly/assembly.hpp"
#include "model/base/geometry.hpp"
#include "model/closure/closure.hpp"
#include "model/elastic/elastic_system.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "tests/support/box_pieces.hpp"
#include "tests/support/derivatives.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::box_piece;

constexpr double contact_stiffness = 7;  // over k_point: not 1, so that a factor that is left out shows
constexpr double edge_mm = 10;           // mm: not 1, so that a unit that is left out shows

/// Returns two bodies with a block between them about z at the origin. The block is equally stiff in all directions of
/// pull.
Assembly two_arms() {
  Assembly a;
  a.edge_mm = edge_mm;
  a.bodies = {{.name = "base", .position = {-5, 0, 0}, .solid = {}},
              {.name = "arm", .position = {5, 0, 0}, .solid = {}}};
  a.hinges = {{.name = "joint", .lower = 0, .upper = 1, .reach_mm = 2}};
  a.hinges[0].k = {.axial = 800, .shear = 800, .along = 800, .turn = 30};
  return a;
}

Linkage free_pair() {
  Linkage out = linkage_of(two_arms());
  out.hinges.clear();
  return out;
}

/// A box of each of two bodies, the second pushed into the first by chance.
std::vector<std::pair<ConvexBodies, State>> pressed_boxes() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&](double size) -> Vector3d {
    return size * Vector3d(any(random), any(random), any(random));
  };
  std::vector<std::pair<ConvexBodies, State>> out;
  for (int k = 0; k < 30; ++k) {
    const Vector3d half(3, 4, 5);
    const ConvexBodies bodies{{box_piece(0, vector(1), half), box_piece(1, vector(1), half)}, {}};
    State state(2);
    for (Pose& pose : state) pose = {rotation_of(vector(2)), vector(2.5)};
    out.emplace_back(bodies, state);
  }
  return out;
}

/// @param every nth contact is checked
void expect_piece_differences(int every) {
  const Linkage pair = free_pair();
  int count = 0;
  for (const auto& [bodies, state] : pressed_boxes()) {
    PieceContact contact(bodies, edge_mm);
    for (const PieceTouch& touch : contact.find(state)) {
      if (++count % every != 0) continue;
      const auto moved_by = [&](const VectorXd& x) {
        VectorXd twists(12);
        twists.segment<6>(6 * contact.body(touch.piece)) = x.head<6>();
        twists.segment<6>(6 * contact.body(touch.other)) = x.tail<6>();
        return retract_straight(pair, state, twists);
      };
      const auto energy = [&](const VectorXd& x) {
        return VectorXd::Constant(1, contact.element(touch, contact_stiffness, moved_by(x)).energy);
      };
      const Element e = contact.element(touch, contact_stiffness, state);
      EXPECT_NEAR(e.energy, contact.energy({touch}, contact_stiffness), 1e-12);
      const VectorXd zero = VectorXd::Zero(12);
      testing::expect_jacobian(energy, zero, e.gradient.transpose());
      testing::expect_jacobian(
          [&](const VectorXd& x) -> VectorXd { return testing::numeric_jacobian(energy, x).transpose(); },
          zero, e.hessian, 1e-6, 1e-2);
    }
  }
  EXPECT_GT(count, 200);
}

TEST(PieceContact, GradientAndHessianMatchCentralDifferences) { expect_piece_differences(15); }

TEST(PieceContactSoak, GradientAndHessianMatchCentralDifferences) { expect_piece_differences(7); }

TEST(PieceContact, IsThatOfTheWholeSystemsEnergy) {
  const Linkage linkage = linkage_of(two_arms());
  Elasticity elasticity;
  for (const auto& [bodies, state] : pressed_boxes()) {
    const ElasticSystem system(linkage, elasticity, LinkageDrive(), false, true,
                               std::make_shared<const ConvexBodies>(bodies));
    if (system.touching(state) == 0) continue;
    const auto energy = [&](const VectorXd& x) {
      return VectorXd::Constant(1, system.elastic_energy(retract_straight(linkage, state, x)));
    };
    testing::expect_jacobian(energy, VectorXd::Zero(12), system.elastic_gradient(state).transpose(), 1e-5,
                             1e-6);
  }
}

TEST(PieceContact, KeepsFacesInsideABodyFromPushing) {
  // One box of two halves, cut at x = 0, and a probe whose corner is 0.1 mm below its top and 0.05 mm beside the cut.
  const ConvexBodies bodies{{box_piece(0, {-2, 0, 0}, {2, 4, 4}), box_piece(0, {2, 0, 0}, {2, 4, 4}),
                             box_piece(1, {0, 0, 0}, {1, 1, 1})},
                            {}};
  PieceContact contact(bodies, edge_mm);
  State state(2);
  state[1].p = Vector3d(1.05, 4.9, 0);
  const auto& touches = contact.find(state);
  ASSERT_FALSE(touches.empty());
  for (const PieceTouch& touch : touches) EXPECT_NEAR(touch.depth, 0.01, 1e-12);
}

TEST(PieceContact, LetsPairsPassThatItIsTold) {
  ConvexBodies bodies{{box_piece(0, {0, 0, 0}, {2, 2, 2}), box_piece(1, {0, 0, 0}, {2, 2, 2})}, {}};
  State state(2);
  state[1].p = Vector3d(1, 0.3, 0.2);
  EXPECT_FALSE(PieceContact(bodies, edge_mm).find(state).empty());
  bodies.passing = {{0, 1}};
  EXPECT_TRUE(PieceContact(bodies, edge_mm).find(state).empty());
}

TEST(PieceContact, SeesWhatWentThroughAThinPlate) {
  const ConvexBodies bodies{{box_piece(0, {0, 0, 0}, {20, 0.5, 20}), box_piece(1, {0, 0, 0}, {1, 1, 1})}, {}};
  PieceContact contact(bodies, edge_mm);
  State above(2), below(2), beside(2);
  above[1].p = Vector3d(0, 3, 0);
  below[1].p = Vector3d(0, -3, 0);
  beside[1].p = Vector3d(3, 3, 0);
  EXPECT_TRUE(contact.passed_through(above, below));
  EXPECT_FALSE(contact.passed_through(above, beside));
  EXPECT_FALSE(contact.passed_through(above, above));
}

TEST(PieceContact, OfSeveralPiecesSeesThroughWhichOneABodyWent) {
  // Two thin plates, 20 mm apart, and a probe that starts between them.
  const ConvexBodies bodies{{box_piece(0, {0, -10, 0}, {20, 0.5, 20}),
                             box_piece(0, {0, 10, 0}, {20, 0.5, 20}), box_piece(1, {0, 0, 0}, {1, 1, 1})},
                            {}};
  PieceContact contact(bodies, edge_mm);
  const auto probe_at = [](double y) {
    State state(2);
    state[1].p = Vector3d(0, y, 0);
    return state;
  };
  EXPECT_TRUE(contact.passed_through(probe_at(6), probe_at(14)));
  EXPECT_TRUE(contact.passed_through(probe_at(-6), probe_at(-14)));
  EXPECT_FALSE(contact.passed_through(probe_at(6), probe_at(-6)));
}

TEST(PieceSurface, LiesInTheSmallestBallAboutTheMiddleOfItsBox) {
  const Vector3d middle(12, -7, 3), half(3, 4, 5);
  const PieceSurface box = piece_surfaces({{box_piece(0, middle, half)}, {}}, edge_mm).front();
  EXPECT_LE((box.center - middle / edge_mm).norm(), 1e-12);
  EXPECT_NEAR(box.radius, half.norm() / edge_mm, 1e-12);
}

/// An arm of 0.8 x 6 mm turns about a block until the upper edge of its end, 9.5 mm from the axis, presses on a flat
/// stop at y = 4. The hinge yields by u along y. With c for the edge's stiffness:
///
///     K u + c (h + u) = 0,  h = 9.5 sin phi + 0.4 cos phi - 4,  M = k_turn phi + c (h + u) h'
///
/// The moment at the drive is k_turn phi + h h' / (1 / K + 1 / c).
TEST(PieceContact, PressesABlockHingeOnAStopAsTheMomentBalanceSays) {
  const Assembly assembly = two_arms();
  const Linkage linkage = linkage_of(assembly);
  const HingeStiffness& k = assembly.hinges[0].k;
  Elasticity elasticity;
  elasticity.each = {elasticity_of(k, assembly.hinges[0].reach_mm)};
  elasticity.k_point = elasticity.each[0].k_point;
  elasticity.k_contact = 50 * elasticity.k_point;
  const ConvexBodies bodies{{box_piece(0, {14.1, 5, 0}, {5, 1, 5}), box_piece(1, {0, 0, 0}, {4.5, 0.4, 3})},
                            {}};
  EquilibriumPathOptions options;
  options.planar = false;
  options.bodies = std::make_shared<const ConvexBodies>(bodies);
  for (const double degrees : {15.0, 23.0, 24.0, 25.0}) {
    const double phi = degrees * radians_per_degree;
    const EquilibriumPath path =
        trace_equilibrium({linkage, turned_hinge(0, linkage.bodies[0].sense, phi), {}}, elasticity, options);
    ASSERT_EQ(path.stop, EquilibriumPath::Stop::reached) << path.why;
    const double h = std::max(0.0, 9.5 * std::sin(phi) + 0.4 * std::cos(phi) - 4),
                 arm = 9.5 * std::cos(phi) - 0.4 * std::sin(phi),
                 c = 3 * elasticity.k_contact;  // two corners, and as much as one of all points between them
    const double moment = k.turn * phi + h * arm / (1 / k.axial + 1 / c);
    EXPECT_NEAR(path.steps.back().load, moment, 1e-7 * moment) << degrees;
    EXPECT_EQ(path.steps.back().contacts > 0, h > 0);
  }
}

}  // namespace
}  // namespace kinetix::model
