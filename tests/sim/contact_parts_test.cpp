#include "sim/contact_parts.hpp"

#include <gtest/gtest.h>

#include "model/assembly/assembly.hpp"
#include "model/base/angle.hpp"
#include "model/base/invalid_input.hpp"
#include "model/linkage/make_drive.hpp"
#include "sim/shapes/convex_cuts.hpp"
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

}  // namespace
}  // namespace kinetix::sim
