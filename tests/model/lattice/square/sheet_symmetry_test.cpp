#include "model/lattice/square/sheet_symmetry.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/support/random_elastic.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

/// Sheet of 3 x 2 cells with hinges anywhere, and its mirror image.
class MirroredSheet : public ::testing::TestWithParam<std::pair<bool, bool>> {
 protected:
  MirroredSheet() {
    for (std::size_t h = 0; h < sheet_.hinges.size(); ++h)
      sheet_.hinges[h].parameters.offset = 0.1 * std::sin(1.0 + static_cast<double>(h));
  }

  Vector3d image(const Vector3d& along) const { return mirror_.cwiseProduct(along); }

  std::mt19937 random_{31};
  Structure sheet_ = testing::random_panel(3, 2, random_);
  const SheetSymmetry symmetry_{sheet_, GetParam().first, GetParam().second};
  const Vector3d mirror_{GetParam().first ? -1.0 : 1.0, GetParam().second ? -1.0 : 1.0, 1};
  const Vector3d far_{GetParam().first ? 3.0 : 0.0, GetParam().second ? 2.0 : 0.0, 0};  // cell edges
};

TEST_P(MirroredSheet, HasPointsAndAxesOfHingesInTheMirror) {
  const Linkage linkage = sheet_;
  for (int h = 0; h < static_cast<int>(sheet_.hinges.size()); ++h) {
    const std::optional<int> other = symmetry_.image(sheet_, h);
    ASSERT_TRUE(other);
    EXPECT_EQ(symmetry_.image(sheet_, *other), h);
    Hinge mirrored = sheet_.hinges[*other];
    mirrored.parameters = symmetry_.image(sheet_, h, *other);
    const RestHinge from = linkage.hinges[h], to = rest_hinge(mirrored);
    const Vector3d point = linkage.bodies[from.lower].position + from.lower_arm;
    EXPECT_LE((linkage.bodies[to.lower].position + to.lower_arm - far_ - image(point)).norm(), 1e-12) << h;
    EXPECT_LE(to.axis.cross(image(from.axis)).norm(), 1e-12) << h;
  }
}

TEST_P(MirroredSheet, HasCellsInTheMirror) {
  for (const Cell& cell : sheet_.cells) {
    const Cell other = symmetry_.image(cell);
    const Vector3d middle(cell.i + 0.5, cell.j + 0.5, 0);
    EXPECT_EQ(Vector3d(other.i + 0.5, other.j + 0.5, 0), image(middle) + far_);
  }
}

INSTANTIATE_TEST_SUITE_P(SheetSymmetry, MirroredSheet,
                         ::testing::Values(std::pair(true, false), std::pair(false, true),
                                           std::pair(true, true)));

}  // namespace
}  // namespace kinetix::model
