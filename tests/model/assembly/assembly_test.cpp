#include "model/assembly/assembly.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/assembly/shells.hpp"
#include "model/base/invalid_input.hpp"
#include "tests/support/strip_solids.hpp"

namespace kinetix::model {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using testing::box_solid;
using ::testing::HasSubstr;
using testing::moved;
using testing::ring;
using testing::strip_solid;
using testing::tube;

ModelPart part(const std::string& name, bool soft, Polyhedron solid, const Vector3d& at = Vector3d::Zero()) {
  return {name, soft, moved(std::move(solid), Isometry3d(Eigen::Translation3d(at)))};
}

/// Two walls and a block between them.
std::vector<ModelPart> pair() {
  return {part("left", false, box_solid(-5, -0.5, 0.8, 6)), part("right", false, box_solid(0.5, 5, 0.8, 6)),
          part("soft", true, box_solid(-0.5, 0.5, 0.8, 6))};
}

std::string refusal(const std::vector<ModelPart>& parts) {
  try {
    make_assembly(parts);
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return "taken";
}

TEST(Assembly, RefusesShellsThatAreNoSolids) {
  auto parts = pair();
  parts[0].solid.triangles.pop_back();
  EXPECT_THAT(refusal(parts), HasSubstr("hard part `left` is open"));
  parts = pair();
  for (auto& t : parts[1].solid.triangles) std::swap(t[0], t[1]);
  EXPECT_THAT(refusal(parts), HasSubstr("hard part `right` is inside out"));
  parts = pair();
  parts[2].solid = {};
  EXPECT_THAT(refusal(parts), HasSubstr("soft part `soft` is empty"));
  parts = pair();
  parts[0].solid.points[2].x() = std::nan("");
  EXPECT_THAT(refusal(parts), HasSubstr("`left` has a coordinate that is not a finite number"));
  parts = pair();  // one corner on the way pushed out through the opposite face
  parts[0].solid = strip_solid(
      {-9, -7, -5, -3, -0.5}, [](double) { return 0.4; }, 6);
  parts[0].solid.points[8].y() = 2;
  EXPECT_THAT(refusal(parts), HasSubstr("`left` crosses itself"));
}

TEST(Assembly, RefusesHardPartsThatOverlap) {
  auto parts = pair();
  parts.push_back(part("third", false, box_solid(-7, -4, 0.6, 4), {0, 0.3, 0.5}));
  EXPECT_THAT(refusal(parts), HasSubstr("hard parts `left` and `third` overlap at"));
  parts.back() = part("inner", false, box_solid(1, 2, 0.2, 1));
  EXPECT_THAT(refusal(parts), HasSubstr("hard parts `right` and `inner` lie one inside the other"));
}

TEST(Assembly, RefusesSoftPartsThatJoinNoOneOrThree) {
  auto parts = pair();
  parts[2].solid = moved(parts[2].solid, Isometry3d(Eigen::Translation3d(0, 5, 0)));
  EXPECT_THAT(refusal(parts), HasSubstr("soft part `soft` touches no hard parts"));
  parts = pair();
  parts[1].solid = moved(parts[1].solid, Isometry3d(Eigen::Translation3d(0.2, 0, 0)));
  EXPECT_THAT(refusal(parts), HasSubstr("soft part `soft` touches 1 hard part: `left`"));
  parts = pair();
  parts.push_back(part("cap", false, box_solid(-0.4, 0.4, 0.8, 1), {0, 0, 3.5}));
  EXPECT_THAT(refusal(parts), HasSubstr("soft part `soft` touches 3 hard parts: `left`, `right`, `cap`"));
}

TEST(Assembly, RefusesABodyThatHangsOnNothing) {
  auto parts = pair();
  parts.push_back(part("far", false, box_solid(20, 22, 1, 1)));
  EXPECT_THAT(refusal(parts), HasSubstr("hard part `far` hangs on no chain of hinges with `left`"));
}

TEST(Assembly, FindsARodInABoreHoweverTheyLie) {
  for (const double lean : {0.0, 0.4, 1.3}) {
    const Isometry3d motion =
        Eigen::Translation3d(3, -2, 7) * Eigen::AngleAxisd(lean, Vector3d(2, 1, 0).normalized());
    const std::vector<ModelPart> parts = {
        {"rod", false, moved(tube(ring(1.5, 24, true), {}, -4, 4), motion)},
        {"eye", false, moved(tube(ring(3, 24, true), ring(1.8, 24, false), -1, 2), motion)}};
    const Assembly found = make_assembly(parts);
    ASSERT_EQ(found.hinges.size(), 1u);
    const AssemblyHinge& hinge = found.hinges[0];
    EXPECT_EQ(hinge.kind, HingeKind::pin);
    EXPECT_NEAR(hinge.clearance_mm, 0.3, 1e-9);
    EXPECT_LT(hinge.axis.cross(motion.linear() * Vector3d::UnitZ()).norm(), 1e-9);
    EXPECT_LT((hinge.point - motion * Vector3d(0, 0, 0.5)).norm(), 1e-9);
  }
}

TEST(Assembly, TakesTwoBearingsOnOneAxisForOnePin) {
  Polyhedron eyes = tube(ring(3, 24, true), ring(1.8, 24, false), -7, -4);
  append(tube(ring(3, 24, true), ring(1.8, 24, false), 3, 7), eyes);
  const Assembly found =
      make_assembly({{"rod", false, tube(ring(1.5, 24, true), {}, -8, 8)}, {"eyes", false, eyes}});
  ASSERT_EQ(found.hinges.size(), 1u);
  EXPECT_NEAR(found.hinges[0].point.z(), 0, 1e-9) << "the middle of the outermost ends";
  const ManufacturedHinge whole{
      .kind = HingeKind::pin, .height_mm = 14, .diameter_mm = 3, .clearance_mm = 0.3};
  EXPECT_NEAR(found.hinges[0].reach_mm, reach_mm(whole), 1e-6);
}

TEST(Assembly, SaysThatAShortSoftPartIsHeldAtBothEnds) {
  const auto with_gap = [](double gap) {
    return std::vector{part("left", false, box_solid(-5, -gap / 2, 0.8, 6)),
                       part("right", false, box_solid(gap / 2, 5, 0.8, 6)),
                       part("soft", true, box_solid(-gap / 2, gap / 2, 0.8, 6))};
  };
  const Material rubber{.E_mpa = 3, .nu = 0.48}, held{.E_mpa = 3 / (1 - 0.48 * 0.48), .nu = 0};
  const Assembly found = make_assembly(with_gap(0.3), {.material = rubber}),
                 same = make_assembly(with_gap(0.3), {.material = held});
  EXPECT_THAT(found.notes, ::testing::Contains(HasSubstr("hinge `soft` is shorter than half its thickness")));
  EXPECT_NEAR(found.hinges[0].k.turn / same.hinges[0].k.turn, 1, 1e-12);
  EXPECT_THAT(make_assembly(with_gap(1), {.material = rubber}).notes, ::testing::IsEmpty());
}

TEST(Assembly, RefusesOneBodyAlone) {
  EXPECT_THAT(refusal({part("left", false, box_solid(-5, -0.5, 0.8, 6))}), HasSubstr("has 1 hard parts"));
}

TEST(Assembly, TakesNoRodThatIsLooseForABearing) {
  const std::vector<ModelPart> parts = {{"rod", false, tube(ring(1, 24, true), {}, -4, 4)},
                                        {"ring", false, tube(ring(3, 24, true), ring(2, 24, false), -1, 2)}};
  EXPECT_THAT(refusal(parts), HasSubstr("has no hinge"));
}

TEST(Shells, ComeApartWhereTwoSolidsOfOneFileTouchAlongAnEdge) {
  Polyhedron both = box_solid(0, 1, 1, 1);
  append(moved(box_solid(0, 1, 1, 1), Isometry3d(Eigen::Translation3d(1, 1, 0))), both);
  const std::vector<Polyhedron> parts = shells(welded(both, 0));
  ASSERT_EQ(parts.size(), 2u);
  for (const Polyhedron& p : parts) {
    EXPECT_EQ(shell_defect(p), "");
    EXPECT_NEAR(volume_mm3(p), 1, 1e-12);
  }
}

}  // namespace
}  // namespace kinetix::model
