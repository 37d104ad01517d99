#include "model/matter/hinge_strain.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "model/lattice/square/structure.hpp"

namespace kinetix::model {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

constexpr MadeHinge make_one_mm_block() {
  return {.kind = HingeKind::block, .gap_mm = 1, .thickness_mm = 0.8, .height_mm = 6};
}

/// Returns the flat state with the upper body of hinge 0 turned by `angle` about `direction` through the hinge point.
State turned(const Linkage& linkage, double angle, const Vector3d& direction) {
  State state = rest_state(linkage);
  const RestHinge& h = linkage.hinges[0];
  Pose& upper = state[h.upper];
  const Vector3d point = state[h.lower].p + linkage.size.edge_mm * (state[h.lower].R * h.lower_arm);
  upper.R = AngleAxisd(angle, direction) * upper.R;
  upper.p = point - linkage.size.edge_mm * (upper.R * h.upper_arm);
  return state;
}

/// Rocking by 0.1 rad across its axis pulls a block 6 mm high apart at its edge. It opens there by 3 mm times that
/// angle, over a gap of 1 mm. Turning about its axis strains its outermost fibre by angle times thickness over twice
/// the gap.
TEST(HingeStrain, CountsWhatRockingPullsApart) {
  const Linkage linkage = make_structure(rectangle(1, 1), {20, 1, 6});
  const MadeHinge block = make_one_mm_block();
  const Vector3d axis = linkage.hinges[0].axis,
                 along = (linkage.hinges[0].lower_arm - linkage.hinges[0].upper_arm).normalized();
  EXPECT_NEAR(hinge_strain(block, linkage, turned(linkage, 0.1, axis.cross(along)), 0),
              2 * std::sin(0.05) * 3, 1e-9);
  EXPECT_NEAR(hinge_strain(block, linkage, turned(linkage, 0.1, axis), 0), 0.1 * 0.8 / 2, 1e-9);
  EXPECT_EQ(hinge_strain(block, linkage, rest_state(linkage), 0), 0);
}

}  // namespace
}  // namespace kinetix::model
