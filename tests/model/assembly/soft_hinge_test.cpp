#include "model/assembly/soft_hinge.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <random>

#include "model/assembly/assembly.hpp"
#include "model/base/invalid_input.hpp"
#include "tests/support/strip_solids.hpp"

namespace kinetix::model {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using testing::box_solid;
using testing::moved;
using testing::strip_solid;

struct Case {
  std::string name;
  Polyhedron soft;
  double length;  // between its two flat ends, at m = +-length / 2
};

std::vector<double> steps(double from, double to, int count) {
  std::vector<double> out;
  for (int k = 0; k <= count; ++k) out.push_back(from + (to - from) * k / count);
  return out;
}

std::vector<Case> shapes() {
  const auto round = [](double m) { return std::sqrt(2.25 - m * m); };  // a cylinder of radius 1.5 about s
  const auto waist = [](double m) { return 0.3 + 0.4 * m * m; };
  const auto fillet = [](double m) {
    return std::abs(m) < 0.6 ? 0.4 : 0.4 + 1 - std::sqrt(1 - std::pow(std::abs(m) - 0.6, 2));
  };
  return {{"box", box_solid(-0.5, 0.5, 0.8, 6), 1},
          {"cylinder", strip_solid(steps(-1.2, 1.2, 24), round, 8), 2.4},
          {"hourglass", strip_solid(steps(-1, 1, 20), waist, 5), 2},
          {"fillets", strip_solid(steps(-1.2, 1.2, 24), fillet, 6), 2.4}};
}

/// Returns a soft part between two walls, all of it moved by `motion`.
std::vector<ModelPart> model_of(const Case& c, const Isometry3d& motion) {
  return {{"left", false, moved(box_solid(-c.length / 2 - 6, -c.length / 2, 3, 9), motion)},
          {"right", false, moved(box_solid(c.length / 2, c.length / 2 + 6, 3, 9), motion)},
          {"between", true, moved(c.soft, motion)}};
}

double degrees_between(const Vector3d& a, const Vector3d& b) {
  return to_degrees(std::atan2(a.cross(b).norm(), std::abs(a.dot(b))));
}

TEST(SoftHinge, HasItsAxisWithinADegreeOfBoxesCylindersHourglassesAndFilletsHoweverTheyLean) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-20, 20);
  for (const Case& c : shapes())
    for (const double tilt : {0.0, 15.0, 30.0, 45.0, 60.0}) {
      const Isometry3d motion = Eigen::Translation3d(any(random), any(random), any(random)) *
                                Eigen::AngleAxisd(0.1 * any(random), Vector3d::UnitZ()) *
                                Eigen::AngleAxisd(tilt * radians_per_degree, Vector3d(1, 1, 0).normalized());
      const Assembly found = make_assembly(model_of(c, motion));
      ASSERT_EQ(found.hinges.size(), 1u) << c.name;
      const AssemblyHinge& hinge = found.hinges[0];
      EXPECT_LT(degrees_between(hinge.axis, motion.linear() * Vector3d::UnitZ()), 0.001)
          << c.name << ", " << tilt;
      EXPECT_LT((hinge.point - motion.translation()).norm(), 1e-6) << c.name << ", " << tilt;
      EXPECT_GT(hinge.confidence, 0.6) << c.name;
      EXPECT_LT(degrees_between(hinge.along, motion.linear() * Vector3d::UnitX()), 0.001);
    }
}

TEST(SoftHinge, OfABoxResistsAsTheBlockOfItsSizes) {
  const Assembly found = make_assembly(model_of(shapes()[0], Isometry3d::Identity()));
  const HingeStiffness block = stiffness(ManufacturedHinge{.kind = HingeKind::block,
                                                           .material = *find_material("tango"),
                                                           .gap_mm = 1,
                                                           .thickness_mm = 0.8,
                                                           .height_mm = 6});
  const HingeStiffness& k = found.hinges[0].k;
  EXPECT_NEAR(k.turn, block.turn, 1e-9 * block.turn);
  EXPECT_NEAR(k.axial, block.axial, 1e-9 * block.axial);
  EXPECT_NEAR(k.shear, block.shear, 1e-9 * block.shear);
  EXPECT_NEAR(k.along, block.along, 1e-9 * block.along);
  EXPECT_NEAR(found.hinges[0].reach_mm, 6 / std::sqrt(12), 1e-9);
}

TEST(SoftHinge, OfAnHourglassYieldsAsItsWaistDoes) {
  // 1 / I integrated by Simpson's rule over the curve itself, not its polygon.
  const Case c = shapes()[2];
  double sum = 0;
  const int n = 2000;
  for (int k = 0; k <= n; ++k) {
    const double m = -1 + 2.0 * k / n, t = 2 * (0.3 + 0.4 * m * m);
    sum += (k == 0 || k == n ? 1 : k % 2 ? 4 : 2) * 12 / (5 * t * t * t) * (2.0 / n) / 3;
  }
  const Assembly found = make_assembly(model_of(c, Isometry3d::Identity()));
  const double t = std::cbrt(12 * 2 / (5 * sum));
  const double expected =
      stiffness(ManufacturedHinge{HingeKind::block, *find_material("tango"), 2, t, 5}).turn;
  EXPECT_NEAR(found.hinges[0].k.turn, expected, 0.01 * expected);
}

TEST(SoftHinge, OfACubeIsAmbiguousAndBothAxesAreTold) {
  const Case cube{"cube", box_solid(-1, 1, 2, 2), 2};
  const Isometry3d motion(Eigen::AngleAxisd(0.3, Vector3d::UnitX()));
  try {
    make_assembly(model_of(cube, motion));
    FAIL() << "a cube has no axis of its own";
  } catch (const InvalidInput& e) {
    const std::string said = e.what();
    EXPECT_NE(said.find("`between`"), std::string::npos) << said;
    EXPECT_NE(said.find("[0, -0.2955, 0.9553]"), std::string::npos) << said;
    EXPECT_NE(said.find("[0, 0.9553, 0.2955]"), std::string::npos) << said;
  }
  HingeChoices choices;
  choices.axes["between"] = motion * Vector3d::UnitZ();
  EXPECT_LT(degrees_between(make_assembly(model_of(cube, motion), choices).hinges[0].axis,
                            motion * Vector3d::UnitZ()),
            1e-6);
  choices.axes = {{"right/left", motion * Vector3d::UnitY()}};
  EXPECT_LT(degrees_between(make_assembly(model_of(cube, motion), choices).hinges[0].axis,
                            motion * Vector3d::UnitY()),
            1e-6);
  choices.axes.clear();
  choices.towards = Vector3d::UnitY();
  EXPECT_LT(degrees_between(make_assembly(model_of(cube, motion), choices).hinges[0].axis,
                            motion * Vector3d::UnitY()),
            1e-6);
}

TEST(CrossSection, OfATubeHasTheMomentsOfARing) {
  const Polyhedron tube = testing::tube(testing::ring(3, 720, true), testing::ring(2, 720, true), -1, 1);
  const CrossSection section = cross_section(tube, PlaneFrame::across(Vector3d::UnitZ()), 0.3);
  EXPECT_NEAR(section.area_mm2, pi * 5, 1e-3);
  EXPECT_NEAR(section.second(0, 0), pi / 4 * (81 - 16), 2e-2);
  EXPECT_NEAR(section.second(0, 1), 0, 1e-9);
  EXPECT_LT(section.edge_order, 1e-6);
}

}  // namespace
}  // namespace kinetix::model
