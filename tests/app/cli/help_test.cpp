#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

#include "app/goals/registry.hpp"
#include "tests/app/program.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr std::size_t widest_line = 80;  // characters: of help without a terminal

const char* const commands[] = {"", "verify", "simulate", "sweep", "check", "export", "import", "view"};

std::string help_of(const std::string& command) { return kinetix_opt(command + " --help").out; }

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::set<std::string> options_in(const std::string& text) {
  static const std::regex option("(^|[ ,])(--[a-z-]+|-[a-z])(?=[ ,\n]|$)");
  std::set<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), option), end; at != end; ++at)
    found.insert((*at)[2].str());
  return found;
}

/// Returns the examples in a help text.
std::vector<std::string> examples_in(const std::string& help) {
  std::vector<std::string> examples;
  for (const std::string& line : split_lines(help))
    if (line.starts_with("  kinetix-opt ")) examples.push_back(line);
  return examples;
}

TEST(Help, FitsIntoEightyColumns) {
  for (const char* command : commands)
    for (const std::string& line : split_lines(help_of(command)))
      EXPECT_LE(line.size(), widest_line) << command << ": " << line;
}

TEST(Help, HasTwoExamplesPerCommandWithOptionsThatExist) {
  for (const std::string command : commands) {
    const std::string help = help_of(command);
    const std::vector<std::string> examples = examples_in(help);
    EXPECT_THAT(examples, SizeIs(2)) << command;
    const std::set<std::string> known = options_in(help.substr(0, help.find("examples:")));
    for (const std::string& example : examples) {
      if (!command.empty()) {
        EXPECT_THAT(example, HasSubstr("kinetix-opt " + command));
      }
      for (const std::string& option : options_in(example))
        EXPECT_TRUE(known.contains(option)) << example << ": " << option;
    }
  }
}

TEST(Help, NamesUnitsAndNoRangesInPlaceholders) {
  const std::string help = help_of("export");
  EXPECT_THAT(help, HasSubstr("--clearance MM "));
  EXPECT_THAT(help, HasSubstr("--bed MM,MM "));
  EXPECT_THAT(help_of(""), HasSubstr("--time-limit SECONDS"));
  for (const char* command : commands)
    EXPECT_EQ(help_of(command).find("FLOAT"), std::string::npos) << command;
}

TEST(Help, NamesTheKindsOfGoalsAlsoWithoutArguments) {
  const Outcome alone = kinetix_opt("");
  EXPECT_EQ(alone.code, 2);
  EXPECT_EQ(alone.out, "");
  for (const app::GoalKind* kind : app::goal_kinds()) {
    EXPECT_NE(kind->meaning, "") << kind->name;
    for (const std::string& text : {help_of(""), alone.err})
      EXPECT_THAT(text, HasSubstr("  " + std::string(kind->name) + " "));
  }
}

TEST(Help, KeepsEarlierNamesOfOptions) {
  const Scratch scratch;
  const std::string design = scratch.write("d.yaml", "kinetix: 1\nstructure: {cells: [4, 1]}\n");
  for (const std::string option : {"--fold-angle-deg 10", "--theta-deg 10"})
    EXPECT_EQ(kinetix_opt("simulate " + design + " " + option + " --quiet -o " +
                          std::string(scratch / option.substr(2, 4)))
                  .code,
              0)
        << option;
  EXPECT_EQ(text_of(scratch / "fold/design.yaml"), text_of(scratch / "thet/design.yaml"));
}

}  // namespace
}  // namespace kinetix::testing
