#include "targets/document/section.hpp"

#include <gmock/gmock.h>
#include <stdexcept>

#include "model/base/geometry.hpp"
#include "tests/support/bad_input.hpp"

namespace kinetix::targets {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::refusal;

enum class Colour { red, green };
// Words that the key `colour` accepts.
constexpr Word<Colour> colours[] = {{"red", Colour::red}, {"green", Colour::green}};

const KeyTable& keys() {
  static const KeyTable inner(
      {{"depth_mm", value::length(from_to(0.01, 2, "mm (0.01 to 2 cells)")), {}, "a length"}});
  static const KeyTable keys({
      {"part", value::number({0, 1, false, true}), by_default(0.5), "a part"},
      {"turn_deg", value::angle(between(-90, 90, "degrees")), by_default(0.0), "an angle"},
      {"count", value::integer(1, 9), by_default(3), "a number of things"},
      {"colour", value::choice(colours), by_default("red"), "a colour"},
      {"range", value::range({}), {}, "a range"},
      {"inner", value::map(inner), {}, "a section"},
      {"must", value::number(), needed, "a number"},
  });
  return keys;
}

Section section(const std::string& text) { return {parse_document(text, "in.yaml"), keys()}; }

TEST(Section, LeavesDefaultsWhereTheFileSaysNothing) {
  const Section file = section("must: 1\n");
  double part = 0.5;
  std::optional<int> count;
  Colour colour = Colour::red;
  file.read("part", part);
  file.read("count", count);
  file.read("colour", colour, colours);
  EXPECT_EQ(part, 0.5);
  EXPECT_FALSE(count);
  EXPECT_EQ(colour, Colour::red);
  EXPECT_FALSE(file.section("inner").given());
}

TEST(Section, ReadsByTheTypesOfItsTable) {
  const Section file =
      section("{part: 0.25, turn_deg: 45, count: 4, colour: green, range: [1, 2], inner: {depth_mm: 20}}");
  double part = 0, turn = 0, depth = 0;
  std::optional<int> count;
  Colour colour = Colour::red;
  std::array<double, 2> range;
  file.read("part", part);
  file.read("turn_deg", turn);
  file.read("count", count);
  file.read("colour", colour, colours);
  file.read("range", range);
  file.section("inner").read_length("depth_mm", depth, 10);
  EXPECT_EQ(part, 0.25);
  EXPECT_EQ(turn, pi / 4);
  EXPECT_EQ(count, 4);
  EXPECT_EQ(colour, Colour::green);
  EXPECT_THAT(range, ElementsAre(1, 2));
  EXPECT_EQ(depth, 20);
}

TEST(Section, AllowsWhatItsTableAllows) {
  double value = 0;
  int count = 0;
  EXPECT_THAT(refusal([] { section("{most: 1}"); }),
              HasSubstr("did you mean `must`?); allowed: part, turn_deg, count, colour, range, inner, must"));
  EXPECT_THAT(refusal([&] { section("{part: 2}").read("part", value); }), HasSubstr("above 0 and at most 1"));
  EXPECT_THAT(refusal([&] { section("{count: 10}").read("count", count); }), HasSubstr("from 1 to 9"));
  EXPECT_THAT(refusal([&] {
                section("{inner: {depth_mm: 21}}").section("inner").read_length("depth_mm", value, 10);
              }),
              HasSubstr("from 0.1 to 20, in mm (0.01 to 2 cells)"));
  EXPECT_THAT(refusal([] { section("{part: 1}").required("must", "a number"); }),
              HasSubstr("the key `must` is missing. Give a number"));
}

TEST(Section, ReadsNoKeyThatItsTableDoesNotHave) {
  const Section file = section("must: 1\n");
  double number = 0;
  EXPECT_THROW(file.optional("other"), std::logic_error);
  EXPECT_THROW(file.read("other", number), std::logic_error);
  EXPECT_THROW(file.section("other"), std::logic_error);
}

TEST(Section, ReadsNoKeyAsAnotherTypeThanItsTableSays) {
  const Section file = section("must: 1\n");
  double number = 0;
  int count = 0;
  Colour colour = Colour::red;
  constexpr Word<Colour> others[] = {{"red", Colour::red}, {"blue", Colour::green}};
  EXPECT_THROW(file.read("count", number), std::logic_error);
  EXPECT_THROW(file.read("part", count), std::logic_error);
  EXPECT_THROW(file.read("colour", colour, others), std::logic_error);
  EXPECT_THROW(file.required("part", "a part"), std::logic_error);
}

// `crimson` is the earlier name of `red`.
constexpr Word<Colour> renamed_colours[] = {
    {"red", Colour::red}, {"green", Colour::green}, {"crimson", Colour::red}};

const KeyTable& renamed_keys() {
  static const KeyTable keys({
      Key("width_mm", value::number(), needed, "a width").formerly("w"),
      Key("colour", value::choice(renamed_colours), by_default("red"), "a colour").formerly("hue"),
  });
  return keys;
}

Section renamed(const std::string& text) { return {parse_document(text, "in.yaml"), renamed_keys()}; }

TEST(EarlierNames, AreReadLikeTheCurrentOnes) {
  for (const char* text : {"{width_mm: 2, colour: green}", "{w: 2, hue: green}"}) {
    double width = 0;
    Colour colour = Colour::red;
    renamed(text).read_needed("width_mm", "a width", width);
    renamed(text).read("colour", colour, renamed_colours);
    EXPECT_EQ(width, 2);
    EXPECT_EQ(colour, Colour::green);
  }
  Colour colour = Colour::green;
  renamed("{w: 1, colour: crimson}").read("colour", colour, renamed_colours);
  EXPECT_EQ(colour, Colour::red);
  EXPECT_EQ(renamed_keys().at("w").name, "width_mm");
  EXPECT_EQ(renamed_keys().at("width_mm").written_name(), "w");
}

TEST(EarlierNames, AreNotInMessages) {
  EXPECT_THAT(refusal([] { renamed("{w: 1, width_mm: 1}"); }),
              HasSubstr("w: `w` is the earlier name of `width_mm`, which is given as well"));
  EXPECT_THAT(refusal([] { renamed("{with_mm: 1}"); }),
              HasSubstr("did you mean `width_mm`?); allowed: width_mm, colour"));
  EXPECT_THAT(refusal([] { renamed("{}").required("width_mm", "a width"); }),
              HasSubstr("the key `width_mm` is missing"));
  Colour colour = Colour::red;
  EXPECT_THAT(refusal([&] { renamed("{w: 1, hue: blue}").read("colour", colour, renamed_colours); }),
              HasSubstr("allowed: red, green"));
  EXPECT_THAT(renamed_keys().at("colour").type.words, ElementsAre("red", "green"));
}

TEST(KeyTable, KnowsWhatGoesWithEachAlternative) {
  const KeyTable by_key({{"a", value::number(), {}, "one way"},
                         {"of_a", value::number(), {}, "more of it", "a"},
                         {"b", value::number(), {}, "the other way"},
                         {"both", value::number(), {}, "of both"}},
                        {{"a", "b"}});
  EXPECT_THAT(by_key.only("a").names(), ElementsAre("a", "of_a", "both"));
  EXPECT_THAT(by_key.only("b").names(), ElementsAre("b", "both"));
  const KeyTable by_word({{"kind", value::choice({"a", "b"}), needed, "which way"},
                          {"of_a", value::number(), {}, "of one", "a"},
                          {"of_b", value::number(), {}, "of the other", "b"}},
                         {{"a", "b"}, "kind"});
  EXPECT_THAT(by_word.only("b").names(), ElementsAre("kind", "of_b"));
  EXPECT_THAT(by_word.only("b").at("kind").type.words, ElementsAre("b"));
}

struct Piece {
  double part = 0.5, turn = pi / 6;
  std::optional<double> depth_mm = {};
  bool is_red = false;
  int count = 3;
  std::array<double, 2> range = {1, 2};
};
struct Owner {
  double weight = 7;
};

const KeyTable& bound_keys() {
  static const KeyTable inner(
      {{"depth_mm", &Piece::depth_mm, value::length(from_to(0.01, 2, "mm (0.01 to 2 cells)")), "a length"}});
  static const KeyTable keys({
      {"part", &Piece::part, value::number({0, 1, false, true}), "a part"},
      {"turn_deg", &Piece::turn, value::angle(between(-90, 90, "degrees")), "an angle"},
      {"is_red", &Piece::is_red, value::boolean(), "a truth"},
      {"count", &Piece::count, value::integer(1, 9), "a number of things"},
      {"range", &Piece::range, value::range({}), "a range"},
      {"weight", &Owner::weight, value::number(), needed_as("a weight"), "of another object"},
      {"inner", inner, "a section"},
  });
  return keys;
}

Section bound(const std::string& text) { return {parse_document(text, "in.yaml"), bound_keys()}; }

TEST(BoundKeys, FillTheMembersOfTheirObjectAlsoInSections) {
  Piece piece;
  bound("{part: 0.25, turn_deg: 45, is_red: true, count: 4, range: [3, 4], inner: {depth_mm: 20}}")
      .read_into(piece, 10);
  EXPECT_EQ(piece.part, 0.25);
  EXPECT_DOUBLE_EQ(piece.turn, pi / 4);
  EXPECT_EQ(piece.depth_mm, 20);
  EXPECT_TRUE(piece.is_red);
  EXPECT_EQ(piece.count, 4);
  EXPECT_THAT(piece.range, ElementsAre(3, 4));
}

TEST(BoundKeys, AreCheckedByTheirTable) {
  Piece piece;
  Owner owner;
  EXPECT_THAT(refusal([&] { bound("part: 2\n").read_into(piece); }), HasSubstr("part"));
  EXPECT_THAT(refusal([&] { bound("inner: {depth_mm: 21}\n").read_into(piece, 10); }), HasSubstr("depth_mm"));
  EXPECT_THAT(refusal([&] { bound("part: 1\n").read_into(owner); }), HasSubstr("a weight"));
}

TEST(BoundKeys, SayTheMembersOfANewObjectAsDefaults) {
  EXPECT_EQ(bound_keys().at("part").fallback.text, "0.5");
  EXPECT_EQ(bound_keys().at("turn_deg").fallback.text, "30");
  EXPECT_EQ(bound_keys().at("is_red").fallback.text, "false");
  EXPECT_EQ(bound_keys().at("count").fallback.text, "3");
  EXPECT_EQ(bound_keys().at("range").fallback.text, "[1, 2]");
}

TEST(BoundKeys, WriteWhatDiffersAndWhatIsNeeded) {
  static const KeyTable keys({{"part", &Piece::part, value::number(), "a part"},
                              {"turn_deg", &Piece::turn, value::angle({}), "an angle"},
                              {"weight", &Owner::weight, value::number(), needed, "of another object"}});
  EXPECT_EQ(keys.text(Piece{}), "");
  EXPECT_EQ(keys.text(Piece{.part = 0.25, .turn = pi / 4}), "part: 0.25, turn_deg: 45");
  EXPECT_EQ(keys.text(Piece{}, Piece{.part = 1}), "part: 0.5");
  EXPECT_EQ(keys.text(Owner{}), "weight: 7");
}

}  // namespace
}  // namespace kinetix::targets
