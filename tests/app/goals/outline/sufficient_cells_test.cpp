#include "app/goals/outline/sufficient_cells.hpp"

#include <gmock/gmock.h>
#include <cmath>

#include "app/goals/registry.hpp"
#include "app/pipeline/pipeline.hpp"
#include "tests/support/temporary_folder.hpp"

namespace kinetix::app {
namespace {

using ::testing::HasSubstr;

/// Returns a bone, two discs with a bar between them, mm.
std::string bone() {
  constexpr double bar_angle = 2.7;  // rad: of the corners of the bar in a disc
  std::string text = "[";
  for (const double side : {1.0, -1.0})
    for (int k = -6; k <= 6; ++k) {
      const double angle = k * bar_angle / 6 + (side > 0 ? 0 : pi);
      text += (text.size() > 1 ? ", [" : "[") + std::to_string(side * 40 + 20 * std::cos(angle)) + ", " +
              std::to_string(20 * std::sin(angle)) + "]";
    }
  return text + "]";
}

std::string bone_target(const std::string& structure) {
  return "kinetix: 1\ntarget: {kind: outline, points: " + bone() + "}\n" + structure;
}

app::Run run_bone(const std::string& text) {
  testing::TemporaryFolder folder;
  RunOptions options;
  options.verify = false;
  options.suggests_cells = true;
  return run_goal(*read_target(folder.write("bone.yaml", text)).goal, options);
}

/// The keys that a missed outline names are followed to the letter.
TEST(SufficientCells, MeetTheGoalThatWasMissed) {
  const app::Run missed = run_bone(bone_target("structure: {cells: [6, 6]}\n"));
  ASSERT_FALSE(missed.met());
  const std::string& why = missed.violations.front();
  const std::size_t first = why.find("structure: {"), last = why.find("}`");
  ASSERT_NE(first, std::string::npos) << why;
  EXPECT_THAT(why, HasSubstr("the goal is met"));
  const app::Run met = run_bone(bone_target(why.substr(first, last - first + 1) + "\n"));
  EXPECT_TRUE(met.met()) << (met.met() ? "" : met.violations.front());
}

TEST(SufficientCells, AreNotSearchedForUnlessRequested) {
  testing::TemporaryFolder folder;
  RunOptions options;
  options.verify = false;
  const app::Run missed = run_goal(
      *read_target(folder.write("bone.yaml", bone_target("structure: {cells: [6, 6]}\n"))).goal, options);
  ASSERT_FALSE(missed.met());
  EXPECT_EQ(missed.violations.front().find("the goal is met"), std::string::npos);
}

TEST(OutlineFile, WithOtherCellsHasTheSameSizeInAll) {
  OutlineFile file;
  file.columns = 12;
  file.rows = 6;
  file.cell_mm = 10;
  file.thickness_mm = 1;
  file.offset_mm = 0.8;
  const OutlineFile fewer = with_cells(file, 8);
  EXPECT_EQ(fewer.columns, 8);
  EXPECT_EQ(fewer.rows, 4);
  EXPECT_NEAR(*fewer.cell_mm, 15, 1e-12);
  EXPECT_NEAR(*fewer.thickness_mm, 1.5, 1e-12);
  EXPECT_NEAR(*fewer.offset_mm, 1.2, 1e-12);
  EXPECT_FALSE(fewer.height_mm);
}

}  // namespace
}  // namespace kinetix::app
