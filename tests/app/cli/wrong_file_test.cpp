#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/program.hpp"

namespace kinetix::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string shapes = KINETIX_SOURCE "/targets/shapes/";

/// Returns the lines of YAML in a message: the indented ones.
std::string yaml_in(const std::string& message) {
  std::string yaml;
  std::istringstream lines(message);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("  ")) yaml += line.substr(2) + "\n";
  return yaml;
}

/// Checks that the program refuses a file and prints the YAML that uses it, which is a valid file next to it.
void expect_useful_yaml(const Scratch& scratch, const std::string& name, const std::string& key) {
  const std::string file = scratch / name, yaml_file = scratch / (fs::path(name).stem().string() + ".yaml");
  for (const char* command : {"", "check ", "view --no-open ", "simulate ", "sweep "}) {
    const Outcome run = kinetix_opt(command + ("'" + file + "'"));
    EXPECT_EQ(run.code, 2) << command << name;
    EXPECT_THAT(run.err, AllOf(HasSubstr("not a YAML file"), HasSubstr("Save these lines as " + yaml_file)));
  }
  const std::string yaml = yaml_in(kinetix_opt("'" + file + "'").err);
  EXPECT_EQ(std::count(yaml.begin(), yaml.end(), '\n'), 4) << yaml;
  EXPECT_THAT(yaml, HasSubstr(key));
  std::ofstream(yaml_file) << yaml;
  const Outcome checked = kinetix_opt("check '" + yaml_file + "' --quiet");
  EXPECT_EQ(checked.code, 0) << yaml << checked.err;
}

TEST(WrongFile, IsAnsweredByTheYamlThatUsesIt) {
  const std::pair<const char*, const char*> files[] = {
      {"helmet_rib.csv", "kind: curve"}, {"disc.csv", "kind: outline"}, {"helix.csv", "kind: space_curve"},
      {"headform.obj", "kind: helmet"},  {"rosette.dxf", "drawing:"},   {"miura.fold", "origami:"}};
  for (const auto& [name, key] : files) {
    const Scratch scratch;
    fs::copy(shapes + name, scratch / name);
    expect_useful_yaml(scratch, name, key);
  }
}

TEST(WrongFile, MayBeAPictureOrADrawing) {
  const Scratch scratch;
  std::string bar = "P1 12 12\n";
  for (int row = 0; row < 12; ++row) bar += "0 0 0 0 1 1 1 1 0 0 0 0\n";
  scratch.write("my logo.pbm", bar);
  expect_useful_yaml(scratch, "my logo.pbm", "image: \"my logo.pbm\"");
  scratch.write(
      "walls.SVG",
      "<svg xmlns='http://www.w3.org/2000/svg' width='20mm' height='10mm' viewBox='0 0 20 10'>"
      "<path d='M0 0 L10 0 L20 0 L20 10 L10 10 L0 10 Z'/><line x1='10' y1='0' x2='10' y2='10'/></svg>");
  expect_useful_yaml(scratch, "walls.SVG", "drawing: walls.SVG");
}

TEST(WrongFile, MayBeACreasePattern) {
  const std::string patterns = KINETIX_SOURCE "/tests/fuzz/corpus/creases/";
  for (const char* name : {"miura.cp", "miura.svg"}) {
    const Scratch scratch;
    fs::copy(patterns + name, scratch / name);
    expect_useful_yaml(scratch, name, "origami: ");
  }
}

TEST(WrongFile, MayNeedAnotherFormatOrCommand) {
  const Scratch scratch;
  EXPECT_THAT(kinetix_opt(scratch.write("logo.gif", "")).err,
              AllOf(HasSubstr("Convert it to "), HasSubstr("\n    image: logo.png\n")));
  EXPECT_THAT(kinetix_opt(scratch.write("part.step", "")).err, HasSubstr("Run `kinetix-opt import "));
}

TEST(WrongFile, IsOneMessageInJson) {
  const Scratch scratch;
  const std::string file = scratch / "disc.csv";
  fs::copy(shapes + "disc.csv", file);
  const Outcome run = kinetix_opt(file + " --json");
  EXPECT_EQ(run.code, 2);
  const nlohmann::json error = nlohmann::json::parse(run.out)["error"];
  EXPECT_EQ(error["file"], file);
  EXPECT_EQ(error["message"].get<std::string>() + "\n", run.err);
}

}  // namespace
}  // namespace kinetix::testing
