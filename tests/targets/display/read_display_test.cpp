#include "targets/display/display_goal.hpp"

#include <gmock/gmock.h>

#include "targets/display/glyph_goal.hpp"
#include "tests/support/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/targets/images.hpp"

namespace kinetix::targets {
namespace {

using testing::BadInput;
using ::testing::DoubleEq;
using testing::drawn;
using ::testing::ElementsAre;
using testing::expect_refused;
using testing::TemporaryFolder;
using testing::write_image;

DisplayGoal display_of(const Node& root) {
  const auto structure = root.optional("structure");
  return read_display(root.required("target", ""), structure ? structure->optional("cells") : std::nullopt);
}

DisplayGoal display_of(const std::string& target, const std::string& file = "in.yaml") {
  return display_of(parse_document("target: " + target + "\n", file));
}

DisplayGoal read_shape(const std::string& name) {
  return display_of(read_document(std::string(KINETIX_SOURCE) + "/targets/shapes/" + name));
}

TEST(ReadDisplay, GivesTenByTenCellsToALetterAndTenColumnsToEachOfAWord) {
  const DisplayGoal letter = display_of("{kind: display, glyph: T}");
  EXPECT_EQ(letter.columns, 10);
  EXPECT_EQ(letter.rows, 10);
  EXPECT_EQ(letter.levels, glyph_goal("T", find_font("DejaVu Serif"), 10, 10).levels);
  const DisplayGoal word = display_of("{kind: display, glyph: \"\xC3\x96l\"}");
  EXPECT_EQ(word.columns, 20);
  EXPECT_EQ(word.rows, 10);
}

TEST(ReadDisplay, TakesTheFontAndThePanelThatAreAsked) {
  const DisplayGoal goal =
      display_of("{kind: display, glyph: T, font: DejaVu Sans Mono}\nstructure: {cells: [14, 12]}");
  EXPECT_EQ(goal.columns, 14);
  EXPECT_EQ(goal.rows, 12);
  EXPECT_EQ(goal.levels, glyph_goal("T", find_font("DejaVu Sans Mono"), 14, 12).levels);
  EXPECT_NE(goal.levels, glyph_goal("T", find_font("DejaVu Sans Bold"), 14, 12).levels);
}

TEST(ReadDisplay, FindsImagesBesideTheDocument) {
  TemporaryFolder folder;
  write_image(folder.path("a.png"), drawn({"##..", "##..", "....", "...."}));
  const std::string file = folder.path("in.yaml");
  EXPECT_EQ(display_of("{kind: display, image: a.png}", file).columns, 20);
  const std::string cells = "\nstructure: {cells: [2, 2]}";
  EXPECT_THAT(display_of("{kind: display, image: a.png, levels: 2}" + cells, file).row_texts(),
              ElementsAre("10", "00"));
  EXPECT_THAT(display_of("{kind: display, image: a.png, invert: true}" + cells, file).row_texts(),
              ElementsAre("01", "11"));
  EXPECT_THAT(
      display_of("{kind: display, image: a.png, levels: grey}\nstructure: {cells: [3, 2]}", file).levels,
      ElementsAre(0, 0, 0, 1, DoubleEq(0.5), 0));
}

TEST(ReadDisplay, TakesRowsQuotedOrNot) {
  EXPECT_THAT(display_of("{kind: display, rows: [\"0110\", 1001]}").row_texts(), ElementsAre("0110", "1001"));
  const std::string rows = "{kind: display, rows: [\"01\", \"10\"]}\nstructure: {cells: ";
  EXPECT_EQ(display_of(rows + "[2, 2]}").columns, 2);
  const DisplayGoal larger = display_of(rows + "[4, 2]}");
  EXPECT_THAT(larger.row_texts(), ElementsAre("0011", "1100"));
  EXPECT_TRUE(larger.whole);
  EXPECT_THAT(larger.resized({2, 2}).row_texts(), ElementsAre("01", "10"));
}

TEST(ReadDisplay, ReadsTheGoalsThatShip) {
  const DisplayGoal letter = read_shape("letter_t.yaml");
  EXPECT_EQ(letter.levels, glyph_goal("T", find_font("DejaVu Sans Bold"), 10, 10).levels);
  const DisplayGoal circle = read_shape("circle.yaml");
  ASSERT_EQ(circle.levels.size(), 144u);
  for (int j = 0; j < 12; ++j)
    for (int i = 0; i < 12; ++i)
      EXPECT_EQ(circle.is_letter(i, j), (i - 5.5) * (i - 5.5) + (j - 5.5) * (j - 5.5) <= 25) << i << " " << j;
}

TEST(ReadDisplay, NamesThePlaceOfEveryMistake) {
  TemporaryFolder folder;
  write_image(folder.path("flat.png"), drawn({"...", "..."}));
  const std::string file = folder.path("in.yaml");
  const std::string glyph = "{kind: display, glyph: T}\n";
  const std::vector<BadInput> cases = {
      {"{kind: display}", 1, 9, "target", {"the picture is missing", "one of `glyph`, `image` and `rows`"}},
      {"{glyph: T, rows: [\"01\", \"10\"]}", 1, 9, "target", {"more than one", "`rows`"}},
      {"{glyph: T, image: a.png}", 1, 9, "target", {"more than one"}},
      {"{kind: display, glph: T}", 1, 25, "target.glph", {"did you mean `glyph`?"}},
      {"{glyph: T, invert: true}", 1, 20, "target.invert", {"allowed: kind, glyph, font"}},
      {"{rows: [\"01\", \"10\"], font: X}", 1, 30, "target.font", {"allowed: kind, rows"}},
      {"{image: flat.png, font: X}", 1, 27, "target.font", {"allowed: kind, image, levels, invert"}},
      {"{glyph: \"\"}", 1, 17, "target.glyph", {"is empty", "a letter or a short word"}},
      {"{glyph: }", 1, 10, "target.glyph", {"is empty", "a letter or a short word"}},
      {"{glyph: \"   \"}", 1, 17, "target.glyph", {"shows no ink, as spaces do"}},
      {"{glyph: \"a\\tb\"}", 1, 17, "target.glyph", {"control character"}},
      {"{glyph: ABCDEFGHIJKLM}", 1, 17, "target.glyph", {"has 13 characters; at most 12"}},
      {"{glyph: \xE4\xB8\xAD}", 1, 17, "target.glyph", {"has no character", "U+4E2D"}},
      {"{glyph: T, font: DejaVu Sans Bald}", 1, 26, "target.font", {"is not installed", "DejaVu Sans"}},
      {"{glyph: [T]}", 1, 17, "target.glyph", {"is a list", "a letter or a short word"}},
      {"{image: none.png}", 1, 17, "target.image", {"none.png: no such file"}},
      {"{image: flat.png}", 1, 17, "target.image", {"flat.png: has one value everywhere"}},
      {"{image: in.yaml}", 1, 17, "target.image", {"Give a PNG, JPEG, PBM or PGM file"}},
      {"{image: flat.png, levels: 3}", 1, 35, "target.levels", {"`3` is not known", "allowed: 2, grey"}},
      {"{image: flat.png, invert: yes}", 1, 35, "target.invert", {"Give true or false"}},
      {"{rows: []}", 1, 16, "target.rows", {"has no rows"}},
      {"{rows: \"01\"}", 1, 16, "target.rows", {"rows of 0 and 1"}},
      {"{rows: [\"010\", \"01\"]}", 1, 24, "target.rows[1]", {"has 2 cells", "rows of equal length"}},
      {"{rows: [\"010\", \"0 1\"]}", 1, 24, "target.rows[1]", {"`0 1` has characters other than 0 and 1"}},
      {"{rows: [\"01\", [0, 1]]}", 1, 23, "target.rows[1]", {"a row of 0 and 1"}},
      {"{rows: [\"11\", \"11\"]}", 1, 16, "target.rows", {"every cell is letter"}},
      {"{rows: [\"00\", \"00\"]}", 1, 16, "target.rows", {"every cell is rest"}},
      {"{rows: [\"01\"]}", 1, 16, "target.rows", {"2 x 1 cells is too small"}},
      {"{rows: [\"01\", \"10\"]}\nstructure: {cells: [3, 2]}",
       2,
       20,
       "structure.cells",
       {"is not a multiple of the size of target.rows, which is [2, 2]"}},
      {glyph + "structure: {cells: [1, 10]}", 2, 21, "structure.cells[0]", {"from 2 to 1000"}},
      {glyph + "structure: {cells: [10, 1001]}", 2, 25, "structure.cells[1]", {"from 2 to 1000"}},
      {glyph + "structure: {cells: [501, 500]}", 2, 20, "structure.cells", {"250000 in all"}},
      {glyph + "structure: {cells: [[0, 0], [1, 0], [0, 1], [1, 1]]}",
       2,
       20,
       "structure.cells",
       {"[columns, rows]", "rectangle"}},
      {glyph + "structure: {cells: [[0, 0], [1, 0]]}", 2, 21, "structure.cells[0]", {"whole number"}},
  };
  for (const BadInput& bad : cases) {
    folder.write("in.yaml", "target: " + bad.text + "\n");
    expect_refused(bad, file, [&] { display_of(read_document(file)); });
  }
}

}  // namespace
}  // namespace kinetix::targets
