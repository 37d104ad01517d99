#include <gtest/gtest.h>
#include <cmath>

#include "model/material/process.hpp"
#include "tests/support/bad_input.hpp"

namespace kinetix::model {
namespace {

using ::testing::HasSubstr;
using testing::refusal;

ManufacturedHinge pin(double diameter, double clearance) {
  return {.kind = HingeKind::pin, .height_mm = 6, .diameter_mm = diameter, .clearance_mm = clearance};
}

CellSize sheet(double edge, double thickness) { return {edge, thickness, 6}; }

TEST(Process, NamesWhatItCannotPrintAndTheCellThatItCould) {
  const Process& fdm = *find_process("fdm");
  EXPECT_TRUE(print_problems(fdm, sheet(20, 0.8), pin(3, 0.3)).empty());
  EXPECT_EQ(min_cell_mm(fdm, sheet(20, 0.8), pin(3, 0.3)), 20);
  const auto problems = print_problems(fdm, sheet(10, 0.4), pin(1, 0.2));
  ASSERT_EQ(problems.size(), 3u);
  EXPECT_THAT(problems[0].what, HasSubstr("a wall of 0.4 mm is below the minimum of fdm, 0.8 mm"));
  EXPECT_THAT(print_problems(fdm, sheet(10, 0.502019), pin(3, 0.3))[0].what,
              HasSubstr("a wall of 0.502 mm is"));
  EXPECT_THAT(print_problems(fdm, sheet(10, 0.7999), pin(3, 0.3))[0].what,
              HasSubstr("a wall of 0.7999 mm is"));
  EXPECT_DOUBLE_EQ(problems[0].cell_mm, 20);
  EXPECT_DOUBLE_EQ(problems[1].cell_mm, 30);
  EXPECT_DOUBLE_EQ(problems[2].cell_mm, 15);
  EXPECT_DOUBLE_EQ(min_cell_mm(fdm, sheet(10, 0.4), pin(1, 0.2)), 30);
}

/// Printed at the suggested size, no part is too small any more.
TEST(Process, PrintsASheetThatIsLargerByTheFactorItAsksFor) {
  for (const Process& process : processes())
    for (const double thickness : {0.1, 0.7, 2.0})
      for (const double diameter : {0.3, 4.0}) {
        const double edge = 10, least = min_cell_mm(process, sheet(edge, thickness), pin(diameter, 0.04));
        const double factor = least / edge * (1 + 1e-12);
        EXPECT_TRUE(print_problems(process, sheet(factor * edge, factor * thickness),
                                   pin(factor * diameter, factor * 0.04))
                        .empty())
            << process.name;
      }
}

/// A wire is bought, and its bore is narrower than what fuses; the scatter of the clearance must not jam it.
TEST(Process, DoesNotPrintRodsOfWire) {
  const Process& fdm = *find_process("fdm");
  ManufacturedHinge wire = pin(0.5, 0.1);
  wire.kind = HingeKind::rod;
  EXPECT_TRUE(print_problems(fdm, sheet(10, 0.8), wire).empty());
  wire.clearance_mm = 0.05;
  const auto problems = print_problems(fdm, sheet(10, 0.8), wire);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].what,
              HasSubstr("a rod's clearance of 0.05 mm is below the minimum of fdm, 0.1 mm"));
  EXPECT_EQ(clearance_scatter(wire, fdm.sd).place_mm, clearance_scatter(pin(0.5, 0.05), fdm.sd).place_mm);
}

TEST(Process, AsksNothingOfRodsWhereHingesAreBlocks) {
  const ManufacturedHinge block{.kind = HingeKind::block, .gap_mm = 1, .thickness_mm = 0.2, .height_mm = 6};
  EXPECT_TRUE(print_problems(*find_process("sls"), sheet(10, 0.8), block).empty());
}

TEST(Process, IsFoundByItsNameAndHasASource) {
  for (const Process& process : processes()) {
    EXPECT_EQ(find_process(process.name), &process);
    EXPECT_FALSE(process.source.empty());
    EXPECT_EQ(refusal([&] { validate(process.sd); }), "");
  }
  EXPECT_EQ(find_process("mill"), nullptr);
}

TEST(PrintError, NamesAFieldOutOfItsRange) {
  for (const double bad : {std::nan(""), -0.1, 50.0}) {
    EXPECT_THAT(refusal([&] { validate(PrintError{.t_mm = bad}); }), HasSubstr("t_mm"));
    EXPECT_THAT(refusal([&] { validate(PrintError{.tilt_deg = bad}); }), HasSubstr("tilt_deg"));
    EXPECT_THAT(refusal([&] { validate(PrintError{.clearance_mm = bad}); }), HasSubstr("clearance_mm"));
  }
}

TEST(ClearanceScatter, IsOfPinsWhosePlayTheEquilibriumDoesNotHave) {
  ManufacturedHinge loose = pin(2, 0.3);
  const ClearanceScatter tight = clearance_scatter(loose, {0, 0, 0}),
                         scattered = clearance_scatter(loose, {0, 0, 0.4});
  EXPECT_DOUBLE_EQ(tight.place_mm, 0.3 / std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(tight.tilt, std::atan(2 * 0.3 / 6) / std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(scattered.place_mm, 0.5 / std::sqrt(3.0));
  loose.with_play = true;
  EXPECT_EQ(clearance_scatter(loose, {0, 0, 0.4}).place_mm, 0);
  loose.kind = HingeKind::block;
  EXPECT_EQ(clearance_scatter(loose, {0, 0, 0.4}).tilt, 0);
}

}  // namespace
}  // namespace kinetix::model
