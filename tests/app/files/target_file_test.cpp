#include <gmock/gmock.h>
#include <cmath>
#include <random>

#include "app/goals/curve/curve_search.hpp"
#include "app/goals/display/display_file.hpp"
#include "app/goals/helmet/helmet_goal.hpp"
#include "app/goals/registry.hpp"
#include "app/goals/space_curve/space_curve_goal.hpp"
#include "tests/support/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/targets/heads.hpp"

namespace kinetix::app {
namespace {

using testing::BadInput;
using testing::expect_refused;
using ::testing::HasSubstr;
using testing::refusal;
using testing::TemporaryFolder;

/// A curve of length 100 mm, in one line.
const std::string target = "kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [60, 0], [60, 40]]}\n";

CurveFile read_curve_target(const std::string& file) {
  const targets::Node root = targets::read_document(file);
  EXPECT_EQ(read_target(root).kind->name, "curve");
  return read_curve_file(root);
}

CurveFile read_curve(const std::string& text) {
  TemporaryFolder folder;
  return read_curve_target(folder.write("rib.yaml", text));
}

DisplayFile read_display_target(const std::string& file) {
  const targets::Node root = targets::read_document(file);
  EXPECT_EQ(read_target(root).kind->name, "display");
  return read_display_file(root);
}

TEST(TargetFile, IsStricterWithFlatCurvesAndWithSmallCells) {
  const auto tolerance = [](const std::string& points, const std::string& rest = {}) {
    return read_curve("kinetix: 1\ntarget: {kind: curve, points: " + points + "}\n" + rest).shape_tolerance;
  };
  EXPECT_EQ(tolerance("[[0, 0], [100, 50], [200, 0]]"), 0.01);
  const double flat = std::hypot(300, 25);
  EXPECT_DOUBLE_EQ(tolerance("[[0, 0], [150, 25], [300, 0]]") * flat, 1.25) << "a twentieth of 25 mm";
  EXPECT_DOUBLE_EQ(
      tolerance("[[0, 0], [100, 50], [200, 0]]", "structure: {cell_mm: 1}\n") * std::hypot(200, 50), 0.5);
  EXPECT_EQ(tolerance("[[0, 0], [150, 0], [300, 0]]"), 0.001) << "straight";
  EXPECT_EQ(tolerance("[[0, 0], [150, 25], [300, 0]]", "tolerance: {shape: 0.05}\n"), 0.05);
}

TEST(TargetFile, IsStricterWithHelmetsOfSmallCells) {
  TemporaryFolder folder;
  folder.write("head.obj", testing::obj_text(testing::ellipsoid({76, 98, 112})));
  const auto file = [&](double cell_mm) {
    const std::string text =
        "kinetix: 1\ntarget: {kind: helmet, mesh: head.obj, ribs: 3, coverage_mm: 70}\n"
        "structure: {cell_mm: " +
        std::to_string(cell_mm) + "}\n";
    return read_helmet_file(targets::read_document(folder.write("cap.yaml", text)));
  };
  EXPECT_NEAR(file(24).max_mm, 70.0 / 30, 1e-12) << "a thirtieth of the coverage";
  EXPECT_NEAR(file(4).max_mm, 2, 1e-12) << "half a cell";
  EXPECT_NEAR(file(4).rms_mm, 0.8 * 2 / 3, 1e-12);
}

/// The default is 96 columns. Walls are a tenth of a cell, which limits the columns to what the process can print at
/// every theta of the search. At least 24 columns remain, if 24 can follow the curve.
TEST(TargetFile, CurvesInSpaceHaveCellsThatCanBePrinted) {
  TemporaryFolder folder;
  const auto columns = [&](const std::string& points, const std::string& more = {}) {
    const std::string text = "kinetix: 1\ntarget: {kind: space_curve, points: " + points + "}\n" + more;
    return read_space_curve_file(targets::read_document(folder.write("space.yaml", text))).variables.columns;
  };
  const std::string large = "[[0, 0, 0], [300, 0, 30], [600, 30, 60]]",
                    middle = "[[0, 0, 0], [100, 0, 10], [200, 10, 20]]",
                    small = "[[0, 0, 0], [10, 0, 1], [20, 1, 2]]";
  EXPECT_EQ(columns(large), 96);
  EXPECT_EQ(columns(middle), 33) << "201.5 mm in cells of 6 mm at 20 deg";
  EXPECT_EQ(columns(middle, "process: fdm\n"), 25) << "of 8 mm";
  EXPECT_EQ(columns(middle, "structure: {cells: [60, 1]}\n"), 60);
  EXPECT_EQ(columns(middle, "structure: {wall_mm: {thickness: 0.6, height: 3}}\n"), 96) << "walls of its own";
  EXPECT_EQ(columns(small), 24);
  const std::string bend =
      "[[0, 0, 0], [40, 0, 0], [41.531, 0, 0.304], [42.828, 0, 1.172], [43.696, 0, 2.469], [44, 0, 4], "
      "[43.696, 0, 5.531], [42.828, 0, 6.828], [41.531, 0, 7.696], [40, 0, 8], [0, 0, 8]]";
  EXPECT_EQ(columns(bend), 96) << "24 cannot follow a bend of 4 mm";
}

/// The default is 40 columns. Walls are a tenth of a cell, which limits the columns to what the process can print. At
/// least 8 columns remain.
TEST(TargetFile, TakesAsManyColumnsAsItsProcessCanPrint) {
  const auto columns = [](int length_mm, const std::string& more) {
    return read_curve("kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [" + std::to_string(length_mm / 2) +
                      ", 0], [" + std::to_string(length_mm / 2) + ", " + std::to_string(length_mm / 2) +
                      "]]}\n" + more)
        .columns;
  };
  EXPECT_EQ(columns(400, ""), 40);
  EXPECT_EQ(columns(100, ""), 19) << "0.6 mm by PolyJet";
  EXPECT_EQ(columns(100, "process: fdm\n"), 14) << "0.8 mm";
  EXPECT_EQ(columns(20, ""), 8);
  EXPECT_EQ(columns(100, "structure: {wall_mm: {thickness: 0.6, height: 3}}\n"), 40) << "walls of its own";
  EXPECT_EQ(columns(100, "structure: {cells: [25, 1]}\n"), 25);
}

TEST(TargetFile, GivesAStripItsLengthAtAThetaThatItMayHave) {
  const auto edge_mm = [](const std::string& range) {
    return read_curve(target + "structure: {cells: [20, 1]}\nvariables: {theta: {range_deg: " + range +
                      "}}\n")
        .size.edge_mm;
  };
  EXPECT_DOUBLE_EQ(edge_mm("[10, 40]") * 20 * std::cos(30 * radians_per_degree), 100);
  EXPECT_NEAR(edge_mm("[10, 25]") * 20 * std::cos(25 * radians_per_degree), 100, 1e-9);
  EXPECT_NEAR(edge_mm("[35, 40]") * 20 * std::cos(35 * radians_per_degree), 100, 1e-9);
}

TEST(TargetFile, NeedsNoMoreThanAVersionAndATarget) {
  const CurveFile file = read_curve(target);
  EXPECT_EQ(file.name, "rib");
  EXPECT_EQ(file.curve.length(), 100);
  EXPECT_EQ(file.columns, 19);
  EXPECT_EQ(file.rows, 1);
  EXPECT_DOUBLE_EQ(file.size.edge_mm * 19 * std::cos(30 * radians_per_degree), 100);
  EXPECT_DOUBLE_EQ(file.size.thickness_mm, 0.1 * file.size.edge_mm);
  EXPECT_DOUBLE_EQ(file.size.height_mm, 0.6 * file.size.edge_mm);
  EXPECT_DOUBLE_EQ(file.beta.lower, -60 * radians_per_degree);
  EXPECT_DOUBLE_EQ(file.beta.upper, 60 * radians_per_degree);
  EXPECT_EQ(file.per, optim::Per::column);
  EXPECT_EQ(file.symmetry, optim::Symmetry::none);
  EXPECT_DOUBLE_EQ(file.theta.lower, 2 * radians_per_degree);
  EXPECT_DOUBLE_EQ(file.theta.upper, 44 * radians_per_degree);
  EXPECT_EQ(file.shape_tolerance, 0.01);
  EXPECT_EQ(file.verify_tolerance, 0.02);
  EXPECT_FALSE(file.solver.name || file.solver.starts || file.solver.max_evaluations);
  EXPECT_EQ(file.physics, PhysicsSection{});
}

TEST(TargetFile, TakesWhatIsGiven) {
  const CurveFile file = read_curve(
      "kinetix: 1\nname: helmet_rib-2.b\ntarget: {kind: curve, points: [[0, 0], [60, 0], [60, 40]]}\n"
      "structure: {cells: [12, 12], cell_mm: 8, wall_mm: {thickness: 0.8, height: 6}}\n"
      "variables:\n  beta: {range_deg: [-50, 40], per: all, symmetry: rotate_2}\n  theta: {range_deg: [3, "
      "30]}\n"
      "tolerance: {shape: 0.03, verify: 0.04}\n"
      "solver: {name: slsqp, starts: 5, max_evaluations: 300}\n"
      "physics: {step_s: 0.002, reach_mm: 2}\n");
  EXPECT_EQ(file.name, "helmet_rib-2.b");
  EXPECT_EQ(file.columns, 12);
  EXPECT_EQ(file.rows, 12);
  EXPECT_EQ(file.size.edge_mm, 8);
  EXPECT_EQ(file.size.thickness_mm, 0.8);
  EXPECT_EQ(file.size.height_mm, 6);
  EXPECT_DOUBLE_EQ(file.beta.lower, -50 * radians_per_degree);
  EXPECT_EQ(file.per, optim::Per::all);
  EXPECT_EQ(file.symmetry, optim::Symmetry::rotate_2);
  EXPECT_DOUBLE_EQ(file.theta.upper, 30 * radians_per_degree);
  EXPECT_EQ(file.shape_tolerance, 0.03);
  EXPECT_EQ(file.verify_tolerance, 0.04);
  EXPECT_EQ(file.solver.name, optim::SolverName::slsqp);
  EXPECT_EQ(file.solver.starts, 5);
  EXPECT_EQ(file.solver.max_evaluations, 300);
  EXPECT_EQ(file.physics, (PhysicsSection{0.002, 2.0}));
}

TEST(TargetFile, ChoosesTheColumnsThatFitACellSize) {
  EXPECT_EQ(read_curve(target + "structure: {cell_mm: 8}").columns, 14);
  EXPECT_EQ(read_curve(target + "structure: {cell_mm: 100}").columns, 2);
}

TEST(TargetFile, TakesAListOfCellsThatIsARectangle) {
  const CurveFile file =
      read_curve(target + "structure: {cells: [[0, 0], [1, 1], [0, 1], [2, 0], [1, 0], [2, 1]]}");
  EXPECT_EQ(file.columns, 3);
  EXPECT_EQ(file.rows, 2);
}

TEST(TargetFile, NamesItselfByTheFile) {
  TemporaryFolder folder;
  EXPECT_EQ(read_curve_target(folder.write("my r\xC3\xAD"
                                           "b.v2.yaml",
                                           target))
                .name,
            "my_r__b.v2");
  EXPECT_EQ(read_curve_target(folder.write(".hidden", target)).name, "_.hidden");
}

TEST(TargetFile, ReadsTheTargetsThatShip) {
  for (const char* name : {"half_circle", "helmet_rib", "s_curve", "spiral"}) {
    const CurveFile file =
        read_curve_target(std::string(KINETIX_SOURCE) + "/targets/shapes/" + name + ".yaml");
    EXPECT_EQ(file.name, name);
    EXPECT_GE(file.columns, 40);
  }
}

TEST(TargetFile, ReadsTheDisplaysThatShip) {
  const auto read = [](const std::string& name) {
    const DisplayFile file =
        read_display_target(std::string(KINETIX_SOURCE) + "/targets/shapes/" + name + ".yaml");
    EXPECT_EQ(file.name, name);
    EXPECT_TRUE(file.goal.is_binary());
    return file;
  };
  EXPECT_EQ(read("letter_t").compression, 0.12);
  EXPECT_EQ(read("letter_t").channel, optim::Channel::light);
  EXPECT_EQ(read("letter_t").offset, 0.08);
  EXPECT_EQ(read("circle").compression, 0.12);
  EXPECT_EQ(read("circle").channel, optim::Channel::aperture);
  EXPECT_EQ(read("circle").offset, 0);
}

TEST(TargetFile, ReadsEveryKeyOfADisplay) {
  TemporaryFolder folder;
  const DisplayFile file = read_display_target(folder.write("d.yaml", R"(kinetix: 1
target: {kind: display, rows: ["011", "010"], channel: area}
structure: {cell_mm: 20}
drive: {axis: x, compression: 0.1}
variables: {t: {range: [0.1, 0.9], corner_mm: 3, symmetry: rotate_2}}
tolerance: {stretch: 0.2, auc: 0.9, contrast: 2, verify: 0.1}
hinge: {k_point: 500, k_turn: 0.2}
solver: {name: ccsa, max_evaluations: 7}
)"));
  EXPECT_EQ(file.goal.columns, 3);
  EXPECT_EQ(file.goal.row_texts(), (std::vector<std::string>{"011", "010"}));
  EXPECT_EQ(file.channel, optim::Channel::area);
  EXPECT_EQ(file.axes, std::vector{model::Axis::x});
  EXPECT_FALSE(file.compression_range);
  EXPECT_EQ(file.compression, 0.1);
  EXPECT_DOUBLE_EQ(file.t[0], 0.15);
  EXPECT_DOUBLE_EQ(file.t[1], 0.85);
  EXPECT_EQ(file.symmetry, optim::Symmetry::rotate_2);
  EXPECT_EQ(file.stretch, 0.2);
  EXPECT_EQ(file.auc, 0.9);
  EXPECT_EQ(file.contrast, 2);
  EXPECT_EQ(file.verify_tolerance, 0.1);
  EXPECT_EQ(file.hinge.k_point, 500);
  EXPECT_EQ(file.solver.name, optim::SolverName::ccsa);
  EXPECT_EQ(file.solver.max_evaluations, 7);
}

TEST(TargetFile, ReadsCompressionAndDirectionAsVariables) {
  TemporaryFolder folder;
  const auto read = [&](const std::string& more) {
    return read_display_target(
        folder.write("d.yaml", "kinetix: 1\ntarget: {kind: display, rows: [\"01\", \"00\"]}\n" + more));
  };
  const DisplayFile both = read("variables: {compression: {range: [0.15, 0.2]}, axis: [x, y]}\n");
  EXPECT_EQ(both.axes, (std::vector{model::Axis::x, model::Axis::y}));
  EXPECT_EQ(both.compression_range, (std::array{0.15, 0.2}));
  EXPECT_EQ(both.compression, 0.15);
  const DisplayFile start =
      read("drive: {compression: 0.18}\nvariables: {compression: {range: [0.15, 0.2]}, axis: [y]}\n");
  EXPECT_EQ(start.compression, 0.18);
  EXPECT_EQ(start.axes, std::vector{model::Axis::y});
}

TEST(TargetFile, SaysWhatIsWrongWithADisplay) {
  const std::string t = "kinetix: 1\ntarget: {kind: display, glyph: T}\n";
  const std::vector<BadInput> cases = {
      {"kinetix: 1\ntarget: {kind: display}\n", 2, 9, "target", {"glyph", "image", "rows"}},
      {"kinetix: 1\ntarget: {kind: display, glyph: T, channel: colour}\n",
       2,
       44,
       "target.channel",
       {"light, aperture, area, rotation"}},
      {t + "structure: {cells: [1, 1]}\n", 3, 21, "structure.cells[0]", {"2 to 1000"}},
      {t + "drive: {compression: 0.6}\n", 3, 22, "drive.compression", {"above 0 and at most 0.5"}},
      {t + "drive: {axis: z}\n", 3, 15, "drive.axis", {"x, y"}},
      {t + "variables: {beta: {}}\n",
       3,
       13,
       "variables.beta",
       {"allowed: offset_mm, stretch_mm, hinge_position"}},
      {t + "variables: {offset_mm: 0, stretch_mm: 0.1}\n",
       3,
       27,
       "variables.stretch_mm",
       {"has no effect if variables.offset_mm is 0"}},
      {t + "structure: {lattice: rhombus}\nvariables: {offset_mm: 0}\n",
       3,
       22,
       "structure.lattice",
       {"show pictures only on squares"}},
      {t + "variables: {stretch_mm: 5}\n", 3, 25, "variables.stretch_mm", {"below half of cell_mm"}},
      {t + "variables: {compression: {}}\n", 3, 26, "variables.compression", {"`range` is missing"}},
      {t + "variables: {compression: {range: [0, 0.2]}}\n",
       3,
       35,
       "variables.compression.range[0]",
       {"above 0"}},
      {t + "drive: {compression: 0.3}\nvariables: {compression: {range: [0.1, 0.2]}}\n",
       3,
       22,
       "drive.compression",
       {"outside variables.compression.range", "[0.1, 0.2]"}},
      {t + "variables: {axis: []}\n", 3, 19, "variables.axis", {"has no direction"}},
      {t + "variables: {axis: [x, x]}\n", 3, 23, "variables.axis[1]", {"twice"}},
      {t + "drive: {axis: x}\nvariables: {axis: [x, y]}\n",
       4,
       19,
       "variables.axis",
       {"Remove one of the two keys"}},
      {t + "variables: {t: {corner_mm: 5}}\n", 3, 28, "variables.t.corner_mm", {"0.45 cells"}},
      {t + "variables: {t: {range: [0.6, 0.8], symmetry: rotate_2}}\n",
       3,
       24,
       "variables.t.range",
       {"the range does not contain 0.5, and a symmetry"}},
      {t + "tolerance: {auc: 0.4}\n", 3, 18, "tolerance.auc", {"0.5"}},
      {t + "solver: {name: ceres}\n", 3, 16, "solver.name", {"mma, ccsa or slsqp"}},
      {t + "hinge: {k_point: 0}\n", 3, 18, "hinge.k_point", {"above 0"}},
      {t + "hinge: {k_turn: 0}\n", 3, 17, "hinge.k_turn", {"above 0"}},
      {t + "hinge: {model: rotary}\n",
       3,
       16,
       "hinge.model",
       {"cannot stretch, which this goal needs. Give `model: elastic`"}},
      {t + "hinge: {reach_mm: 2}\nphysics: {reach_mm: 2}\n",
       4,
       11,
       "physics.reach_mm",
       {"Remove one of the two keys"}},
      {t + "physics: {solver: sweeps}\n", 3, 19, "physics.solver", {"`sweeps` was removed", "`direct`"}},
  };
  TemporaryFolder folder;
  const std::string file = folder.path("t.yaml");
  for (const BadInput& bad : cases) {
    folder.write("t.yaml", bad.text);
    expect_refused(bad, file, [&] { read_target(file); });
  }
}

TEST(TargetFile, SaysWhereAndWhatIsAllowed) {
  const std::string points = "target: {kind: curve, points: [[0, 0], [60, 0], [60, 40]]}\n";
  const auto kind = [](const std::string& name) { return "kinetix: 1\ntarget: {kind: " + name + "}\n"; };
  const std::vector<BadInput> cases = {
      {points, 1, 1, "", {"`kinetix` is missing", "kinetix: 1"}},
      {"kinetix: 2\n" + points, 1, 10, "kinetix", {"version 2 is not supported", "kinetix: 1"}},
      {"kinetix: '1'\n" + points, 1, 10, "kinetix", {"quotes"}},
      {"kinetix: one\n" + points, 1, 10, "kinetix", {"whole number"}},
      {"- 1\n", 1, 1, "", {"is a list", "kinetix"}},
      {"kinetix: 1\n", 1, 1, "", {"`target` is missing", "kind: curve"}},
      {"kinetix: 1\ntarget:\n", 2, 1, "target", {"is empty", "kind"}},
      {"kinetix: 1\ntarget: {points: a.csv}\n", 2, 9, "target", {"`kind` is missing", "kind: curve"}},
      {"kinetix: 1\ntarget: {kind: curve}\n", 2, 9, "target", {"`points` is missing", "path of a file"}},
      {"kinetix: 1\ntarget: {kind: curve, point: a.csv}\n",
       2,
       23,
       "target.point",
       {"did you mean `points`?"}},
      {"kinetix: 1\ntarget: {kind: curve, points: gone.csv}\n",
       2,
       31,
       "target.points",
       {"gone.csv: no such file"}},
      {"kinetix: 1\ntarget: {kind: fold, solid: tetrahedron}\nhinge: {model: elastic}\n"
       "tolerance: {force_N: 5}\n",
       4,
       12,
       "tolerance",
       {"Remove them for a solid"}},
      {"kinetix: 1\ntarget: {kind: space_curve, points: [[0, 0, 0], [10, 0, 0], [20, 0, 5]]}\n"
       "structure: {cell_mm: 100, cells: [9, 1]}\n",
       3,
       22,
       "structure.cell_mm",
       {"and the curve is 21.2 mm long"}},
      {kind("carpet"), 2, 16, "target.kind", {"allowed: curve, display, fold, helmet, outline"}},
      {kind("kurve"), 2, 16, "target.kind", {"did you mean `curve`?"}},
      {"kinetix: 1\ndesign: {theta_deg: 3}\n",
       1,
       1,
       "",
       {"design, not a target. Use it with simulate, verify, view or export"}},
      {target + "varables: {}\n", 3, 1, "varables", {"did you mean `variables`?", "allowed: kinetix, name"}},
      {target + "name: ../up\n", 3, 7, "name", {"letters, digits", "be the name of a folder"}},
      {target + "name: .hidden\n", 3, 7, "name", {"not starting with a point"}},
      {target + "name: a b\n", 3, 7, "name", {"letters, digits"}},
      {target + "name: ''\n", 3, 7, "name", {"is empty", "letters, digits"}},
      {target + "structure: {cell: 8}\n", 3, 13, "structure.cell", {"did you mean `cell_mm`?"}},
      {target + "structure: {cells: [1, 40]}\n", 3, 20, "structure.cells", {"at least 2 columns", "[40, 1]"}},
      {target + "structure: {cells: [40]}\n", 3, 20, "structure.cells", {"not a pair", "[columns, rows]"}},
      {target + "structure: {cells: 40}\n", 3, 20, "structure.cells", {"single value", "[columns, rows]"}},
      {target + "structure: {cells: []}\n", 3, 20, "structure.cells", {"is empty"}},
      {target + "structure: {cells: [0, 1]}\n", 3, 21, "structure.cells[0]", {"from 1 to 10000"}},
      {target + "structure: {cells: [9999, 9999]}\n", 3, 20, "structure.cells", {"a million"}},
      {target + "structure: {cells: [4.5, 1]}\n", 3, 21, "structure.cells[0]", {"whole number"}},
      {target + "structure: {cells: [[0, 0], [1, 0], [1, 1]]}\n", 3, 20, "structure.cells", {"rectangle"}},
      {target + "structure: {cells: [[0, 0], [0, 0]]}\n",
       3,
       29,
       "structure.cells[1]",
       {"[0, 0] is listed twice"}},
      {target + "structure: {cells: [[0, 0], [-1, 0]]}\n",
       3,
       30,
       "structure.cells[1][0]",
       {"from 0 to 9999"}},
      {target + "structure: {cell_mm: 120}\n",
       3,
       22,
       "structure.cell_mm",
       {"120 mm", "100 mm long", "millimetres", "Give smaller cells"}},
      {target + "structure: {cell_mm: 8 mm}\n", 3, 22, "structure.cell_mm", {"has a unit", "in mm"}},
      {target + "structure: {cell_mm: 0}\n", 3, 22, "structure.cell_mm", {"out of range", "in mm"}},
      {target + "structure: {cell_mm: 8, wall_mm: {thickness: 4}}\n",
       3,
       46,
       "structure.wall_mm.thickness",
       {"at least 0.000008 and below 4", "half of cell_mm"}},
      {target + "structure: {wall_mm: {height: -1}}\n",
       3,
       31,
       "structure.wall_mm.height",
       {"from 0.0001 to 10000", "in mm"}},
      {target + "structure: {wall_mm: 0.8}\n", 3, 22, "structure.wall_mm", {"thickness, height"}},
      {"kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [0.06, 0], [0.06, 0.04]]}\n",
       2,
       31,
       "target.points",
       {"the points span 0.06 mm", "Give `units: m` for 60 mm", "or `units: mm`"}},
      {"kinetix: 1\ntarget: {kind: curve, points: [[0, 0], [36000, 0], [36000, 9]]}\n",
       2,
       31,
       "target.points",
       {"the points span 36000 mm", "Give `units: 0.006`", "for 216 mm"}},
      {target + "variables: {gamma: 1}\n", 3, 13, "variables.gamma", {"allowed: tilt, fold_angle"}},
      {target + "variables: {beta: {range: [1, 2]}}\n", 3, 20, "variables.beta.range", {"`range_deg`"}},
      {target + "variables: {beta: {range_deg: [60, -60]}}\n",
       3,
       31,
       "variables.beta.range_deg",
       {"reversed"}},
      {target + "variables: {beta: {range_deg: [5, 5]}}\n", 3, 31, "variables.beta.range_deg", {"are equal"}},
      {target + "variables: {beta: {range_deg: [-90, 60]}}\n",
       3,
       32,
       "variables.beta.range_deg[0]",
       {"from -89 to 89, in degrees"}},
      {target + "variables: {beta: {range_deg: [-60, .nan]}}\n",
       3,
       37,
       "variables.beta.range_deg[1]",
       {"finite"}},
      {target + "variables: {beta: {range_deg: [-1rad, 1]}}\n",
       3,
       32,
       "variables.beta.range_deg[0]",
       {"unit", "in degrees"}},
      {target + "variables: {theta: {range_deg: [0, 44]}}\n",
       3,
       33,
       "variables.theta.range_deg[0]",
       {"above 0 and below 45, in degrees"}},
      {target + "variables: {theta: {range_deg: [2, 45]}}\n",
       3,
       36,
       "variables.theta.range_deg[1]",
       {"below 45"}},
      {target + "variables: {theta: {range_deg: 20}}\n",
       3,
       32,
       "variables.theta.range_deg",
       {"[lower, upper]"}},
      {target + "variables: {beta: {per: row}}\n",
       3,
       25,
       "variables.beta.per",
       {"`row` is not possible for a curve", "Give `column` or `all`"}},
      {target + "variables: {beta: {per: hinge}}\n",
       3,
       25,
       "variables.beta.per",
       {"`hinge` is not possible"}},
      {target + "variables: {beta: {per: colunm}}\n",
       3,
       25,
       "variables.beta.per",
       {"did you mean `column`?"}},
      {target + "variables: {beta: {symmetry: rotate_4}}\n",
       3,
       30,
       "variables.beta.symmetry",
       {"as many columns as rows", "[19, 1]"}},
      {target + "variables: {beta: {symmetry: mirror}}\n", 3, 30, "variables.beta.symmetry", {"mirror_x"}},
      {target + "tolerance: {shape: 0}\n", 3, 20, "tolerance.shape", {"above 0 and at most 1"}},
      {target + "tolerance: {verify: 2 %}\n", 3, 21, "tolerance.verify", {"has a unit", "at most 1"}},
      {target + "solver: {name: cerse}\n", 3, 16, "solver.name", {"did you mean `ceres`?", "bobyqa"}},
      {target + "solver: {starts: 0}\n", 3, 18, "solver.starts", {"from 1 to 10000"}},
      {target + "physics: {step_s: 0.5}\n", 3, 19, "physics.step_s", {"at most 0.1, in seconds"}},
      {target + "physics: {iterations: 100}\n", 3, 11, "physics.iterations", {"was removed", "`step_s`"}},
      {target + "physics: {error_reduction: 0.5}\n", 3, 11, "physics.error_reduction", {"was removed"}},
      {target + "physics: {reach_mm: 0}\n", 3, 21, "physics.reach_mm", {"from 0.0607", "in mm"}},
  };
  TemporaryFolder folder;
  const std::string file = folder.path("rib.yaml");
  for (const BadInput& bad : cases) {
    folder.write("rib.yaml", bad.text);
    expect_refused(bad, file, [&] { read_curve_target(file); });
  }
}

TEST(TargetFile, SurvivesRandomMutations) {
  TemporaryFolder folder;
  const std::string valid =
      target +
      "name: rib\nstructure: {cells: [12, 2], cell_mm: 8, wall_mm: {thickness: 0.8, height: 6}}\n"
      "variables: {beta: {range_deg: [-50, 40], per: all}, theta: {range_deg: [3, 30]}}\n"
      "tolerance: {shape: 0.03}\nsolver: {starts: 5}\nphysics: {step_s: 0.002}\n";
  std::mt19937 random(5);
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  int accepted = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string text = valid;
    for (std::size_t n = 1 + below(3); n > 0; --n)
      text[below(text.size())] = "0123456789.-e{}[],: \n#'ax"[below(25)];
    const auto path = folder.write("rib.yaml", text);
    try {
      const CurveFile file = read_curve_target(path);
      EXPECT_TRUE(file.columns >= 2 && file.beta.lower < file.beta.upper && file.size.edge_mm > 0);
      EXPECT_NO_THROW(make_structure(model::rectangle(2, 1), file.size));
      ++accepted;
    } catch (const InvalidInput& e) {
      EXPECT_EQ(e.place().file, path);
    }
  }
  EXPECT_GT(accepted, 50);
}

}  // namespace
}  // namespace kinetix::app
