#include "targets/display/whole_picture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "targets/display/image_goal.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/targets/images.hpp"

namespace kinetix::targets {
namespace {

using testing::Greys;
using testing::TemporaryFolder;
using testing::write_image;

/// Strokes and gaps of one cell: an E, a ring and a dot.
const std::vector<std::string> fine = {"............", ".####..###..", ".#.....#.#..", ".#.....###..",
                                       ".####.......", ".#..........", ".#........#.", ".####.......",
                                       "............", ".##########.", "............", "............"};

/// Each character as a block of pixels, dark on light.
Greys magnified(const std::vector<std::string>& rows, int pixels) {
  Greys greys;
  for (const std::string& row : rows)
    for (int k = 0; k < pixels; ++k) {
      greys.emplace_back();
      for (const char c : row) greys.back().insert(greys.back().end(), pixels, c == '#' ? 0u : 255u);
    }
  return greys;
}

void add_noise(Greys& greys, double share) {
  std::mt19937 random(7);
  std::bernoulli_distribution is_flipped(share);
  for (auto& row : greys)
    for (unsigned& pixel : row)
      if (is_flipped(random)) pixel = 255 - pixel;
}

TEST(WholePicture, APanelAsFineAsTheStrokesIsNeverCalledTooCoarse) {
  TemporaryFolder folder;
  const std::string file = write_image(folder.path("a.png"), magnified(fine, 10));
  EXPECT_TRUE(image_goal(file, PanelSize{12, 12}).whole);
  EXPECT_TRUE(image_goal(file, PanelSize{24, 24}).whole);
}

TEST(WholePicture, TheNeededPanelIsTheFirstThatIsWhole) {
  TemporaryFolder folder;
  const std::string file = write_image(folder.path("a.png"), magnified(fine, 10));
  for (const int side : {7, 9}) {
    const DisplayGoal coarse = image_goal(file, PanelSize{side, side});
    EXPECT_FALSE(coarse.whole);
    ASSERT_TRUE(coarse.needed);
    EXPECT_LE((*coarse.needed)[0], 12);
    for (int larger = side + 1; larger <= (*coarse.needed)[0]; ++larger)
      EXPECT_EQ(image_goal(file, PanelSize{larger, larger}).whole, larger == (*coarse.needed)[0]) << larger;
  }
}

TEST(WholePicture, KeepsTheProportionsOfThePanelThatIsAsked) {
  TemporaryFolder folder;
  const std::string file = write_image(folder.path("a.png"), magnified(fine, 10));
  const DisplayGoal coarse = image_goal(file, PanelSize{8, 4});
  ASSERT_TRUE(coarse.needed);
  EXPECT_EQ((*coarse.needed)[0], 2 * (*coarse.needed)[1]);
  EXPECT_LE((*coarse.needed)[1], 12);
}

// An arm in the middle is neither a part nor a hole.
TEST(WholePicture, SeesAStrokeThatIsLost) {
  TemporaryFolder folder;
  const std::vector<std::string> e = {"#########", "#########", "###......", "###......",
                                      "###......", "#########", "###......", "###......",
                                      "###......", "#########", "#########", "#########"};
  const DisplayGoal goal = image_goal(write_image(folder.path("e.png"), magnified(e, 10)), PanelSize{3, 4});
  EXPECT_EQ(goal.row_texts(), (std::vector<std::string>{"111", "100", "100", "111"}));
  EXPECT_FALSE(goal.whole);
}

TEST(WholePicture, NoiseIsNoStroke) {
  TemporaryFolder folder;
  Greys greys = magnified(fine, 20);
  add_noise(greys, 0.03);
  const std::string file = write_image(folder.path("a.png"), greys);
  const DisplayGoal goal = image_goal(file, PanelSize{12, 12});
  EXPECT_TRUE(goal.whole);
  for (int j = 0; j < 12; ++j)
    for (int i = 0; i < 12; ++i) EXPECT_EQ(goal.is_letter(i, j), fine[11 - j][i] == '#');
  EXPECT_FALSE(image_goal(file, PanelSize{5, 5}).whole);
}

TEST(WholePicture, AFrameCountsAsAStroke) {
  TemporaryFolder folder;
  Greys greys(120, std::vector<unsigned>(120, 255));
  const auto block = [&](int from, int to) {
    for (int y = from; y < to; ++y)
      for (int x = from; x < to; ++x) greys[y][x] = 255 - greys[y][x];
  };
  block(0, 120);
  block(5, 115);  // a frame of 5 pixels
  block(40, 80);  // and a block in its middle
  const std::string file = write_image(folder.path("a.png"), greys);
  const DisplayGoal coarse = image_goal(file, PanelSize{6, 6});
  EXPECT_FALSE(coarse.whole);
  ASSERT_TRUE(coarse.needed);
  EXPECT_EQ(*coarse.needed, (PanelSize{12, 12}));  // where the frame covers half of each cell at the edge
}

// Its tip is thinner than a cell on every panel.
TEST(WholePicture, ASharpTipIsNoLostStroke) {
  TemporaryFolder folder;
  Greys greys(400, std::vector<unsigned>(200, 255));
  for (int y = 20; y < 380; ++y)
    for (int x = 100 - y / 5; x <= 100 + y / 5; ++x) greys[y][x] = 0;
  const std::string file = write_image(folder.path("a.png"), greys);
  for (const int columns : {8, 13, 20})
    EXPECT_TRUE(image_goal(file, PanelSize{columns, 2 * columns}).whole) << columns;
}

TEST(WholePicture, LargePicturesAreReducedFirst) {
  TemporaryFolder folder;
  const std::string file = write_image(folder.path("a.png"), magnified(fine, 250));
  const DisplayGoal coarse = image_goal(file, PanelSize{7, 7}),
                    same =
                        image_goal(write_image(folder.path("b.png"), magnified(fine, 10)), PanelSize{7, 7});
  EXPECT_EQ(coarse.needed, same.needed);
}

TEST(WholePicture, GreyGoalsAreWholeAsTheyAre) {
  TemporaryFolder folder;
  const std::string file = write_image(folder.path("a.png"), magnified(fine, 10));
  EXPECT_TRUE(image_goal(file, PanelSize{5, 5}, ImageLevels::grey).whole);
}

}  // namespace
}  // namespace kinetix::targets
