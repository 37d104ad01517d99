#include "app/files/design_file.hpp"

#include <gmock/gmock.h>
#include <cmath>
#include <random>

#include "model/material/process.hpp"
#include "tests/support/bad_input.hpp"
#include "tests/support/random_designs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace kinetix::app {
namespace {

using testing::BadInput;
using testing::expect_refused;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::random_design;
using testing::structure_of;
using testing::TemporaryFolder;

// Start of most files below: a strip. The lines that follow make it valid or invalid.
const std::string strip = "kinetix: 1\nstructure: {cells: [6, 1], cell_mm: 10}\n";

Design read(const std::string& text) {
  TemporaryFolder folder;
  return read_design(folder.write("sheet.yaml", text));
}

const model::HingeParameters& hinge_of(const Design& file, const model::Wall& wall) {
  const model::Structure& squares = *file.structure.squares();
  return squares.hinges[*squares.hinge_at(wall)].parameters;
}

void expect_same(const Design& a, const Design& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.structure.squares()->cells, b.structure.squares()->cells);
  EXPECT_EQ(a.structure.squares()->size.edge_mm, b.structure.squares()->size.edge_mm);
  EXPECT_EQ(a.structure.squares()->size.thickness_mm, b.structure.squares()->size.thickness_mm);
  EXPECT_EQ(a.structure.squares()->size.height_mm, b.structure.squares()->size.height_mm);
  ASSERT_EQ(a.structure.squares()->hinges.size(), b.structure.squares()->hinges.size());
  for (std::size_t k = 0; k < a.structure.squares()->hinges.size(); ++k) {
    const model::HingeParameters &p = a.structure.squares()->hinges[k].parameters,
                                 &q = b.structure.squares()->hinges[k].parameters;
    EXPECT_EQ(a.structure.squares()->hinges[k].wall, b.structure.squares()->hinges[k].wall);
    EXPECT_TRUE(p.t == q.t && p.alpha == q.alpha && p.beta == q.beta && p.offset == q.offset)
        << "hinge " << k;
  }
  EXPECT_EQ(a.theta, b.theta);
  EXPECT_EQ(a.drive, b.drive);
  EXPECT_EQ(a.side, b.side);
  EXPECT_EQ(a.hinge, b.hinge);
  EXPECT_EQ(a.hinge_overrides, b.hinge_overrides);
  EXPECT_EQ(a.physics, b.physics);
  EXPECT_EQ(a.process, b.process);
}

TEST(DesignFile, TakesHingesAsTheyAreMade) {
  const Design file =
      read(strip +
           "hinge: {kind: block, material: tango, gap_mm: 1}\n"
           "design: {hinges: [{wall: [[0, 0], [1, 0]], hinge: {kind: film, material: {E_mpa: "
           "900, nu: 0.3, strain_max: 0.05}, gap_mm: 3, thickness_mm: 0.4, height_mm: 5}}, "
           "{wall: [[1, 0], [2, 0]], hinge: {kind: pin, diameter_mm: 1, play: true}}, {wall: [[2, 0], [3, "
           "0]], hinge: {k: {axial: 3, shear: 1, along: 2, turn: 0.1, rock: 5, twist: 4}, reach_mm: 2}}]}\n");
  EXPECT_EQ(file.hinge.model, HingeSection::Model::elastic);
  const model::ManufacturedHinge block{.kind = model::HingeKind::block,
                                       .material = *model::find_material("tango"),
                                       .gap_mm = 1,
                                       .thickness_mm = 1,
                                       .height_mm = 6};
  EXPECT_EQ(file.hinge.made, block);
  EXPECT_EQ(framed_stiffness(file.hinge), stiffness(block));
  ASSERT_EQ(file.hinge_overrides.size(), 3u);
  const auto own = [&](int i) -> const HingeSection& {
    return file.hinge_overrides.at(*file.structure.squares()->hinge_at({{i, 0}, model::Axis::x}));
  };
  EXPECT_EQ(own(0).made->kind, model::HingeKind::film);
  EXPECT_EQ(own(0).made->material, (model::Material{"", 900, 0.3, 0.05}));
  EXPECT_EQ(own(0).made->height_mm, 5);
  EXPECT_EQ(own(1).made->material.name, "pa12");
  EXPECT_EQ(own(1).made->clearance_mm, 0.3);
  EXPECT_TRUE(own(1).made->with_play);
  EXPECT_EQ(own(2).k, (model::HingeStiffness{3, 1, 2, 0.1, 5, 4}));
  EXPECT_EQ(own(2).reach_mm, 2);
  expect_same(read(design_text(file)), file);
}

TEST(DesignFile, TakesRodsOpenAndWithSizes) {
  const Design open = read(strip + "hinge: {kind: rod}\n");
  EXPECT_EQ(open.hinge.kind, model::HingeKind::rod);
  EXPECT_FALSE(open.hinge.made);
  expect_same(read(design_text(open)), open);
  const Design file = read(strip + "hinge: {kind: rod, clearance_mm: 0.1}\n");
  const model::ManufacturedHinge rod{.kind = model::HingeKind::rod,
                                     .material = *model::find_material("steel"),
                                     .height_mm = 6,
                                     .diameter_mm = 1,
                                     .clearance_mm = 0.1};
  EXPECT_EQ(file.hinge.made, rod);
  expect_same(read(design_text(file)), file);
  const Design printed = read(strip + "hinge: {kind: rod, diameter_mm: 1.5, material: pa12, caps: true}\n");
  EXPECT_EQ(printed.hinge.made->material.name, "pa12");
  expect_same(read(design_text(printed)), printed);
}

TEST(DesignFile, TakesHingesThatAreMadeOtherwise) {
  const std::string sheet = "kinetix: 1\nname: sheet\nstructure: {cells: [4, 2], cell_mm: 20}\n",
                    film = "kind: film, material: pp, gap_mm: 3, thickness_mm: 0.4",
                    leaning =
                        "design: {hinges: [{wall: [[1, 0], [2, 0]], beta_deg: 20}, {wall: [[1, 1], [2, 1]], "
                        "beta_deg: -20}]}\n";
  const Design file = read(sheet + leaning +
                           "hinge: {kind: pin, diameter_mm: 2, except: [{at: {column: 3}, kind: "
                           "block, material: tango, gap_mm: 2}, {at: creases, " +
                           film + "}]}\n");
  const auto of = [&](const Design& read_file, const model::Wall& wall) {
    const auto own = read_file.hinge_overrides.find(*read_file.structure.squares()->hinge_at(wall));
    return own == read_file.hinge_overrides.end() ? read_file.hinge : own->second;
  };
  EXPECT_EQ(file.hinge_overrides.size(), 5u) << "two that lean, three walls of the column";
  EXPECT_EQ(of(file, {{1, 0}, model::Axis::x}).made->kind, model::HingeKind::film);
  EXPECT_EQ(of(file, {{1, 1}, model::Axis::x}).made->kind, model::HingeKind::film);
  EXPECT_EQ(of(file, {{1, 2}, model::Axis::x}).made->kind, model::HingeKind::pin) << "it stands upright";
  for (int j = 0; j <= 2; ++j)
    EXPECT_EQ(of(file, {{3, j}, model::Axis::x}).made->kind, model::HingeKind::block);
  EXPECT_EQ(of(file, {{3, 0}, model::Axis::y}).made->kind, model::HingeKind::pin);
  expect_same(read(design_text(file)), file);

  const Design row = read(sheet + "hinge: {except: [{at: {row: 1}, " + film + "}]}\n");
  EXPECT_EQ(row.hinge.model, HingeSection::Model::elastic);
  EXPECT_EQ(row.hinge_overrides.size(), 5u);
  EXPECT_TRUE(of(row, {{2, 1}, model::Axis::y}).made);
  // An entry for a single wall has priority. The later of two entries applies.
  const Design twice = read(
      sheet + "hinge: {except: [{at: {row: 1}, " + film + "}, {at: {row: 1}, kind: pin, diameter_mm: 1}]}\n" +
      "design: {hinges: [{wall: [[0, 1], [0, 2]], hinge: {kind: pin, diameter_mm: 2}}]}\n");
  EXPECT_EQ(of(twice, {{0, 1}, model::Axis::y}).made->diameter_mm, 2);
  EXPECT_EQ(of(twice, {{1, 1}, model::Axis::y}).made->diameter_mm, 1);
}

TEST(DesignFile, RefusesPartsThatASheetDoesNotHave) {
  const TemporaryFolder folder;
  const std::string sheet = "kinetix: 1\nstructure: {cells: [4, 2]}\nhinge: {except: [{";
  const std::string k = ", k: {axial: 1, shear: 1, along: 1, turn: 1}}]}\n";
  const BadInput cases[] = {
      {sheet + "at: creases" + k, 3, 23, "hinge.except[0].at", {"no hinge of this sheet is tilted"}},
      {sheet + "at: {column: 4}" + k, 3, 23, "hinge.except[0].at", {"no column 4", "columns 0 to 3"}},
      {sheet + "at: {row: 2}" + k, 3, 23, "hinge.except[0].at", {"no row 2", "rows 0 to 1"}},
      {sheet + "at: {row: 0, column: 0}" + k, 3, 23, "hinge.except[0].at", {"Give either"}},
      {sheet + "at: {}" + k, 3, 23, "hinge.except[0].at", {"Give either"}},
      {sheet + "at: crease" + k, 3, 23, "hinge.except[0].at", {"creases"}},
      {sheet + "at: {column: -1}" + k, 3, 32, "hinge.except[0].at.column", {"-1"}},
      {"kinetix: 1\nstructure: {cells: [4, 2]}\nhinge: {model: rotary, except: [{at: {row: 0}" + k,
       3,
       16,
       "hinge.model",
       {"`except` lists hinges"}},
      {"kinetix: 1\nstructure: {lattice: honeycomb, cells: [3, 3]}\nhinge: {except: [{at: {row: 0}" + k,
       3,
       23,
       "hinge.except[0].at",
       {"only a sheet of squares"}}};
  for (const BadInput& bad : cases)
    expect_refused(bad, folder.path("sheet.yaml"),
                   [&] { read_design(folder.write("sheet.yaml", bad.text)); });
}

TEST(DesignFile, WritesHingesAsMadeBitForBit) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.1, 0.9);
  for (int round = 0; round < 30; ++round) {
    Design file = read(strip + "name: made\n");
    const auto beam = [&](model::HingeKind kind) {
      return model::ManufacturedHinge{.kind = kind,
                                      .material = {"", 100 * unit(random), unit(random) / 2, unit(random)},
                                      .gap_mm = 1 + unit(random),
                                      .thickness_mm = 0.8 * unit(random),
                                      .height_mm = 6 * unit(random)};
    };
    file.hinge.model = HingeSection::Model::elastic;
    file.hinge.made = beam(model::HingeKind::block);
    if (round % 2 == 0) file.hinge.k_contact = unit(random);
    file.hinge_overrides[3].model = file.hinge_overrides[5].model = HingeSection::Model::elastic;
    file.hinge_overrides[3].made = beam(model::HingeKind::film);
    file.hinge_overrides[5].k = model::HingeStiffness{unit(random), unit(random), unit(random), unit(random)};
    if (round % 3 == 0) file.hinge_overrides[5].k->rock = unit(random);
    if (round % 4 == 0) file.hinge_overrides[5].k->twist = unit(random);
    file.hinge_overrides[5].reach_mm = unit(random);
    if (round % 2 == 0) {
      file.process = model::processes()[round % 4];
      if (round % 3 == 0) file.process.clearance_mm = unit(random);
      if (round % 3 == 1) file.process.sd.tilt_deg = unit(random);
      if (round % 5 == 0) file.process.min_pin_mm = 1 + unit(random);
    }
    expect_same(read(design_text(file)), file);
  }
}

TEST(DesignFile, HoldsOffsetsInMillimetres) {
  const Design file = read(strip + "design: {hinges: [{wall: [[0, 0], [1, 0]], offset_mm: -0.7}]}\n");
  const model::HingeParameters& p = hinge_of(file, {{0, 0}, model::Axis::x});
  EXPECT_DOUBLE_EQ(p.offset, -0.07);
  // The offset is along z x e, across the wall: along y for a wall along x.
  EXPECT_LE((file.structure.squares()->hinge_point(file.structure.squares()->hinges[0]) -
             Eigen::Vector3d(5, -0.7, 0))
                .norm(),
            1e-15);
  expect_same(file, read(design_text(file)));
}

TEST(DesignFile, KeepsAnyOffsetThatIsANumberOfMillimetres) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> by(-4, 4);
  Design file = read("kinetix: 1\nname: sheet\nstructure: {cells: [6, 3], cell_mm: 8.3}\n");
  for (model::Hinge& hinge : file.structure.squares()->hinges) hinge.parameters.offset = by(random) / 8.3;
  expect_same(file, read(design_text(file)));
}

TEST(DesignFile, NeedsNoMoreThanAStructure) {
  const Design file = read("kinetix: 1\nstructure: {cells: [6, 1]}\n");
  EXPECT_EQ(file.name, "sheet");
  EXPECT_EQ(file.structure.squares()->cells.size(), 6u);
  EXPECT_EQ(file.structure.squares()->size.edge_mm, 10);
  EXPECT_EQ(file.theta, 0);
  EXPECT_FALSE(file.drive);
  EXPECT_EQ(file.hinge, HingeSection{});
  for (const model::Hinge& hinge : file.structure.squares()->hinges) EXPECT_EQ(hinge.parameters.beta, 0);
}

TEST(DesignFile, TakesEverySection) {
  const Design file =
      read(strip +
           "name: arch\ndesign:\n  theta_deg: 20\n  hinges:\n    - {wall: [[0, 0], [1, 0]], t: 0.4, "
           "alpha_deg: 80, "
           "beta_deg: 30}\n    - {wall: [[3, 0], [3, 1]], beta_deg: -10}\n"
           "drive: {kind: hinge, wall: [[0, 0], [0, 1]], angle_deg: -40}\n"
           "hinge: {model: elastic, k_point: 500, k_turn: 0.2, reach_mm: 3}\nphysics: {solver: direct, "
           "step_s: 0.002}\n");
  EXPECT_EQ(file.name, "arch");
  EXPECT_DOUBLE_EQ(file.theta, 20 * radians_per_degree);
  const model::HingeParameters& first = hinge_of(file, {{0, 0}, model::Axis::x});
  EXPECT_EQ(first.t, 0.4);
  EXPECT_DOUBLE_EQ(first.alpha, 80 * radians_per_degree);
  EXPECT_DOUBLE_EQ(first.beta, 30 * radians_per_degree);
  EXPECT_EQ(hinge_of(file, {{3, 0}, model::Axis::y}).t, 0.5);
  EXPECT_EQ(hinge_of(file, {{3, 0}, model::Axis::y}).alpha, pi / 2);
  ASSERT_TRUE(file.drive);
  const auto turn = std::get<model::HingeTurn>(*file.drive);
  EXPECT_EQ(turn.hinge, file.structure.squares()->hinge_at({{0, 0}, model::Axis::y}));
  EXPECT_DOUBLE_EQ(turn.angle, -40 * radians_per_degree);
  EXPECT_EQ(file.hinge, (HingeSection{HingeSection::Model::elastic, 500, 0.2, 3.0}));
  EXPECT_EQ(file.physics.step_s, 0.002);
}

model::Plates read_plates(const std::string& text) {
  return std::get<model::Plates>(read(text).drive.value());
}

TEST(DesignFile, DrivesByPlatesAlongYUnlessToldOtherwise) {
  EXPECT_EQ(read_plates(strip + "drive: {kind: plates, compression: 0.15}"),
            (model::Plates{.axis = model::Axis::y, .compression = 0.15}));
  EXPECT_EQ(read_plates(strip + "drive: {kind: plates, axis: x, compression: 0.15}").axis, model::Axis::x);
  EXPECT_FALSE(read_plates(strip + "drive: {kind: plates, compression: 0.15}").press);
  EXPECT_TRUE(read_plates(strip + "drive: {kind: plates, compression: 0.15, press: true}").press);
}

// A long row of cells on a bar of three, with a crease. Plates can hold only some of its parts.
const std::string tee =
    "kinetix: 1\nstructure: {cells: [[0, 0], [1, 0], [2, 0], [1, 1], [1, 2], [1, 3]]}\n"
    "design: {hinges: [{wall: [[1, 1], [1, 2]], beta_deg: -30}, {wall: [[2, 1], [2, 2]], beta_deg: 30}]}\n";

TEST(DesignFile, TakesThePartThatPlatesGrip) {
  const std::string spine = tee + "drive: {kind: plates, axis: x, compression: 0.1, grip: [[1, 0], [2, 4]]}";
  EXPECT_EQ(read_plates(spine).grip, (model::Grip{{1, 0}, {2, 4}}));
  EXPECT_NE(design_text(read(spine)).find("grip: [[1, 0], [2, 4]]}"), std::string::npos);
  EXPECT_FALSE(read_plates(tee + "drive: {kind: plates, compression: 0.1}").grip);
}

TEST(DesignFile, TakesTheBranchAndTheSideOfABifurcation) {
  const Design file = read(strip + "drive: {kind: plates, compression: 0.15, branch: -1, side: -1}");
  EXPECT_EQ(std::get<model::Plates>(*file.drive).branch, -1);
  EXPECT_EQ(file.side, -1);
  const Design side_alone = read(strip + "drive: {side: -1}");
  EXPECT_FALSE(side_alone.drive);
  EXPECT_EQ(side_alone.side, -1);
  EXPECT_EQ(read(strip).side, 1);
}

TEST(DesignFile, TakesThePaperPatternAndLetsNamedHingesWin) {
  const Design file =
      read(strip +
           "design:\n  pattern: {even: {P: [0.2, 0.8, 0.2, 0.8]}, odd: {P: [0.8, 0.2, 0.8, 0.2]}}\n"
           "  hinges: [{wall: [[0, 0], [1, 0]], beta_deg: 5}]\n");
  EXPECT_EQ(hinge_of(file, {{0, 0}, model::Axis::x}).t, 0.5);
  EXPECT_EQ(hinge_of(file, {{1, 0}, model::Axis::x}).t, 0.8);
  EXPECT_DOUBLE_EQ(hinge_of(file, {{0, 1}, model::Axis::x}).t, 0.8);
  EXPECT_EQ(hinge_of(file, {{1, 0}, model::Axis::y}).t, 0.8);
}

TEST(DesignFile, AveragesAPatternThatDisagreesOnlyWhenAsked) {
  const std::string pattern = "design:\n  pattern: {even: {P: [0.5, 0.8, 0.5, 0.5]}";
  EXPECT_DOUBLE_EQ(hinge_of(read(strip + pattern + ", shared: average}\n"), {{1, 0}, model::Axis::y}).t,
                   0.65);
  EXPECT_THAT(testing::refusal([&] { read(strip + pattern + "}\n"); }),
              HasSubstr("sheet.yaml:4:12: design.pattern: cells [0, 0] and [1, 0] disagree"));
}

TEST(DesignFile, SurvivesWritingAndReadingBitForBit) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  TemporaryFolder folder;
  for (int round = 0; round < 60; ++round) {
    const model::Family family =
        std::array{model::Family::F1, model::Family::F2, model::Family::F3}[round % 3];
    const double edge = 1 + 20 * unit(random);
    const auto design = random_design(family, 1 + round % 7, 1 + round % 4, random);
    Design file{
        .name = "round-" + std::to_string(round),
        .structure = structure_of(design, {edge, 0.4 * edge * unit(random) + 1e-3, 9 * unit(random) + 0.1})};
    for (int h = 0; h < file.structure.hinges(); ++h) file.structure.hinge(h).alpha = 0.01 + 3 * unit(random);
    file.theta = design.theta;
    if (round % 3 == 1) file.drive = model::Plates{.axis = model::Axis::x, .compression = unit(random)};
    if (round % 3 == 2) file.drive = model::HingeTurn{file.structure.hinges() - 1, 6 * unit(random) - 3};
    if (round % 12 == 5)
      file.drive = model::CordPull{.through = {0, file.structure.hinges() - 1},
                                   .shorten_mm = 1e-3 * edge * unit(random),
                                   .branch = -1};
    if (round % 12 == 8)
      file.drive =
          model::ShapeMemory{.angle = 6 * unit(random) - 3, .k_turn = unit(random), .springs = {0, 2}};
    if (auto* plates = file.drive ? std::get_if<model::Plates>(&*file.drive) : nullptr) {
      if (round % 4 < 2) plates->branch = round % 8 < 4 ? 1 : -1;
      plates->press = round % 5 < 2;
    }
    file.side = round % 7 < 3 ? -1 : 1;
    if (round % 2)
      file.hinge = {HingeSection::Model::elastic, 1000 * unit(random), unit(random), edge * unit(random)};
    if (round % 4 == 1) file.hinge.k_contact = 1e4 * unit(random);
    if (round % 10 == 0) file.physics = {0.1 * unit(random), edge * unit(random), unit(random), 1 + round};
    if (round % 10 == 5) file.physics = {.step_s = 0.1 * unit(random), .reach_mm = {}};
    expect_same(read_design(folder.write("d.yaml", design_text(file))), file);
  }
}

TEST(DesignFile, KeepsCellsThatFillNoRectangle) {
  const Design net = read("kinetix: 1\nstructure: {cells: [[1, 0], [0, 1], [1, 1], [2, 1], [1, 2]]}\n");
  expect_same(read(design_text(net)), [&] {
    Design same = net;
    same.name = "sheet";
    return same;
  }());
  Design away = read("kinetix: 1\nstructure: {cells: [[1, 1], [2, 1]]}\n");
  expect_same(read(design_text(away)), away);
}

TEST(DesignFile, WritesOnlyWhatDiffersFromTheBasicHinge) {
  Design file =
      read(strip + "design: {theta_deg: 20, hinges: [{wall: [[0, 0], [1, 0]], beta_deg: 54.7356}]}");
  EXPECT_EQ(design_text(file),
            "kinetix: 1\nname: \"sheet\"\nstructure:\n  cells: [6, 1]\n  cell_mm: 10\n"
            "  wall_mm: {thickness: 1, height: 6}\ndesign:\n  theta_deg: 20\n"
            "  hinges:  # walls that are not named have t: 0.5, alpha_deg: 90, beta_deg: 0\n"
            "    - {wall: [[0, 0], [1, 0]], t: 0.5, alpha_deg: 90, beta_deg: 54.7356}\n"
            "hinge: {model: rotary, k_point: 1000, k_turn: 0.1}\n");
  file.structure.squares()->hinges[0].parameters.beta = -0.0;
  EXPECT_THAT(design_text(file), Not(HasSubstr("hinges")));
}

TEST(DesignFile, ReadsBackADesignOfTenThousandCells) {
  std::mt19937 random(3);
  Design file{.name = "large", .structure = structure_of(random_design(model::Family::F3, 100, 100, random))};
  expect_same(read(design_text(file)), file);
}

TEST(DesignFile, SaysWhereAndWhatIsAllowed) {
  const auto hinges = [](const std::string& list) { return strip + "design: {hinges: [" + list + "]}\n"; };
  const auto hinge = [&](const std::string& wall) { return hinges("{wall: " + wall + "}"); };
  const auto with = [&](const std::string& more) { return hinges("{wall: [[0, 0], [1, 0]], " + more + "}"); };
  const std::string first = "design.hinges[0]";
  const std::vector<BadInput> cases = {
      {"kinetix: 1\n", 1, 1, "", {"`structure` is missing", "cells: [6, 1]"}},
      {"kinetix: 1\nstructure: {cell_mm: 10}\n", 2, 12, "structure", {"`cells` is missing"}},
      {"kinetix: 1\ntarget: {kind: curve}\n", 1, 1, "", {"target, not a design"}},
      {"kinetix: 3\nstructure: {cells: [6, 1]}\n", 1, 10, "kinetix", {"version 3"}},
      {"kinetix: 1\nstructure: {cells: [[0, 0], [2, 2]]}\n", 2, 20, "structure.cells", {"hang together"}},
      {strip + "design: {theta: 3}\n", 3, 10, "design.theta", {"did you mean `theta_deg`?"}},
      {strip + "design: {theta_deg: 90}\n",
       3,
       21,
       "design.theta_deg",
       {"above -90 and below 90, in degrees"}},
      {strip + "design: {hinges: 3}\n", 3, 18, "design.hinges", {"list of hinges"}},
      {hinges("{t: 0.5}"), 3, 19, first, {"`wall` is missing", "[[0, 0], [1, 0]]"}},
      {hinges("{wal: 1}"), 3, 20, first + ".wal", {"did you mean `wall`?"}},
      {with("t: 1"), 3, 47, first + ".t", {"above 0 and below 1"}},
      {with("alpha_deg: 180"), 3, 55, first + ".alpha_deg", {"above 0 and below 180, in degrees"}},
      {with("beta_deg: -90"), 3, 54, first + ".beta_deg", {"above -90 and below 90"}},
      {with("beta_deg: 89.99999999999999999999"), 3, 54, first + ".beta_deg", {"below 90"}},
      {hinge("[[7, 0], [8, 0]]"), 3, 26, first + ".wall", {"no wall [[7, 0], [8, 0]]", "structure.cells"}},
      {hinge("[[0, 0], [2, 0]]"), 3, 26, first + ".wall", {"not neighbours", "one step"}},
      {hinge("[[0, 0], [0, 0]]"), 3, 26, first + ".wall", {"not neighbours"}},
      {hinge("[[1, 0], [0, 0]]"), 3, 26, first + ".wall", {"upper to its lower", "Write [[0, 0], [1, 0]]"}},
      {hinge("[0, 0, 1, 0]"), 3, 26, first + ".wall", {"two vertices"}},
      {hinge("[[0, 0], [1]]"), 3, 35, first + ".wall[1]", {"a vertex [i, j]"}},
      {hinges("{wall: [[0, 0], [1, 0]]}, {wall: [[0, 0], [1, 0]]}"),
       3,
       45,
       "design.hinges[1]",
       {"listed twice", "line 3"}},
      {strip + "design: {pattern: {even: {P: [0.5, 0.5]}}}\n",
       3,
       30,
       "design.pattern.even.P",
       {"has 2 entries", "bottom, right, top, left"}},
      {strip + "design: {pattern: {even: {P: [0, 0.5, 0.5, 0.5]}}}\n",
       3,
       31,
       "design.pattern.even.P[0]",
       {"above 0 and below 1"}},
      {strip + "design: {pattern: {shared: mean}}\n", 3, 28, "design.pattern.shared", {"average"}},
      {strip + "drive: {kind: plate}\n", 3, 15, "drive.kind", {"did you mean `plates`?"}},
      {strip + "drive: {kind: plates}\n", 3, 8, "drive", {"`compression` is missing", "below 1"}},
      {strip + "drive: {kind: plates, compression: 15 %}\n", 3, 36, "drive.compression", {"below 1"}},
      {strip + "drive: {kind: plates, compression: 0.1, press: 1}\n", 3, 48, "drive.press", {"true"}},
      {strip + "drive: {kind: plates, angle_deg: 3}\n",
       3,
       23,
       "drive.angle_deg",
       {"allowed: kind, axis, compression"}},
      {strip + "drive: {kind: hinge, angle_deg: 40}\n", 3, 8, "drive", {"`wall` is missing"}},
      {strip + "drive: {kind: hinge, wall: [[9, 0], [9, 1]], angle_deg: 40}\n",
       3,
       28,
       "drive.wall",
       {"no wall"}},
      {strip + "drive: {kind: hinge, wall: [[0, 0], [0, 1]]}\n",
       3,
       8,
       "drive",
       {"`angle_deg` is missing", "degrees"}},
      {strip + "drive: {kind: chord}\n", 3, 15, "drive.kind", {"did you mean `cord`?"}},
      {strip + "drive: {kind: cord, shorten_mm: 3}\n",
       3,
       8,
       "drive",
       {"`through` is missing", "at least two walls"}},
      {strip + "drive: {kind: cord, through: [[[0, 0], [0, 1]], [[1, 0], [1, 1]]]}\n",
       3,
       8,
       "drive",
       {"`shorten_mm` is missing", "mm"}},
      {strip + "drive: {kind: cord, through: [[[0, 0], [0, 1]]], shorten_mm: 3}\n",
       3,
       30,
       "drive.through",
       {"at least two walls"}},
      {strip + "drive: {kind: cord, through: [[[0, 0], [0, 1]], [[9, 0], [9, 1]]], shorten_mm: 3}\n",
       3,
       49,
       "drive.through[1]",
       {"no wall"}},
      {strip + "drive: {kind: cord, through: [[[0, 0], [1, 0]], [[1, 0], [2, 0]]], shorten_mm: 3}\n",
       3,
       30,
       "drive.through",
       {"rigid body carries both", "no drive shortens"}},
      {strip + "drive: {kind: cord, through: [[[0, 0], [0, 1]], [[0, 0], [0, 1]]], shorten_mm: 3}\n",
       3,
       30,
       "drive.through",
       {"twice in a row"}},
      {strip + "drive: {kind: cord, shorten_mm: 0, through: [[[0, 0], [0, 1]], [[1, 0], [1, 1]]]}\n",
       3,
       33,
       "drive.shorten_mm",
       {"above 0"}},
      {strip + "drive: {kind: cord, shorten_mm: 1e3, through: [[[0, 0], [0, 1]], [[1, 0], [1, 1]]]}\n",
       3,
       33,
       "drive.shorten_mm",
       {"below the tendon's length"}},
      {strip + "drive: {kind: cord, shorten_mm: .nan, through: [[[0, 0], [0, 1]], [[1, 0], [1, 1]]]}\n",
       3,
       33,
       "drive.shorten_mm",
       {"finite"}},
      {strip + "drive: {kind: cord, wall: [[0, 0], [0, 1]]}\n",
       3,
       21,
       "drive.wall",
       {"allowed: kind, through"}},
      {strip + "drive: {kind: shape_memory, k_turn: 5}\n", 3, 8, "drive", {"`angle_deg` is missing"}},
      {strip + "drive: {kind: shape_memory, angle_deg: 40}\n",
       3,
       8,
       "drive",
       {"`k_turn` is missing", "N mm/rad"}},
      {strip + "drive: {kind: shape_memory, angle_deg: 40, k_turn: 0}\n", 3, 52, "drive.k_turn", {"above 0"}},
      {strip + "drive: {kind: shape_memory, angle_deg: 40, k_turn: 1e300}\n",
       3,
       52,
       "drive.k_turn",
       {"1e30"}},
      {strip + "drive: {kind: shape_memory, angle_deg: 180, k_turn: 5}\n",
       3,
       40,
       "drive.angle_deg",
       {"below 180"}},
      {strip + "drive: {kind: shape_memory, angle_deg: 40, k_turn: 5, walls: []}\n",
       3,
       62,
       "drive.walls",
       {"at least one"}},
      {strip + "drive: {kind: shape_memory, angle_deg: 40, k_turn: 5, walls: [[[0, 0], [0, 1]], [[0, 0], [0, "
               "1]]]}\n",
       3,
       62,
       "drive.walls",
       {"named twice"}},
      {strip + "hinge: {model: stiff}\n", 3, 16, "hinge.model", {"rotary, elastic"}},
      {strip + "hinge: {k_point: 0}\n", 3, 18, "hinge.k_point", {"above 0, in N/mm"}},
      {strip + "hinge: {k_turn: -1}\n", 3, 17, "hinge.k_turn", {"at least 0, in N mm/rad"}},
      {strip + "hinge: {model: elastic, k_turn: 0}\n", 3, 33, "hinge.k_turn", {"above 0, in N mm/rad"}},
      {strip + "hinge: {model: elastic, k_point: -5}\n", 3, 34, "hinge.k_point", {"above 0, in N/mm"}},
      {strip + "hinge: {k_contact: 0}\n", 3, 20, "hinge.k_contact", {"above 0, in N/mm"}},
      {strip + "hinge: {kind: blok}\n", 3, 15, "hinge.kind", {"pin, block, film", "did you mean `block`?"}},
      {strip + "hinge: {kind: block, gap_mm: 1}\n", 3, 8, "hinge", {"`material` is missing", "E_mpa"}},
      {strip + "hinge: {kind: block, material: tangoo, gap_mm: 1}\n",
       3,
       32,
       "hinge.material",
       {"did you mean `tango`?", "tpu95a"}},
      {strip + "hinge: {kind: block, material: {E_mpa: -2, nu: 0.4, strain_max: 1}, gap_mm: 1}\n",
       3,
       40,
       "hinge.material.E_mpa",
       {"0.000001", "MPa"}},
      {strip + "hinge: {kind: block, material: {E_mpa: 2, nu: 0.5, strain_max: 1}, gap_mm: 1}\n",
       3,
       47,
       "hinge.material.nu",
       {"below 0.5"}},
      {strip + "hinge: {kind: block, material: {E_mpa: 2, nu: 0.4}, gap_mm: 1}\n",
       3,
       32,
       "hinge.material",
       {"`strain_max` is missing"}},
      {strip + "hinge: {kind: block, material: tango}\n", 3, 8, "hinge", {"`gap_mm` is missing"}},
      {strip + "hinge: {kind: block, material: tango, gap_mm: 11}\n", 3, 47, "hinge.gap_mm", {"below 10"}},
      {strip + "hinge: {kind: block, material: tango, gap_mm: 0.2}\n",
       3,
       47,
       "hinge.gap_mm",
       {"half of the hinge's thickness"}},
      {strip + "hinge: {kind: block, material: tango, gap_mm: 1, thickness_mm: 1.1}\n",
       3,
       64,
       "hinge.thickness_mm",
       {"at most 1", "the wall's"}},
      {strip + "hinge: {kind: block, material: tango, gap_mm: 1, height_mm: 7}\n",
       3,
       61,
       "hinge.height_mm",
       {"at most 6"}},
      {strip + "hinge: {kind: block, material: tango, gap_mm: 1, diameter_mm: 1}\n",
       3,
       50,
       "hinge.diameter_mm",
       {"only applies to pins"}},
      {strip + "hinge: {kind: film, material: pp, gap_mm: 1}\n",
       3,
       8,
       "hinge",
       {"`thickness_mm` is missing"}},
      {strip + "hinge: {kind: pin, diameter_mm: 1, gap_mm: 1}\n",
       3,
       36,
       "hinge.gap_mm",
       {"only applies to blocks and living hinges"}},
      {strip + "hinge: {kind: pin, diameter_mm: 4.9}\n",
       3,
       33,
       "hinge.diameter_mm",
       {"at most 4.87107 mm", "two knuckles"}},
      {strip + "hinge: {kind: pin, diameter_mm: 3, clearance_mm: -0.1}\n",
       3,
       50,
       "hinge.clearance_mm",
       {"at least 0"}},
      {strip + "hinge: {k: {axial: 1, shear: 1, along: 1, turn: 1, rock: 0}}\n",
       3,
       58,
       "hinge.k.rock",
       {"above 0"}},
      {strip + "hinge: {k: {axial: 1, shear: 1, along: 1, turn: 1, twist: -1}}\n",
       3,
       59,
       "hinge.k.twist",
       {"above 0"}},
      {strip + "hinge: {kind: block, material: tango, gap_mm: 1, play: true}\n",
       3,
       50,
       "hinge.play",
       {"only applies to pins"}},
      {strip + "hinge: {play: true}\n", 3, 9, "hinge.play", {"hinge with a `kind`", "kind: pin"}},
      {strip + "hinge: {kind: pin, diameter_mm: 1, clearance_mm: 0.3, height_mm: 0.5, play: true}\n",
       3,
       50,
       "hinge.clearance_mm",
       {"at most half of the height"}},
      {strip + "hinge: {gap_mm: 1}\n", 3, 9, "hinge.gap_mm", {"hinge with a `kind`", "kind: pin"}},
      {strip + "hinge: {kind: pin, diameter_mm: 1, k_point: 10}\n",
       3,
       36,
       "hinge.k_point",
       {"cannot be combined", "hinge.kind"}},
      {strip + "hinge: {kind: pin, diameter_mm: 1, k_turn: 1}\n",
       3,
       36,
       "hinge.k_turn",
       {"Remove one of the two keys"}},
      {strip + "hinge: {kind: pin, diameter_mm: 1, reach_mm: 1}\n",
       3,
       36,
       "hinge.reach_mm",
       {"Remove one of the two keys"}},
      {strip + "hinge: {k: {axial: 1, shear: 1, along: 1, turn: 1}, k_turn: 1}\n",
       3,
       53,
       "hinge.k_turn",
       {"cannot be combined", "hinge.k,"}},
      {strip + "hinge: {k: {axial: 1, shear: 0, along: 1, turn: 1}}\n",
       3,
       30,
       "hinge.k.shear",
       {"above 0, in N/mm"}},
      {strip + "hinge: {k: {axial: 1, shear: 1, along: 1}}\n", 3, 12, "hinge.k", {"`turn` is missing"}},
      {strip + "hinge: {kind: pin, diameter_mm: 1}\nphysics: {reach_mm: 2}\n",
       4,
       11,
       "physics.reach_mm",
       {"hinge.kind", "Remove one of the two keys"}},
      {with("hinge: {model: rotary}"), 3, 52, first + ".hinge.model", {"unknown"}},
      {with("hinge: {kind: block, material: tango, gap_mm: 1, k_turn: 2}"),
       3,
       93,
       first + ".hinge.k_turn",
       {"cannot be combined"}},
      {strip + "hinge: {k_contract: 9}\n", 3, 9, "hinge.k_contract", {"did you mean `k_contact`?"}},
      {strip + "drive: {kind: plates, compression: 0.1, branch: 2}\n", 3, 49, "drive.branch", {"1, -1"}},
      {tee + "drive: {kind: plates, compression: 0.1, grip: [[0, 0], [3, 2]]}\n",
       4,
       47,
       "drive.grip",
       {"no vertex [0, 2]"}},
      {tee + "drive: {kind: plates, compression: 0.1, grip: [[1, 0], [2, 4]]}\n",
       4,
       47,
       "drive.grip",
       {"do not stay in two parallel planes", "spine"}},
      {tee + "drive: {kind: plates, compression: 0.1, grip: [[1, 0], [2, 0]]}\n",
       4,
       47,
       "drive.grip",
       {"at least one cell both ways"}},
      {tee + "drive: {kind: plates, compression: 0.1, grip: [[1, 0], [2, -1]]}\n",
       4,
       60,
       "drive.grip[1][1]",
       {"0 to 10000"}},
      {strip + "drive: {kind: plates, compression: 1}\n", 3, 36, "drive.compression", {"below 1"}},
      {strip + "drive: {side: 0}\n", 3, 15, "drive.side", {"1, -1"}},
      {strip + "drive: {side: 1, compression: 0.2}\n", 3, 8, "drive", {"`kind` is missing"}},
      {strip + "hinge: {reach_mm: 2}\nphysics: {reach_mm: 2}\n",
       4,
       11,
       "physics.reach_mm",
       {"Remove one of the two keys"}},
      {strip + "physics: {error_reduction: 1}\n", 3, 11, "physics.error_reduction", {"was removed"}},
      {strip + "physics: {solver: sweeps}\n", 3, 19, "physics.solver", {"`sweeps` was removed", "`direct`"}},
      {strip + "physics: {solver: exact}\n", 3, 19, "physics.solver", {"allowed: direct"}},
      {strip + "physics: [1]\n", 3, 10, "physics", {"a map of keys (solver, step_s"}},
      {strip + "hinge: {reach_mm: 101}\n", 3, 19, "hinge.reach_mm", {"0.1 to 100", "10 cells"}},
  };
  TemporaryFolder folder;
  const std::string file = folder.path("sheet.yaml");
  for (const BadInput& bad : cases) {
    folder.write("sheet.yaml", bad.text);
    expect_refused(bad, file, [&] { read_design(file); });
  }
}

}  // namespace
}  // namespace kinetix::app
