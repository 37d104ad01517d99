#include "targets/display/image_goal.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <random>

#include "tests/support/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/targets/images.hpp"

namespace kinetix::targets {
namespace {

using testing::drawn;
using ::testing::ElementsAre;
using testing::Greys;
using ::testing::HasSubstr;
using testing::read_file;
using testing::refusal;
using testing::TemporaryFolder;
using testing::write_colour_image;
using testing::write_image;

// Two by two pixels of ink in the upper left: shows which way up and round a picture is read.
const std::vector<std::string> corner = {"##..", "##..", "....", "...."};

TEST(ImageGoal, ReadsPngPgmAndPbmAlike) {
  TemporaryFolder folder;
  const std::vector<std::string> files = {
      write_image(folder.path("a.png"), drawn(corner)),
      write_image(folder.path("b.pgm"), drawn(corner), IFF_PNM),
      write_image(folder.path("c.pbm"), drawn(corner, 1, 0), IFF_PNM, 1),
      write_image(folder.path("d.png"), drawn(corner, 1, 0), IFF_PNG, 1),
      write_image(folder.path("e.png"), drawn(corner, 0x1000, 0xf000), IFF_PNG, 16),
      folder.write("f.pgm", "P2\n4 4 15\n0 0 9 9 0 0 9 9 9 9 9 9 9 9 9 9\n"),
      folder.write("g.pbm", "P1\n# by hand\n4 4\n1 1 0 0 1 1 0 0 0 0 0 0 0 0 0 0\n"),
  };
  for (const std::string& file : files) {
    const DisplayGoal goal = image_goal(file, PanelSize{4, 4});
    EXPECT_THAT(goal.row_texts(), ElementsAre("1100", "1100", "0000", "0000")) << file;
    EXPECT_TRUE(goal.is_binary()) << file;
  }
}

TEST(ImageGoal, AveragesARectangleExactly) {
  TemporaryFolder folder;
  const auto file = write_image(folder.path("a.png"), drawn({"......", ".####.", ".####.", "......"}));
  const DisplayGoal grey = image_goal(file, PanelSize{3, 2}, ImageLevels::grey);
  EXPECT_THAT(grey.levels, ElementsAre(0.25, 0.5, 0.25, 0.25, 0.5, 0.25));
  EXPECT_FALSE(grey.is_binary());
  EXPECT_THAT(image_goal(file, PanelSize{3, 2}).levels, ElementsAre(0, 1, 0, 0, 1, 0));
}

TEST(ImageGoal, KeepsGreysAsTheyAre) {
  TemporaryFolder folder;
  const auto file = write_image(folder.path("a.png"), {{0, 51}, {204, 255}});
  EXPECT_THAT(image_goal(file, PanelSize{2, 2}, ImageLevels::grey).levels, ElementsAre(0.2, 0, 1, 0.8));
  EXPECT_THAT(image_goal(file, PanelSize{2, 2}, ImageLevels::grey, true).levels, ElementsAre(0.8, 1, 0, 0.2));
}

TEST(ImageGoal, ThresholdsFaintPicturesByOtsu) {
  TemporaryFolder folder;
  for (const unsigned dark : {0u, 100u, 253u}) {
    const auto file = write_image(folder.path("a.png"), drawn(corner, dark, dark + 2));
    EXPECT_THAT(image_goal(file, PanelSize{2, 2}).row_texts(), ElementsAre("10", "00")) << dark;
    EXPECT_THAT(image_goal(file, PanelSize{2, 2}, ImageLevels::two, true).row_texts(),
                ElementsAre("01", "11"));
  }
  const auto file = write_image(folder.path("b.png"), {{20, 60, 220, 230}, {25, 70, 210, 240}});
  EXPECT_THAT(image_goal(file, PanelSize{4, 2}).row_texts(), ElementsAre("1100", "1100"));
}

TEST(ImageGoal, TakesTransparentPixelsForWhiteAndColoursByLuminance) {
  TemporaryFolder folder;
  const auto file =
      write_colour_image(folder.path("a.png"), {{0x000000ff, 0x00000000}, {0x0000ffff, 0xffff00ff}});
  EXPECT_THAT(image_goal(file, PanelSize{2, 2}).row_texts(), ElementsAre("10", "10"));
}

TEST(ImageGoal, HasTwentyColumnsInThePicturesProportionsByDefault) {
  TemporaryFolder folder;
  Greys greys(30, std::vector<unsigned>(40, 255));
  greys[3][5] = 0;
  for (auto& row : greys) row[7] = row[8] = 0;
  const DisplayGoal goal = image_goal(write_image(folder.path("a.png"), greys));
  EXPECT_EQ(goal.columns, 20);
  EXPECT_EQ(goal.rows, 15);
}

// Bricks are twice as wide as high: as many rows as of squares would show the picture half as high.
TEST(ImageGoal, KeepsThePicturesProportionsOnOtherCellsThanSquares) {
  TemporaryFolder folder;
  Greys greys(30, std::vector<unsigned>(40, 255));
  for (auto& row : greys) row[7] = row[8] = row[9] = 0;
  const DisplayGoal goal =
      image_goal(write_image(folder.path("a.png"), greys), {}, ImageLevels::two, false, 2);
  EXPECT_EQ(goal.columns, 20);
  EXPECT_EQ(goal.rows, 30);
}

TEST(ImageGoal, RefusesWhatIsNoPictureOfALetter) {
  TemporaryFolder folder;
  const auto says = [&](const std::string& file) { return refusal([&] { image_goal(file); }); };
  const auto png = read_file(write_image(folder.path("whole.png"), drawn(corner)));
  EXPECT_THAT(says(folder.path("none.png")), HasSubstr("none.png: no such file"));
  EXPECT_THAT(says("/dev/zero"), HasSubstr("device"));
  EXPECT_THAT(says(folder.path(".")), HasSubstr("is a folder"));
  EXPECT_THAT(says(folder.write("text.png", "hello\n")), HasSubstr("Give a PNG, JPEG, PBM or PGM file"));
  EXPECT_THAT(says(folder.write("nine.pgm", "P2\n2 1 9\n0 9\n")),
              HasSubstr("largest value is 3, 15, 255 or 65535"));
  EXPECT_THAT(says(folder.write("one.pgm", "P2\n2 1 1\n0 1\n")), HasSubstr("largest value is 3, 15"))
      << "it was refused by a message that allowed it";
  EXPECT_THAT(says(folder.write("empty.png", "")), HasSubstr("Give a PNG, JPEG, PBM or PGM file"));
  EXPECT_THAT(
      says(folder.write("cut.png", png.substr(0, png.size() / 2))),
      HasSubstr("cut.png: is damaged and cannot be decoded (it ends too early). Give a whole PNG file"));
  EXPECT_THAT(says(folder.write("cut.pgm", "P5\n4 4\n255\nabc")), HasSubstr("cut.pgm: is damaged"));
  EXPECT_THAT(says(write_image(folder.path("a.bmp"), drawn(corner), IFF_BMP)), HasSubstr("allowed format"));
  EXPECT_THAT(says(folder.write("a.ppm", "P3\n1 2 255\n0 0 0 255 255 255\n")), HasSubstr("allowed format"));
  EXPECT_THAT(says(write_image(folder.path("flat.png"), drawn({"....", "...."}))),
              HasSubstr("one value everywhere"));
  std::string wide(201, '.');
  wide.back() = '#';
  EXPECT_THAT(says(write_image(folder.path("flat.png"), drawn({wide}))),
              HasSubstr("20 x 1 cells is too small"));
  std::vector<std::string> tall(100, ".");
  tall[0] = "#";
  EXPECT_THAT(says(write_image(folder.path("tall.png"), drawn(tall))),
              HasSubstr("20 x 2000 cells is too large"));
}

TEST(ImageGoal, SaysInOneMessageOfItsOwnWhereAPngIsDamaged) {
  TemporaryFolder folder;
  const std::string png = read_file(write_image(folder.path("whole.png"), drawn(corner)));
  const std::size_t data = png.find("IDAT") + 4;
  std::string bad_sum = png, bad_deflate = png;
  bad_sum[data + 6] ^= 1;
  bad_deflate[data] = 0;
  ::testing::internal::CaptureStderr();
  const auto says = [&](const std::string& bytes) {
    return refusal([&] { image_goal(folder.write("a.png", bytes)); });
  };
  EXPECT_THAT(says(bad_sum), HasSubstr("a.png: is damaged and cannot be decoded ("));
  EXPECT_THAT(says(bad_deflate), HasSubstr("a.png: is damaged and cannot be decoded ("));
  EXPECT_THAT(says(png.substr(0, png.size() - 14)), HasSubstr("(it ends too early)"));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(ImageGoal, ReadsAJpegAndRefusesADamagedOne) {
  TemporaryFolder folder;
  Greys greys(32, std::vector<unsigned>(32, 255));
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) greys[y][x] = 0;
  const std::string file = write_image(folder.path("a.jpg"), greys, IFF_JFIF_JPEG);
  EXPECT_THAT(image_goal(file, PanelSize{2, 2}).row_texts(), ElementsAre("10", "00"));
  const std::string bytes = read_file(file);
  EXPECT_THAT(refusal([&] { image_goal(folder.write("cut.jpg", bytes.substr(0, bytes.size() - 8))); }),
              HasSubstr("cut.jpg: is damaged and cannot be decoded. Give a whole JPEG file"));
}

/// libpng warns about what it can do without.
TEST(ImageGoal, ReadsAPngWithAUselessChunkInSilence) {
  TemporaryFolder folder;
  std::string png = read_file(write_image(folder.path("a.png"), drawn(corner)));
  png.insert(png.find("IDAT") - 4, std::string("\0\0\0\4gAMA\0\0\0\0\xff\xff\xff\xff", 16));
  ::testing::internal::CaptureStderr();
  EXPECT_THAT(image_goal(folder.write("a.png", png), PanelSize{2, 2}).row_texts(), ElementsAre("10", "00"));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(ImageGoal, RefusesHugeImagesByTheirHeader) {
  TemporaryFolder folder;
  const auto says = [&](const std::string& file) { return refusal([&] { image_goal(file); }); };
  EXPECT_THAT(says(folder.write("a.pgm", "P5\n8001 8000\n255\n")),
              HasSubstr("a.pgm: is too large: 8001 x 8000 pixels; at most 64 megapixels"));
  std::string png = read_file(write_image(folder.path("b.png"), drawn(corner)));
  png.replace(16, 8, std::string("\0\0\x1f\x40\0\0\x1f\x41", 8));
  EXPECT_THAT(says(folder.write("b.png", png)), HasSubstr("8000 x 8001 pixels"));
  png.replace(16, 10, std::string("\0\0\x1f\x40\0\0\x1f\x40\x10\x06", 10));  // 16 bits, four samples a pixel
  EXPECT_THAT(says(folder.write("b.png", png)), HasSubstr("once decoded; at most 256 MiB"));
  png.replace(16, 8, std::string(8, '\xff'));
  EXPECT_THAT(says(folder.write("b.png", png)), HasSubstr("b.png: is "));
  std::filesystem::resize_file(folder.write("c.png", png), 300 << 20);
  EXPECT_THAT(says(folder.path("c.png")), HasSubstr("300 MiB; at most 256 MiB"));
}

TEST(ImageGoal, SurvivesRandomMutations) {
  TemporaryFolder folder;
  std::mt19937 random(12);
  const std::vector<std::string> valid = {
      read_file(write_image(folder.path("a.png"), drawn(corner))),
      read_file(write_image(folder.path("a.pgm"), drawn(corner), IFF_PNM)),
      "P2\n4 4 15\n0 0 9 9 0 0 9 9 9 9 9 9 9 9 9 9\n",
      "P1\n4 4\n1 1 0 0 1 1 0 0 0 0 0 0 0 0 0 0\n",
  };
  int accepted = 0;
  ::testing::internal::CaptureStderr();
  for (int round = 0; round < 400; ++round) {
    std::string bytes = valid[round % 4];
    for (std::size_t n = 1 + random() % 3; n > 0; --n)
      bytes[random() % bytes.size()] =
          round % 4 < 2 ? static_cast<char>(random()) : "0123 9\n#P"[random() % 9];
    const auto file = folder.write("m", bytes);
    try {
      const DisplayGoal goal = image_goal(file, PanelSize{4, 4}, ImageLevels::grey);
      for (const double level : goal.levels) EXPECT_TRUE(level >= 0 && level <= 1);
      ++accepted;
    } catch (const InvalidInput&) {
    }
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << "a library's own words about a damage";
  EXPECT_GT(accepted, 20);
}

}  // namespace
}  // namespace kinetix::targets
