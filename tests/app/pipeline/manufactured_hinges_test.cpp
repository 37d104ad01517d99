#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "model/base/geometry.hpp"
#include "model/material/manufactured_hinge.hpp"
#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"

/// Tests of designs with manufactured hinges, from the file to the result.
namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

std::string design_with(const std::string& hinge, const std::string& of_walls = "[]", double theta_deg = 20) {
  return "kinetix: 1\nname: made\nstructure: {cells: [4, 3], cell_mm: 10}\ndesign:\n  theta_deg: " +
         std::to_string(theta_deg) + "\n  hinges: " + of_walls + "\nhinge: {" + hinge + "}\n";
}

struct Simulated {
  Json result;
  std::string out, design;
};

Simulated verified_design(const std::string& text, int code = 0) {
  const Scratch scratch;
  const std::string file = scratch.write("made.yaml", text);
  const Outcome run = kinetix_opt("verify " + file + " --quiet -o " + (scratch / "out").string());
  EXPECT_EQ(run.code, code) << run.out << run.err;
  const Simulated s{Json::parse(text_of(scratch / "out/result.json")), run.out,
                    text_of(scratch / "out/design.yaml")};
  EXPECT_EQ(schema_errors(s.result), "");
  return s;
}

model::HingeStiffness k_of(const Json& result, std::size_t hinge) {
  const Json& k = result["structure"]["hinges"][hinge]["k"];
  model::HingeStiffness out{k["axial"], k["shear"], k["along"], k["turn"]};
  if (k.contains("rock")) out.rock = k["rock"].get<double>();
  if (k.contains("twist")) out.twist = k["twist"].get<double>();
  return out;
}

/// The walls of a basic panel between plates turn by 2 theta, so each spring stores 2 k_turn theta^2.
TEST(MadeHinges, FoldAPanelWithTheStiffnessOfTheirShape) {
  const model::ManufacturedHinge block{.kind = model::HingeKind::block,
                                       .material = *model::find_material("tango"),
                                       .gap_mm = 1,
                                       .thickness_mm = 1,
                                       .height_mm = 6};
  const Simulated s = verified_design(design_with("kind: block, material: tango, gap_mm: 1"));
  const model::HingeStiffness k = stiffness(block);
  EXPECT_EQ(k_of(s.result, 0), k);
  EXPECT_DOUBLE_EQ(s.result["structure"]["hinges"][0]["reach_mm"], std::sqrt(3.0));
  EXPECT_LE(s.result["metrics"]["verify_rms"], 1e-4);
  const double theta = 20 * radians_per_degree, springs = 31 * 2 * k.turn * theta * theta;
  EXPECT_NEAR(s.result["metrics"]["energy_Nmm"], springs, 0.1 * springs);
  // The strain is that of bending. The plates' pull on the blocks adds at most as much again.
  EXPECT_GE(s.result["metrics"]["strain_max"], strain(block, 2 * theta) - 0.02);
  EXPECT_LE(s.result["metrics"]["strain_max"], 2 * strain(block, 2 * theta));
  EXPECT_THAT(s.out, Not(HasSubstr("is strained by")));
}

TEST(MadeHinges, OfEveryKindAgreeWithThePhysicsRun) {
  for (const char* hinge : {"kind: film, material: pp, gap_mm: 3, thickness_mm: 0.4",
                            "kind: pin, diameter_mm: 2, clearance_mm: 0.2",
                            "kind: pin, diameter_mm: 1, clearance_mm: 0.1, play: true",
                            "k: {axial: 6.7, shear: 1.1, along: 1.6, turn: 0.33}, reach_mm: 1.73",
                            "k: {axial: 6.7, shear: 1.1, along: 1.6, turn: 0.33, rock: 18, twist: 5}"}) {
    SCOPED_TRACE(hinge);
    const Simulated s = verified_design(design_with(hinge));
    EXPECT_TRUE(s.result["metrics"]["verified"]);
    EXPECT_TRUE(s.result["structure"]["hinges"][0].contains("k"));
  }
}

TEST(MadeHinges, OfSingleWallsAreWrittenBesideTheOthers) {
  const std::string film = "{kind: film, material: pp, gap_mm: 3, thickness_mm: 0.4}";
  const Simulated s = verified_design(
      design_with("kind: pin, diameter_mm: 2", "[{wall: [[0, 0], [1, 0]], hinge: " + film + "}]"));
  EXPECT_THAT(s.design, HasSubstr("kind: film, material: pp, gap_mm: 3"));
  std::vector<double> turns;
  for (const Json& hinge : s.result["structure"]["hinges"]) turns.push_back(hinge["k"]["turn"]);
  EXPECT_EQ(std::count(turns.begin(), turns.end(), 0.1), static_cast<long>(turns.size()) - 1);
  EXPECT_NEAR(turns[0], 16.05, 0.01);
}

/// The contact stiffness of walls depends on the hinges that they have, not on a section that no wall uses.
TEST(MadeHinges, OfAllWallsLeaveNothingOfWhatOthersWouldBe) {
  const std::string block = "kind: block, material: tango, gap_mm: 2, thickness_mm: 1.5",
                    film = "kind: film, material: pp, gap_mm: 3, thickness_mm: 0.4";
  std::string walls;
  for (const char* wall : {"[[0, 0], [1, 0]]", "[[0, 1], [1, 1]]", "[[0, 0], [0, 1]]", "[[1, 0], [1, 1]]"})
    walls += "    - {wall: " + std::string(wall) + ", hinge: {" + block + "}}\n";
  const auto closed = [&](const std::string& others) {
    const Scratch scratch;
    const std::string file = scratch.write(
        "cell.yaml",
        "kinetix: 1\nstructure: {cells: [1, 1], cell_mm: 20, wall_mm: {thickness: 2.2, height: 12}}\n"
        "drive: {kind: plates, axis: y, compression: 0.45}\ndesign:\n  hinges:\n" +
            walls + "hinge: {" + others + "}\n");
    const Outcome run = kinetix_opt("simulate " + file + " --model equilibrium --json --quiet -o " +
                                    (scratch / "out").string());
    const Json result = Json::parse(run.out);
    EXPECT_EQ(false_flags(result), "reaches") << "pressed so far that tango tears: " << run.err;
    return result;
  };
  const Json by_block = closed(block), by_film = closed(film);
  for (const char* key : {"k_point", "k_contact"})
    EXPECT_EQ(by_film["equilibrium"]["stiffness"][key], by_block["equilibrium"]["stiffness"][key]) << key;
  const double energy = by_block["metrics"]["energy_Nmm"];
  EXPECT_NEAR(by_film["metrics"]["energy_Nmm"], energy, 1e-6 * energy) << "their walls touch";
}

TEST(MadeHinges, SayWhatTheyCannotBear) {
  const Simulated s =
      verified_design(design_with("kind: film, material: pa12, gap_mm: 1, thickness_mm: 0.4", "[]", 30), 3);
  EXPECT_THAT(s.out, HasSubstr("\n  error:     the hinge of wall "));
  EXPECT_EQ(s.result["verdict"]["reaches"], false);
  EXPECT_THAT(s.out, HasSubstr("the limit of its material is 0.04"));
  EXPECT_THAT(s.out, HasSubstr("in the hinges, limit of their material 0.04"));
  EXPECT_EQ(s.result["metrics"]["strain_allowed"], 0.04);
  EXPECT_EQ(s.result["made_problems"][0]["kind"], "strained");
  const Simulated corners =
      verified_design(design_with("kind: film, material: tango, gap_mm: 0.4, thickness_mm: 0.1", "[]", 30));
  EXPECT_THAT(corners.out, HasSubstr("\n  warning:   the two halves of wall "));
  EXPECT_THAT(corners.out, HasSubstr("43.6 deg"));  // 2 atan(0.4 / 1)
}

/// The block of rubber-like plastic turns far within its limit. The film next to it has a smaller strain but is nearer
/// to its limit.
TEST(MadeHinges, AreStrainedBesideWhatTheirOwnMaterialBears) {
  const std::string film = "{kind: film, material: pa12, gap_mm: 3, thickness_mm: 0.4}";
  const Simulated s = verified_design(design_with("kind: block, material: tpu95a, gap_mm: 1.5",
                                                  "[{wall: [[0, 0], [1, 0]], hinge: " + film + "}]"),
                                      3);
  const model::ManufacturedHinge made{.kind = model::HingeKind::film,
                                      .material = *model::find_material("pa12"),
                                      .gap_mm = 3,
                                      .thickness_mm = 0.4,
                                      .height_mm = 6};
  EXPECT_EQ(s.result["metrics"]["strain_allowed"], 0.04);
  // The walls of the film turn against each other by 2 theta, 40 deg, or a little less.
  EXPECT_NEAR(s.result["metrics"]["strain_max"], strain(made, 40 * radians_per_degree), 0.01);
  const Json& verdict = s.result["verdict"];
  EXPECT_EQ(verdict["reaches"], false);
  EXPECT_EQ(verdict["agrees"], true);
  EXPECT_EQ(verdict["problems"].size(), 1u) << "its strain alone";
  EXPECT_THAT(verdict["problems"][0]["text"].get<std::string>(),
              HasSubstr("the limit of its material is 0.04"));
}

TEST(MadeHinges, MayBeOffTheirWall) {
  const std::string off =
      "[{wall: [[0, 1], [1, 1]], offset_mm: 0.3}, {wall: [[0, 0], [1, 0]], offset_mm: 0.4}]";
  const auto checked = [&](const std::string& hinge) {
    const Scratch scratch;
    return kinetix_opt("check " + scratch.write("off.yaml", design_with(hinge, off, 5)));
  };
  EXPECT_EQ(checked("kind: film, material: tango, gap_mm: 2, thickness_mm: 0.3").code, 0);
  EXPECT_EQ(checked("kind: pin, diameter_mm: 1").code, 0);
  EXPECT_THAT(checked("kind: film, material: tango, gap_mm: 2, thickness_mm: 0.2, caps: true").err,
              HasSubstr("hinge.caps: only applies to pins"));
}

TEST(MadeHinges, OfOutlinesAreRefusedTooFarOffTheirWall) {
  const Scratch scratch;
  const auto checked = [&](const std::string& offset) {
    return kinetix_opt(
        "check " +
        scratch.write("disc.yaml",
                      "kinetix: 1\ntarget: {kind: outline, points: [[20, 0], [0, 20], [-20, 0], [0, -20]]}\n"
                      "structure: {cells: [6, 6], cell_mm: 10, wall_mm: {thickness: 1.6, height: 8}}\n"
                      "hinge: {kind: block, material: tango, gap_mm: 1.2, thickness_mm: 0.8}\n"
                      "drive: {kind: shape_memory, k_turn: 5}\nvariables: {offset_mm: " +
                          offset + "}\n"));
  };
  EXPECT_EQ(checked("0.4").code, 0);
  const Outcome far = checked("0.5");
  EXPECT_EQ(far.code, 2);
  EXPECT_THAT(
      far.err,
      HasSubstr("variables.offset_mm: this kind of hinge fits in walls of 1.6 mm at most 0.4 mm off"));
}

TEST(MadeHinges, ThatCannotBeMadeAreRefusedInOneLine) {
  for (const char* bad :
       {"kind: block, material: tangoo, gap_mm: 1", "kind: block, material: tango, gap_mm: 12",
        "kind: pin, diameter_mm: 4.9", "kind: pin, diameter_mm: 1, k_point: 10",
        "kind: block, material: {E_mpa: 1, nu: 0.5, strain_max: 1}, gap_mm: 1"}) {
    SCOPED_TRACE(bad);
    const Scratch scratch;
    const std::string file = scratch.write("bad.yaml", design_with(bad));
    const Outcome run = kinetix_opt("simulate " + file + " --quiet -o " + (scratch / "out").string());
    EXPECT_EQ(run.code, 2);
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_THAT(run.err, HasSubstr("bad.yaml:7:"));
    EXPECT_FALSE(fs::exists(scratch / "out"));
  }
}

}  // namespace
}  // namespace kinetix::testing
