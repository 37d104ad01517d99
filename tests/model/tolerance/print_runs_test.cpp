#include "model/tolerance/print_runs.hpp"

#include <gtest/gtest.h>

#include "model/lattice/square/lines.hpp"
#include "tests/support/elastic_equilibrium.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

constexpr double tilt = 0.2;   // rad, of rows of hinges: the sheet bends
constexpr double turn = 0.35;  // rad, of the driven hinge
// Standard deviations of a usual printer: fraction, rad, rad, cell edges.
constexpr HingeScatter print_scatter{0.004, 0.003, 0.004, 0.002};

struct BentSheet {
  Structure structure = make_structure(rectangle(4, 2), {10, 0.8, 6});
  testing::Equilibrium found;

  BentSheet() {
    for (Hinge& hinge : structure.hinges)
      if (hinge.wall.axis == Axis::x) hinge.parameters.beta = starts_in_class_b(hinge.wall) ? -tilt : tilt;
    found =
        testing::equilibrium(structure, {}, testing::hinge_drive(structure, {{0, 0}, Axis::y}, turn), false);
  }

  PrintRuns prints(int count, const ToleranceOptions& options = {}) const {
    std::vector<ObservedPoint> points;
    for (int k = 0; k < static_cast<int>(found.state.size()); ++k)
      points.push_back({{k}, found.state[k].p, Vector3d(std::sin(k), 0.3, std::cos(k)).normalized(), 0});
    const SettledDesign design(structure, {found.state, found.elasticity, drive_on(structure, found.drive)},
                               false);
    return print_runs([&](const Eigen::Matrix4Xd& errors) { return printed(errors); }, design, points,
                      print_scatter, count, options);
  }

  Linkage printed(const Eigen::Matrix4Xd& errors) const {
    Structure s = structure;
    for (Eigen::Index h = 0; h < errors.cols(); ++h) {
      HingeParameters& p = s.hinges[h].parameters;
      p = {p.t + errors(0, h), p.alpha + errors(1, h), p.beta + errors(2, h), p.offset + errors(3, h)};
    }
    return s;
  }
};

TEST(PrintRuns, EndWhereTheyAreToldTo) {
  const BentSheet sheet;
  ASSERT_TRUE(sheet.found.found);
  int asked = 0;
  const PrintRuns some = sheet.prints(50, {.stop = [&] { return ++asked > 5; }});
  ASSERT_GT(some.prints, 0);
  ASSERT_LT(some.prints, 5);
  EXPECT_EQ(some.failed, 0);
  const PrintRuns first = sheet.prints(some.prints);
  EXPECT_EQ(some.prints, first.prints);
  EXPECT_DOUBLE_EQ(some.rms_mm, first.rms_mm);
  EXPECT_GT(first.rms_mm, 0);
}

TEST(PrintRuns, AreTheSameForAnyNumberOfThreads) {
  const BentSheet sheet;
  const PrintRuns one = sheet.prints(70);  // more than are found at once
  ASSERT_EQ(one.prints, 70);
  for (const int threads : {2, 3}) {
    const PrintRuns many = sheet.prints(70, {.threads = threads});
    EXPECT_EQ(many.prints, one.prints);
    EXPECT_EQ(many.rms_mm, one.rms_mm);
    EXPECT_EQ(many.p95_mm, one.p95_mm);
  }
}

TEST(PrintRuns, AreNoneOfARunThatIsToldToStopAtOnce) {
  const PrintRuns none = BentSheet().prints(50, {.stop = [] { return true; }});
  EXPECT_EQ(none.prints + none.failed, 0);
  EXPECT_TRUE(std::isnan(none.rms_mm));
}

}  // namespace
}  // namespace kinetix::model
