#include "targets/display/glyph_goal.hpp"

#include <gmock/gmock.h>
#include <algorithm>
#include <map>

#include "targets/display/picture.hpp"
#include "tests/support/bad_input.hpp"

namespace kinetix::targets {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using testing::refusal;

DisplayGoal bold(const std::string& text, int columns, int rows) {
  return glyph_goal(text, find_font(default_font), columns, rows);
}

/// Holes that a person counts in a capital.
int holes_of(char letter) {
  const std::map<char, int> holes = {{'A', 1}, {'B', 2}, {'D', 1}, {'O', 1}, {'P', 1}, {'Q', 1}, {'R', 1}};
  return holes.contains(letter) ? holes.at(letter) : 0;
}

TEST(GlyphGoal, TheLetterTIsABarOfTwoRowsOverAStemOfTwoColumns) {
  const DisplayGoal goal = bold("T", 10, 10);
  EXPECT_TRUE(goal.is_binary());
  EXPECT_FALSE(goal.needed);
  EXPECT_THAT(goal.row_texts(),
              ElementsAre("0000000000", "0111111110", "0111111110", "0000110000", "0000110000", "0000110000",
                          "0000110000", "0000110000", "0000110000", "0000000000"));
}

TEST(GlyphGoal, CapitalsOnTwelveCellsHaveThePartsAndHolesAPersonCounts) {
  for (char letter = 'A'; letter <= 'Z'; ++letter) {
    const std::string text(1, letter);
    const Topology seen = {1, holes_of(letter)};
    EXPECT_EQ(topology(glyph_picture(text, find_font(default_font))), seen) << text;
    const DisplayGoal goal = bold(text, 12, 12);
    EXPECT_EQ(topology(goal), seen) << text;
    EXPECT_FALSE(goal.needed) << text;
  }
}

TEST(GlyphGoal, FillsThePanelInsideAMarginOfOneCell) {
  for (const char* text : {"H", "W", "O", "T"}) {
    const auto rows = bold(text, 14, 12).row_texts();
    EXPECT_EQ(rows.front(), std::string(14, '0')) << text;
    EXPECT_EQ(rows.back(), std::string(14, '0')) << text;
    EXPECT_THAT(rows[1], HasSubstr("1")) << text;
    EXPECT_THAT(rows[10], HasSubstr("1")) << text;
    int leftmost = 14, rightmost = -1;
    for (const std::string& row : rows) {
      leftmost = std::min(leftmost, static_cast<int>(std::min<std::size_t>(row.find('1'), 14)));
      if (row.find('1') != std::string::npos)
        rightmost = std::max(rightmost, static_cast<int>(row.rfind('1')));
    }
    EXPECT_EQ(leftmost, 1) << text;
    EXPECT_EQ(rightmost, 12) << text;
  }
}

TEST(GlyphGoal, HasNoMarginBelowFiveCells) {
  EXPECT_THAT(bold("T", 5, 5).row_texts(), ElementsAre("00000", "01110", "00100", "00100", "00000"));
  EXPECT_THAT(bold("T", 4, 4).row_texts(), ElementsAre("1111", "0110", "0110", "0110"));
}

TEST(GlyphGoal, StretchesASlimLetterByOneAndAHalfAtMost) {
  const Picture letter = glyph_picture("I", find_font(default_font));
  const double width =
      max_glyph_stretch * 98 * letter.width / letter.height;  // of 98 cells inside the margin
  const DisplayGoal goal = bold("I", 100, 100);
  const double cells = static_cast<double>(std::count(goal.levels.begin(), goal.levels.end(), 1.0)) / 98;
  EXPECT_NEAR(cells, width, 1);
  EXPECT_LT(cells, 50);
}

// On cells twice as wide as high, a letter has half as many columns.
TEST(GlyphGoal, CountsTheShapeOfCellsInWhatItStretches) {
  const FontFile font = find_font(default_font);
  const auto columns_of = [&](double cell_shape) {
    const DisplayGoal goal = glyph_goal("I", font, 100, 100, cell_shape);
    return static_cast<double>(std::count(goal.levels.begin(), goal.levels.end(), 1.0)) / 98;
  };
  EXPECT_NEAR(columns_of(2), columns_of(1) / 2, 1);
}

TEST(GlyphGoal, SymmetricLettersAreSymmetricOnEveryPanel) {
  for (const char* text : {"T", "H", "I", "O"})
    for (int side = 4; side <= 15; ++side)
      for (std::string row : bold(text, side, side).row_texts()) {
        const std::string forwards = row;
        std::reverse(row.begin(), row.end());
        EXPECT_EQ(row, forwards) << text << " on " << side;
      }
}

TEST(GlyphGoal, NamesTheSmallestPanelThatShowsTheLetterWhole) {
  const DisplayGoal coarse = bold("B", 4, 4);
  EXPECT_NE(topology(coarse), (Topology{1, 2}));
  ASSERT_TRUE(coarse.needed);
  const int side = (*coarse.needed)[0];
  EXPECT_EQ((*coarse.needed)[1], side);
  EXPECT_EQ(topology(bold("B", side, side)), (Topology{1, 2}));
  EXPECT_FALSE(bold("B", side, side).needed);
  for (int smaller = 5; smaller < side; ++smaller)
    EXPECT_EQ(bold("B", smaller, smaller).needed, coarse.needed);
}

TEST(GlyphGoal, KeepsTheProportionsOfTheNeededPanel) {
  const DisplayGoal coarse = bold("WWWWWWWWWWWW", 120, 10);
  ASSERT_TRUE(coarse.needed);
  EXPECT_EQ((*coarse.needed)[0], 12 * (*coarse.needed)[1]);
  const DisplayGoal tall = bold("WW", 3, 7);
  ASSERT_TRUE(tall.needed);
  EXPECT_NEAR((*tall.needed)[1], (*tall.needed)[0] * 7 / 3.0, 0.5);
}

TEST(GlyphGoal, SetsAWordLetterByLetter) {
  const DisplayGoal goal = bold("HELLO", 50, 10);
  EXPECT_EQ(topology(goal), (Topology{5, 1}));
  EXPECT_FALSE(goal.needed);
  EXPECT_EQ(topology(bold("\xC3\x96l", 24, 16)), (Topology{4, 1}));  // O with its two dots, and l
}

/// Columns of ink from the left, as shares of the picture's height.
std::vector<double> profile(const Picture& picture) {
  std::vector<double> out;
  for (int x = 0; x < picture.width; ++x) {
    double sum = 0;
    for (int y = 0; y < picture.height; ++y)
      sum += picture.ink[static_cast<std::size_t>(y) * picture.width + x] / 255.0;
    out.push_back(sum / picture.height);
  }
  return out;
}

double middle_of_ink(const Picture& picture) {
  double sum = 0, weight = 0;
  const auto columns = profile(picture);
  for (std::size_t x = 0; x < columns.size(); ++x) {
    sum += (static_cast<double>(x) + 0.5) * columns[x];
    weight += columns[x];
  }
  return sum / weight / picture.width;
}

Picture in_sans(const std::string& text) { return glyph_picture(text, find_font("DejaVu Sans")); }

TEST(GlyphPicture, SetsHebrewAndArabicFromTheRight) {
  // A narrow letter and a wide one: which of them stands on the right shows in where the ink is.
  const std::string vav = "\xD7\x95", shin = "\xD7\xA9", digits = "12";
  EXPECT_EQ(in_sans(vav + shin).ink, in_sans("\xE2\x80\xAD" + shin + vav).ink)
      << "shin is drawn first, at the left";
  EXPECT_NE(in_sans(vav + shin).ink, in_sans(shin + vav).ink);
  EXPECT_LT(middle_of_ink(in_sans("i"
                                  "W")),
            1)
      << "Latin runs to the right";
  EXPECT_EQ(in_sans("iW").ink, in_sans("\xE2\x80\xAD"
                                       "iW")
                                   .ink);
  EXPECT_EQ(in_sans(digits).ink, in_sans("\xE2\x80\xAD" + digits).ink)
      << "numbers run to the right everywhere";
}

TEST(GlyphPicture, JoinsArabicLetters) {
  const std::string seen = "\xD8\xB3", lam = "\xD9\x84", alef = "\xD8\xA7", meem = "\xD9\x85",
                    apart = "\xE2\x80\x8C";
  EXPECT_EQ(topology(in_sans(seen + lam + meem)).components, 1) << "three letters in one stroke";
  EXPECT_EQ(topology(in_sans(seen + apart + lam + apart + meem)).components, 3)
      << "a non-joiner between them";
  EXPECT_EQ(topology(in_sans(lam + alef)).components, 1) << "the ligature that Arabic requires";
  EXPECT_EQ(topology(in_sans(seen + lam + alef + meem)).components, 2) << "alef does not join to the left";
}

TEST(GlyphPicture, PutsAccentsOverTheirLetters) {
  EXPECT_EQ(in_sans("u\xCC\x88").ink, in_sans("\xC3\xBC").ink) << "u and a diaeresis are one letter";
  const std::string heart = "\xE2\x99\xA5", selector = "\xEF\xB8\x8F";
  EXPECT_EQ(in_sans(heart + selector).ink, in_sans(heart).ink);
}

TEST(GlyphPicture, CountsLettersAsAReader) {
  EXPECT_EQ(count_letters("HELLO"), 5);
  EXPECT_EQ(count_letters("u\xCC\x88"), 1) << "u and a diaeresis";
  EXPECT_EQ(count_letters("\xE2\x99\xA5\xEF\xB8\x8F"), 1) << "a heart and a variation selector";
  EXPECT_EQ(count_letters("\xF0\x9F\x91\x8D\xF0\x9F\x8F\xBD"), 1) << "a thumb and its skin tone";
  EXPECT_EQ(count_letters("\xF0\x9F\x87\xA9\xF0\x9F\x87\xAA"), 1) << "a flag of two indicators";
  EXPECT_EQ(count_letters("\xD8\xB3\xD9\x84\xD8\xA7\xD9\x85"), 4);
}

TEST(SeenTopology, TellsDotsThatMeltFromDotsThatStandApart) {
  const DisplayGoal dots =
      rows_goal({"0000000", "0110110", "0000000", "0110110", "0110110", "0011100", "0000000"});
  ASSERT_EQ(topology(dots), (Topology{3, 0}));
  std::vector<double> light(dots.levels.size());
  for (std::size_t k = 0; k < light.size(); ++k) light[k] = 0.66 + 0.09 * dots.levels[k];
  EXPECT_EQ(seen_topology(dots, light), topology(dots));
  const auto at = [&](int i, int j) -> double& {
    return light[static_cast<std::size_t>(j) * dots.columns + i];
  };
  auto dim = light;
  std::swap(dim, light);
  at(3, 5) = at(1, 5);  // the gap of the two dots is as bright as they are
  EXPECT_EQ(seen_topology(dots, light), (Topology{2, 0}));
  light = dim;
  at(1, 4) = at(1, 5);  // a dot runs into the letter
  EXPECT_EQ(seen_topology(dots, light), (Topology{2, 0}));
  light = dim;
  at(2, 5) = at(1, 5) = 0.66;  // a dot is not seen
  EXPECT_EQ(seen_topology(dots, light), (Topology{2, 0}));
  light = dim;
  at(3, 5) = 0.70;  // brighter than the rest, and yet darker than the dots
  EXPECT_EQ(seen_topology(dots, light), topology(dots));
}

TEST(GlyphGoal, RefusesWhatItCannotShow) {
  EXPECT_THAT(refusal([] { bold("", 10, 10); }), HasSubstr("is empty. Give a letter"));
  EXPECT_THAT(refusal([] { bold("  ", 10, 10); }), HasSubstr("shows no ink, as spaces do"));
  EXPECT_THAT(refusal([] { bold("ABCDEFGHIJKLM", 10, 10); }), HasSubstr("has 13 characters; at most 12"));
  EXPECT_THAT(refusal([] { bold("a\xE4\xB8\xAD", 10, 10); }),
              HasSubstr("`DejaVu Sans Bold` has no character `\xE4\xB8\xAD` (U+4E2D)"));
  EXPECT_THAT(refusal([] { bold("\xC3(", 10, 10); }), HasSubstr("is not UTF-8 text"));
  EXPECT_THAT(refusal([] { bold("\xE2\x96\x88", 4, 4); }), HasSubstr("every cell is letter"));
  EXPECT_THAT(refusal([] { bold("T", 1, 4); }), HasSubstr("1 x 4 cells is too small"));
  EXPECT_THAT(refusal([] { bold("T", 1001, 4); }), HasSubstr("too large"));
  EXPECT_THAT(refusal([] {
                glyph_goal("T", {"Lost", "/no/such/file", 0}, 9, 9);
              }),
              HasSubstr("/no/such/file cannot be read"));
}

TEST(GlyphGoal, NamesTheNeededPanelWhereNoStrokeFillsACell) {
  EXPECT_THAT(refusal([] { bold("WMWM", 4, 20); }),
              AllOf(HasSubstr("every cell is"), HasSubstr("picture is [")));
  EXPECT_THAT(refusal([] { bold("WMWMWMWMWMWM", 4, 200); }),
              AllOf(HasSubstr("every cell is"), HasSubstr("no allowed panel of these proportions")));
}

TEST(GlyphGoal, MissesTheMiddleArmOfAnE) {
  const DisplayGoal goal = bold("E", 6, 4);
  EXPECT_EQ(topology(goal), (Topology{1, 0}));
  EXPECT_FALSE(goal.whole);
  ASSERT_TRUE(goal.needed);
  EXPECT_TRUE(bold("E", (*goal.needed)[0], (*goal.needed)[1]).whole);
}

TEST(GlyphGoal, IsRedrawnFromItsOutlines) {
  const DisplayGoal goal = bold("R", 8, 8);
  EXPECT_EQ(goal.resized({14, 13}).levels, bold("R", 14, 13).levels);
}

TEST(FindFont, TakesFullNamesAndFamiliesInAnyCase) {
  EXPECT_THAT(find_font("DejaVu Sans Bold").path, EndsWith("DejaVuSans-Bold.ttf"));
  EXPECT_THAT(find_font("dejavu sans bold").path, EndsWith("DejaVuSans-Bold.ttf"));
  EXPECT_THAT(find_font("DejaVu Sans").path, EndsWith("DejaVuSans.ttf"));
  EXPECT_THAT(find_font("DejaVu Sans Mono").path, EndsWith("DejaVuSansMono.ttf"));
  EXPECT_THAT(find_font("DejaVu Serif Bold").path, EndsWith("DejaVuSerif-Bold.ttf"));
}

TEST(FindFont, SubstitutesNothingAndNamesTheNearestFamilies) {
  const std::string message = refusal([] { find_font("DejaVu Snas"); });
  EXPECT_THAT(message, AllOf(HasSubstr("`DejaVu Snas` is not installed"), HasSubstr(": DejaVu Sans, ")));
  EXPECT_LE(std::count(message.begin(), message.end(), ','), 11);
  EXPECT_THAT(refusal([] { find_font("Sans"); }), HasSubstr("is not installed"));
  EXPECT_THAT(refusal([] { find_font(std::string(100'000, 'x')); }), HasSubstr("is not installed"));
}

}  // namespace
}  // namespace kinetix::targets
