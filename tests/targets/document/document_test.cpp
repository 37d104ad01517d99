#include "targets/document/document.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <random>
#include <regex>

#include "model/lattice/square/structure.hpp"
#include "targets/document/wording.hpp"
#include "tests/support/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"

namespace kinetix::targets {
namespace {

using testing::BadInput;
using testing::expect_refused;
using ::testing::HasSubstr;
using testing::refusal;
using testing::TemporaryFolder;

Node parse(const std::string& text) { return parse_document(text, "in.yaml"); }

TEST(Document, KeepsOrderKindsAndPlaces) {
  const Node root = parse("b: 1\na:\n  - x\n  - {k: [2, 3]}\n");
  EXPECT_EQ(root.kind(), Node::Kind::map);
  EXPECT_EQ(root.required("b", "").integer(0, 9), 1);
  const auto list = root.required("a", "").list("");
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].text(""), "x");
  const Place place = list[1].required("k", "").list("")[1].place();
  EXPECT_EQ(place.key, "a[1].k[1]");
  EXPECT_EQ(place.line, 4);
  EXPECT_EQ(place.column, 13);
}

TEST(Document, OutlivesTheRootHandle) {
  const Node leaf = parse("a: {b: 7}").required("a", "").required("b", "");
  EXPECT_EQ(leaf.integer(0, 9), 7);
}

TEST(Document, CountsColumnsInCharactersNotBytes) {
  const Node root = parse("{äöü: é, b: 1}");
  EXPECT_EQ(root.required("b", "").place().column, 13);
}

TEST(Document, ToleratesCrlfByteOrderMarkDirectivesAndJson) {
  TemporaryFolder folder;
  const auto file =
      folder.write("a.yaml", "\xEF\xBB\xBF%YAML 1.2\r\n---\r\na: 1\r\nb: [2,\r\n  3]\r\n...\r\n");
  const Node root = read_document(file);
  EXPECT_EQ(root.required("a", "").integer(0, 9), 1);
  EXPECT_EQ(root.required("b", "").list("")[1].integer(0, 9), 3);
  EXPECT_EQ(parse(R"({"a": {"b": [1, 2.5]}})").required("a", "").required("b", "").list("")[1].number(), 2.5);
}

TEST(Document, RefusesWhatConfigurationDoesNotNeed) {
  const std::vector<BadInput> cases = {
      {"a: &x 1\n", 1, 4, "a", {"anchors", "not allowed"}},
      {"&x a: 1\n", 1, 1, "", {"anchors", "not allowed"}},
      {"a: *x\n", 1, 4, "a", {"aliases", "not allowed"}},
      {"a: &a [*a, *a]\n", 1, 4, "a", {"anchors"}},
      {"a: &a {b: *a}\n", 1, 4, "a", {"anchors"}},
      {"a: !!str 1\n", 1, 4, "a", {"tags", "not allowed"}},
      {"a: !mine {b: 1}\n", 1, 4, "a", {"tags"}},
      {"a: 1\nb: 2\na: 3\n", 3, 1, "a", {"twice", "line 1"}},
      {"a: {b: 1, c: 2, b: 3}\n", 1, 17, "a.b", {"twice"}},
      {"a: 1\n\"a\": 2\n", 2, 1, "a", {"twice"}},
      {"? [1, 2]\n: 3\n", 1, 3, "", {"Give plain words as keys"}},
      {"a: {{b: 1}: 2}\n", 1, 5, "a", {"Give plain words as keys"}},
      {"a: {kind: curve\n", 2, 1, "a", {"`}`", "missing"}},
      {"{a: {b: 1}\n", 1, 1, "", {"closing bracket"}},
      {": 1\n", 1, 1, "", {"key is missing"}},
      {"a: 1\n---\nb: 2\n", 2, 1, "", {"second document"}},
      {"{a: 1}\nb: 2\n", 2, 1, "", {"after the end"}},
      {"a: 1\nb:2\n", 2, 1, "", {"space after the colon"}},
      {"a:\n\tb: 1\n", 2, 3, "", {"tab", "indentation"}},
      {"a: [1, 2\nb: 3", 2, 2, "a", {"`]`"}},
      {"a: [1]]\n", 1, 7, "", {"closes nothing"}},
      {"a: 'b\nc: 1\n", 3, 1, "a", {"closing quote"}},
      {"a: \"b", 2, 1, "a", {"closing quote"}},
      {"", 0, 0, "", {"no values"}},
      {"# only a comment\n", 0, 0, "", {"no values"}},
      {std::string(200, 'k') + ": 1\n", 1, 1, "", {"too long", "100"}},
  };
  for (const BadInput& bad : cases) expect_refused(bad, "in.yaml", [&] { parse(bad.text); });
}

TEST(Document, RefusesAnAliasBombWithoutExpandingIt) {
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x]\n";
  for (int k = 1; k < 100; ++k) {
    const std::string previous = "*a" + std::to_string(k - 1);
    bomb += "a" + std::to_string(k) + ": &a" + std::to_string(k) + " [" + previous;
    for (int n = 0; n < 8; ++n) bomb += ", " + previous;
    bomb += "]\n";
  }
  expect_refused({bomb, 1, 5, "a0", {"anchors"}}, "in.yaml", [&] { parse(bomb); });
}

TEST(Document, AllowsNestingOf64AndRefuses65) {
  const auto nested = [](int depth) { return std::string(depth, '[') + "1" + std::string(depth, ']'); };
  EXPECT_NO_THROW(parse(nested(64)));
  EXPECT_THAT(refusal([&] { parse(nested(65)); }), HasSubstr("at most 64 levels"));
  EXPECT_THAT(refusal([&] { parse(std::string(100'000, '[')); }), HasSubstr("in.yaml:1:"));
  EXPECT_THAT(refusal([&] {
                std::string deep;
                for (int k = 0; k < 100; ++k) deep += "- ";
                parse(deep);
              }),
              HasSubstr("at most 64 levels"));
}

TEST(Document, ReadsTheLargestAllowedFilesOfAnyShapeInReasonableTime) {
  const auto filled = [](const std::string& unit) {
    std::string text = "[";
    while (text.size() + unit.size() + 2 < max_document_bytes) text += unit;
    return text + "1]";
  };
  EXPECT_NO_THROW(parse(filled("1,")));
  EXPECT_NO_THROW(parse(filled("\xC3\xA9,")));
  EXPECT_NO_THROW(parse(filled("{a: },")));
}

TEST(Document, NamesTheFileThatCannotBeRead) {
  TemporaryFolder folder;
  const auto says = [&](const std::string& file) {
    const std::string message = refusal([&] { read_document(file); });
    EXPECT_THAT(message, ::testing::StartsWith(file + ": ")) << message;
    return message;
  };
  EXPECT_THAT(says(folder.path("none.yaml")), HasSubstr("no such file"));
  EXPECT_THAT(says(folder.path("")), HasSubstr("folder"));
  EXPECT_THAT(says("/dev/zero"), HasSubstr("device"));
  mkfifo(folder.path("fifo").c_str(), 0600);
  EXPECT_THAT(says(folder.path("fifo")), HasSubstr("pipe"));
  EXPECT_THAT(says(folder.write("x.yaml", "a: 1") + "/y.yaml"), HasSubstr("no such file"));
  EXPECT_THAT(says(folder.path(std::string(300, 'n'))), HasSubstr("cannot be read"));
}

TEST(Document, RefusesAHundredMegabytesBeforeReadingThem) {
  TemporaryFolder folder;
  const auto file = folder.write("big.yaml", "a: 1\n");
  std::filesystem::resize_file(file, 100 << 20);
  EXPECT_EQ(refusal([&] { read_document(file); }),
            file + ": is too large: 100 MiB; at most 1 MiB are allowed");
}

TEST(Document, RefusesBytesThatAreNotPlainText) {
  TemporaryFolder folder;
  const std::vector<BadInput> cases = {
      {"a: 1\nb: caf\xE9\n", 2, 7, "", {"UTF-8"}},
      {"a: \xC0\xAF\n", 1, 4, "", {"UTF-8"}},
      {"a: \xED\xA0\x80\n", 1, 4, "", {"UTF-8"}},
      {"\xFF\xFE"
       "a",
       1,
       1,
       "",
       {"UTF-8"}},
      {std::string("a: x\0y\n", 7), 1, 5, "", {"control character"}},
      {"a: \x04", 1, 4, "", {"control character"}},
      {"a: \xE2\x82", 1, 4, "", {"UTF-8"}},
  };
  for (const BadInput& bad : cases) {
    const auto file = folder.write("bad.yaml", bad.text);
    expect_refused(bad, file, [&] { read_document(file); });
  }
}

TEST(Node, ConvertsScalarsThatAreAllowed) {
  const auto value = [](const std::string& text) { return parse("v: " + text).required("v", ""); };
  EXPECT_EQ(value("-1.5e-3").number(), -1.5e-3);
  EXPECT_EQ(value("+2").number(), 2);
  EXPECT_EQ(value(".5").number(), .5);
  EXPECT_EQ(value("5.").number(), 5);
  EXPECT_EQ(value("1e3").number(above(0)), 1000);
  EXPECT_EQ(value("-7").integer(-10, 10), -7);
  EXPECT_TRUE(value("true").boolean());
  EXPECT_EQ(value("'40'").text(""), "40");
  EXPECT_DOUBLE_EQ(value("90").angle({}), pi / 2);
  EXPECT_EQ(value("[1, 2]").range({}), (std::array<double, 2>{1, 2}));
  EXPECT_DOUBLE_EQ(value("[-180, 60]").angle_range({})[1], pi / 3);
  EXPECT_EQ(value("bb").one_of({"a", "bb"}), 1);
}

TEST(Node, SaysWhereAndWhatIsAllowedForABadNumber) {
  const Bounds length = above(0, "mm");
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
      {"8 mm", {"`8 mm` has a unit", "a number above 0, in mm"}},
      {"8cm", {"has a unit", "in mm", "without writing the unit"}},
      {"0.5rad", {"has a unit"}},
      {"3\"", {"has a unit"}},
      {"0,8", {"decimal comma"}},
      {"\"8\"", {"quotes", "a number above 0"}},
      {"eight", {"`eight` is not a number"}},
      {"1/2", {"is not a number"}},
      {"0x10", {"is not a number"}},
      {"--1", {"is not a number"}},
      {"+-1", {"is not a number"}},
      {".nan", {"not a finite number"}},
      {"-.inf", {"not a finite number"}},
      {"NaN", {"not a finite number"}},
      {"inf", {"not a finite number"}},
      {"1e999", {"too large for a number"}},
      {"0", {"out of range", "above 0"}},
      {"-3", {"out of range"}},
      {"true", {"is not a number"}},
      {"[1]", {"is a list", "a number above 0, in mm"}},
      {"{a: 1}", {"is a map of keys"}},
  };
  for (const auto& [text, says] : cases)
    expect_refused({"v: " + text + "\n", 1, 4, "v", says}, "in.yaml",
                   [&] { parse("v: " + text + "\n").required("v", "").number(length); });
  expect_refused({"v:\n", 1, 1, "v", {"is empty", "above 0"}}, "in.yaml",
                 [&] { parse("v:\n").required("v", "").number(length); });
}

TEST(Node, IsStrictAboutIntegersBooleansTextAndRanges) {
  const auto expect = [](const std::string& text, std::vector<std::string> says, auto get) {
    expect_refused({"v: " + text + "\n", 1, 4, "v", std::move(says)}, "in.yaml",
                   [&] { get(parse("v: " + text + "\n").required("v", "")); });
  };
  const auto integer = [](const Node& n) { n.integer(1, 64); };
  for (const char* text : {"2.0", "1e1", "two", "0x2", "3 mm"})
    expect(text, {"not a whole number", "from 1 to 64"}, integer);
  for (const char* text : {"0", "65", "99999999999999999999"})
    expect(text, {"out of range", "from 1 to 64"}, integer);
  for (const char* text : {"yes", "True", "1", "off"})
    expect(text, {"true or false"}, [](const Node& n) { n.boolean(); });
  expect("\"true\"", {"quotes", "true or false"}, [](const Node& n) { n.boolean(); });
  expect("\"a\\0b\"", {"control character"}, [](const Node& n) { n.text("a name"); });
  expect("''", {"is empty", "a name"}, [](const Node& n) { n.text("a name"); });
  const auto range = [](const Node& n) { n.angle_range(from_to(-89, 89, "degrees")); };
  expect("[3, 1]", {"reversed", "3 is above 1"}, range);
  expect("[3, 3]", {"are equal"}, range);
  expect("[1, 2, 3]", {"has 3 entries", "[lower, upper]", "from -89 to 89, in degrees"}, range);
  expect("3", {"is a single value", "[lower, upper]"}, range);
  const auto colour = [](const Node& n) { n.one_of({"red", "green"}); };
  expect("gren", {"did you mean `green`?", "allowed: red, green"}, colour);
  expect("violet", {"`violet` is not known; allowed"}, colour);
}

TEST(Node, SuggestsTheNearestKeyAndListsAllowedOnes) {
  const auto check = [](const std::string& text) {
    parse(text).reject_unknown_keys({"theta_deg", "beta", "cells"});
  };
  EXPECT_NO_THROW(check("{beta: 1}"));
  const auto says = [&](const std::string& text) { return refusal([&] { check(text); }); };
  EXPECT_EQ(says("bata: 1\n"),
            "in.yaml:1:1: bata: unknown key (did you mean `beta`?); allowed: theta_deg, beta, cells");
  EXPECT_THAT(says("beta: 1\ntheta: 1\n"),
              HasSubstr("in.yaml:2:1: theta: unknown key (did you mean `theta_deg`?)"));
  EXPECT_THAT(says("Cells: 1\n"), HasSubstr("did you mean `cells`?"));
  EXPECT_THAT(says("{beta: 0,4}\n"), HasSubstr("in.yaml:1:10: 4: a number is in the place of a key"));
  EXPECT_THAT(says("x: 1\n"), HasSubstr("unknown key; allowed"));
  EXPECT_THAT(says("colour: 1\n"), HasSubstr("unknown key; allowed"));
  EXPECT_THAT(says("- 1\n"), HasSubstr("is a list. Give a map of keys (theta_deg, beta, cells)"));
}

// PyYAML and other readers of YAML 1.1 took 1e+05 for a text.
TEST(ShortestText, IsANumberForReadersOfYaml11) {
  const std::regex yaml11(
      "[-+]?([0-9][0-9_]*)?\\.[0-9_]*([eE][-+][0-9]+)?|[-+]?(0|[1-9][0-9_]*)");  // yaml.org/type/float.html, int.html
  for (const double x : {1e5, -3e7, 1e-5, 2.5e-9, 1e300, 5e-324, 0.1, 0.0, 12.0, 123456.789, 1e22}) {
    EXPECT_TRUE(std::regex_match(shortest_text(x), yaml11)) << shortest_text(x);
    EXPECT_EQ(parse_number(shortest_text(x)), x);
  }
  for (const double degrees : {1e-5, 3e-17, 1e5, 360.0})
    EXPECT_TRUE(std::regex_match(degrees_text(radians_of(degrees)), yaml11))
        << degrees_text(radians_of(degrees));
}

TEST(Degrees, SurviveTextBitForBit) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> angle(-pi, pi);
  for (int k = 0; k < 20'000; ++k) {
    const double x = k % 2 ? angle(random) : std::ldexp(angle(random), -k % 60);
    EXPECT_EQ(parse_degrees(degrees_text(x), {}), x);
  }
}

TEST(Degrees, KeepTheTextThatAPersonWrote) {
  for (const char* text : {"0", "30", "54.7356", "-60", "89.9", "0.001", "12.3456789012"})
    EXPECT_EQ(degrees_text(parse_degrees(text, {})), text);
}

/// Walks every value through every getter.
void visit(const Node& node) {
  const auto attempt = [](auto f) {
    try {
      f();
    } catch (const InvalidInput& e) {
      EXPECT_GT(e.place().line, 0) << e.what();
    }
  };
  attempt([&] { node.number(above(0, "mm")); });
  attempt([&] { node.angle(from_to(-89, 89, "degrees")); });
  attempt([&] { node.integer(0, 100); });
  attempt([&] { node.boolean(); });
  attempt([&] { node.text("text"); });
  attempt([&] { node.one_of({"curve", "display"}); });
  attempt([&] { node.range({}); });
  attempt([&] { node.reject_unknown_keys({"target", "points"}); });
  attempt([&] { node.optional("target"); });
  attempt([&] {
    for (const Node& child : node.list("a list")) visit(child);
  });
}

TEST(Document, SurvivesRandomMutationsOfAValidText) {
  const std::string valid =
      "kinetix: 1\nname: rib\ntarget:\n  kind: curve\n  points: [[0, 0], [10, 2.5], [20, -1e-3]]\n"
      "variables: {beta: {range_deg: [-60, 60], per: \"column\"}, theta: {range_deg: [2, 44]}}\n"
      "list:\n  - a\n  - 'b'\n  - |\n    text\n";
  const std::string special = "{}[]:,-?&*!|>'\"%@`#~ \n\t\r\\0aé<";
  std::mt19937 random(20240611);
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  int accepted = 0;
  for (int round = 0; round < 6000; ++round) {
    std::string text = valid;
    for (std::size_t n = 1 + below(6); n > 0 && !text.empty(); --n) {
      const std::size_t at = below(text.size());
      if (below(3) == 0)
        text.erase(at, 1 + below(4));
      else if (below(2) == 0)
        text.insert(at, 1, special[below(special.size())]);
      else
        text[at] = static_cast<char>(below(4) == 0 ? below(256) : special[below(special.size())]);
    }
    try {
      visit(parse(text));
      ++accepted;
    } catch (const InvalidInput&) {
    }
  }
  EXPECT_GT(accepted, 100);
}

TEST(Wording, CountsOneThingInTheSingular) {
  EXPECT_EQ(counted(1, "factor"), "1 factor");
  EXPECT_EQ(counted(0, "response"), "0 responses");
  EXPECT_EQ(counted(97, "sample"), "97 samples");
}

TEST(Bounds, HaveFewDigitsWithinWhatTheyAllow) {
  const double edge_mm = 9.066687;
  EXPECT_EQ(from_to(1e-6 * edge_mm, 0.5 * edge_mm, "mm").describe(),
            "a number from 0.000009067 to 4.533, in mm");
  EXPECT_EQ(between(0, 0.7 * 3).describe(), "a number above 0 and below 2.1");
  EXPECT_EQ(at_least(0.123456).describe(), "a number of at least 0.123456");
}

}  // namespace
}  // namespace kinetix::targets
