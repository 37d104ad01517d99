#include "app/goals/outline/outline_search.hpp"

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

app::Run run_bone(const targets::DocumentChanges& changes, bool seeks_remedy) {
  testing::TemporaryFolder folder;
  RunOptions options;
  options.verify = false;
  options.seeks_remedy = seeks_remedy;
  const auto goal = read_target(folder.write("bone.yaml", bone_target("structure: {cells: [6, 6]}\n"))).goal;
  return run_goal(changes.empty() ? *goal : *goal->change(changes).goal, options);
}

/// The cells that a missed outline names are set in its file, and the goal is met.
TEST(OutlineRemedies, MeetTheGoalThatWasMissed) {
  const app::Run missed = run_bone({}, true);
  ASSERT_FALSE(missed.met());
  const std::string& why = missed.violations.front();
  EXPECT_THAT(why, HasSubstr("the goal is met"));
  constexpr std::string_view key = "structure.cells: ";
  const std::size_t first = why.find(key), last = why.find(']', first);
  ASSERT_NE(first, std::string::npos) << why;
  const std::string cells = why.substr(first + key.size(), last - first - key.size() + 1);
  const app::Run met = run_bone({{"structure.cells", cells}}, false);
  EXPECT_TRUE(met.met()) << (met.met() ? "" : met.violations.front());
}

TEST(OutlineRemedies, AreNotSearchedForUnlessRequested) {
  const app::Run missed = run_bone({}, false);
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
