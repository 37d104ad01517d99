#include <gtest/gtest.h>
#include <cmath>
#include <memory>

#include "model/assembly/assembly.hpp"
#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"
#include "model/elastic/path/equilibrium_path.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "sim/physics_options.hpp"
#include "sim/physics_run.hpp"
#include "sim/shapes/convex_cuts.hpp"
#include "tests/support/box_pieces.hpp"
#include "tests/support/strip_solids.hpp"

namespace kinetix::sim {
namespace {

using testing::box_solid;
using testing::ring;
using testing::tube;

/// Two walls of 0.8 x 6 mm with a block of 1 mm between them.
model::Assembly pair_of_walls() {
  return model::make_assembly({{"left", false, box_solid(-9, -0.5, 0.8, 6)},
                               {"right", false, box_solid(0.5, 9, 0.8, 6)},
                               {"soft", true, box_solid(-0.5, 0.5, 0.8, 6)}});
}

ContactParts pieces_of(const model::Assembly& assembly) {
  ContactParts parts;
  for (const model::AssemblyBody& body : assembly.bodies) {
    auto& pieces = parts.of_body.emplace_back();
    for (const CutPiece& piece : convex_cuts(body.solid)) {
      pieces.push_back(piece.corners);
      for (Eigen::Vector3d& corner : pieces.back()) corner -= body.position;
    }
  }
  return parts;
}

PhysicsResult turned(const model::Assembly& assembly, double degrees) {
  const model::Linkage linkage = linkage_of(assembly);
  PhysicsOptions options;
  options.step_s = 4e-3;
  const model::LinkageDrive drive =
      model::turned_hinge(0, linkage.bodies[0].sense, degrees * radians_per_degree);
  return run_with_parts(linkage, drive, options, pieces_of(assembly));
}

TEST(ContactParts, StopWallsWhereTheirCornersMeet) {
  // tan(phi / 2) = L / t: 102.7 degrees.
  const model::Assembly assembly = pair_of_walls();
  EXPECT_EQ(turned(assembly, 95).status, PhysicsResult::Status::settled) << turned(assembly, 95).why;
  const PhysicsResult blocked = turned(assembly, 112);
  EXPECT_EQ(blocked.status, PhysicsResult::Status::blocked) << blocked.why;
  EXPECT_EQ(blocked.contact.first + blocked.contact.second, 1);
}

TEST(ContactParts, LetARodTurnInItsBore) {
  const model::Assembly assembly =
      model::make_assembly({{"rod", false, tube(ring(1.5, 24, true), {}, -4, 4)},
                            {"eye", false, tube(ring(3, 24, true), ring(1.55, 24, false), -1, 2)}});
  const PhysicsResult result = turned(assembly, 150);
  EXPECT_EQ(result.status, PhysicsResult::Status::settled) << result.why;
}

TEST(ContactParts, AreForRotaryHinges) {
  const model::Assembly assembly = pair_of_walls();
  PhysicsOptions options;
  options.elastic = model::Stiffness{};
  EXPECT_THROW(
      run_with_parts(linkage_of(assembly), model::turned_hinge(0, 1, 0.5), options, pieces_of(assembly)),
      InvalidInput);
}

/// Three arms of 0.8 x 6 mm in a row with blocks between them at x = 0 and x = 10, and a stop of the first one over the last.
struct ArmsAndStop {
  model::Assembly assembly;
  model::ConvexBodies bodies;

  ArmsAndStop() {
    assembly.edge_mm = 10;
    assembly.bodies = {{.name = "base", .position = {-5, 0, 0}, .solid = {}},
                       {.name = "arm", .position = {5, 0, 0}, .solid = {}},
                       {.name = "last", .position = {15, 0, 0}, .solid = {}}};
    assembly.hinges = {{.name = "first", .lower = 0, .upper = 1, .reach_mm = 2},
                       {.name = "second", .lower = 1, .upper = 2, .point = {10, 0, 0}, .reach_mm = 2}};
    for (model::AssemblyHinge& h : assembly.hinges)
      h.k = {.axial = 2000, .shear = 2000, .along = 2000, .turn = 5};
    for (int b = 0; b < 3; ++b) bodies.pieces.push_back(testing::box_piece(b, {0, 0, 0}, {4.5, 0.4, 3}));
    bodies.pieces.insert(bodies.pieces.begin() + 1, testing::box_piece(0, {20, 5, 0}, {3, 1, 5}));
  }

  ContactParts parts() const {
    ContactParts out;
    out.of_body.resize(3);
    for (const model::ContactPiece& piece : bodies.pieces) out.of_body[piece.body].push_back(piece.corners);
    return out;
  }
};

/// Returns the state in which the corner of the stop at x = 12, y = 4 touches the upper side of the last arm. That is
/// half the arm's thickness, 0.4 mm, off its middle line.
model::State pressed_state(double phi) {
  const Eigen::Vector3d hinge(10 * std::cos(phi), 10 * std::sin(phi), 0);
  const Eigen::Vector3d to_corner = Eigen::Vector3d(12, 4, 0) - hinge;
  const double last = std::atan2(to_corner.y(), to_corner.x()) - std::asin(0.4 / to_corner.norm());
  const auto turned = [](double angle) { return rotation_of(angle * Eigen::Vector3d::UnitZ()); };
  return {{Eigen::Matrix3d::Identity(), {-5, 0, 0}},
          {turned(phi), turned(phi) * Eigen::Vector3d(5, 0, 0)},
          {turned(last), hinge + turned(last) * Eigen::Vector3d(5, 0, 0)}};
}

TEST(ContactParts, PressArmsOfBlocksOnAStopInEquilibrium) {
  const ArmsAndStop arms;
  const model::Linkage linkage = linkage_of(arms.assembly);
  const double phi = 30 * radians_per_degree;
  const model::LinkageDrive drive = model::turned_hinge(0, linkage.bodies[0].sense, phi);

  model::Elasticity elasticity;
  for (const model::AssemblyHinge& h : arms.assembly.hinges)
    elasticity.each.push_back(model::elasticity_of(h.k, h.reach_mm));
  elasticity.k_point = elasticity.each[0].k_point;
  elasticity.k_contact = 10 * elasticity.k_point;
  model::EquilibriumPathOptions options;
  options.planar = false;
  options.bodies = std::make_shared<const model::ConvexBodies>(arms.bodies);
  const model::EquilibriumPath path = trace_equilibrium({linkage, drive, {}}, elasticity, options);
  ASSERT_EQ(path.stop, model::EquilibriumPath::Stop::reached) << path.why;
  EXPECT_GT(path.steps.back().contacts, 0);
  ASSERT_FALSE(path.events.empty());
  EXPECT_EQ(path.events.front().what, "bodies `base` and `last` touch");
  EXPECT_LT(aligned_distance(linkage, path.state, pressed_state(phi)).max, 5e-3);
}

TEST(ContactParts, NameThePiecesThatTouchAtRest) {
  ArmsAndStop arms;
  const model::Linkage linkage = linkage_of(arms.assembly);
  EXPECT_TRUE(touching_pieces(linkage, arms.parts()).empty());
  // The stop let down on the last arm: 0.02 mm between them.
  ContactParts parts = arms.parts();
  for (Eigen::Vector3d& corner : parts.of_body[0][1]) corner.y() -= 3.58;
  const std::vector<TouchingPieces> touching = touching_pieces(linkage, parts);
  ASSERT_EQ(touching.size(), 1u);
  EXPECT_EQ(touching[0], (TouchingPieces{0, 1, 2, 0}));
}

}  // namespace
}  // namespace kinetix::sim
