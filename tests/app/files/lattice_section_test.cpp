#include "app/files/lattice_section.hpp"

#include <gmock/gmock.h>
#include <filesystem>
#include <random>
#include <tuple>

#include "app/files/design_file.hpp"
#include "model/lattice/planar/closed_boundary.hpp"
#include "tests/support/bad_input.hpp"
#include "tests/support/planar_graphs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace kinetix::app {
namespace {

using testing::BadInput;
using testing::expect_refused;
using ::testing::HasSubstr;
using testing::refusal;
using testing::TemporaryFolder;

// Two squares side by side.
const std::string two_squares =
    "vertices_mm: [[0, 0], [10, 0], [20, 0], [0, 10], [10, 10], [20, 10]],\n"
    "  walls: [[0, 1], [1, 2], [3, 4], [4, 5], [0, 3], [1, 4], [2, 5]]";

std::string structure(const std::string& keys) { return "kinetix: 1\nstructure: {" + keys + "}\n"; }

std::string line(double x0, double y0, double x1, double y1) {
  std::ostringstream text;
  text << "0\nLINE\n10\n" << x0 << "\n20\n" << y0 << "\n11\n" << x1 << "\n21\n" << y1 << "\n";
  return text.str();
}

std::string dxf(const std::string& entities) {
  return "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + entities +
         "0\nENDSEC\n0\nEOF\n";
}

// Two squares side by side, as a drawing.
const std::string drawn_squares =
    dxf(line(0, 0, 10, 0) + line(10, 0, 20, 0) + line(0, 10, 10, 10) + line(10, 10, 20, 10) +
        line(0, 0, 0, 10) + line(10, 0, 10, 10) + line(20, 0, 20, 10));

Design read_text(const std::string& text) {
  const TemporaryFolder folder;
  folder.write("squares.dxf", drawn_squares);
  return read_design(folder.write("sheet.yaml", text));
}

void expect_equal_designs(const Design& a, const Design& b) {
  const model::Lattice &s = a.structure, &r = b.structure;
  EXPECT_EQ(lattice_name(s), lattice_name(r));
  EXPECT_EQ(s.size().edge_mm, r.size().edge_mm);
  EXPECT_EQ(s.size().thickness_mm, r.size().thickness_mm);
  EXPECT_EQ(s.size().height_mm, r.size().height_mm);
  ASSERT_EQ(s.bodies(), r.bodies());
  ASSERT_EQ(s.hinges(), r.hinges());
  ASSERT_EQ(s.cells(), r.cells());
  for (int v = 0; v < s.bodies(); ++v) EXPECT_EQ(s.rest_position(v), r.rest_position(v)) << v;
  for (int c = 0; c < s.cells(); ++c) {
    EXPECT_EQ(cell_label(s, c), cell_label(r, c));
    EXPECT_TRUE(std::ranges::equal(s.cell_bodies(c), r.cell_bodies(c))) << c;
  }
  for (int h = 0; h < s.hinges(); ++h) {
    const model::HingeParameters &p = s.hinge(h), &q = r.hinge(h);
    EXPECT_EQ(wall_name(s, h), wall_name(r, h));
    EXPECT_TRUE(p.t == q.t && p.alpha == q.alpha && p.beta == q.beta && p.offset == q.offset) << h;
  }
  EXPECT_EQ(a.theta, b.theta);
  EXPECT_EQ(a.drive, b.drive);
}

// Structures of each kind, with the keys that each kind allows.
const std::string sheets[] = {
    "lattice: square, cells: [4, 3], cell_mm: 8.3",
    "lattice: honeycomb, cells: [4, 3]",
    "lattice: honeycomb, cells: [5, 4], rim: closed, cell_mm: 7.7, wall_mm: {thickness: 0.3, height: 3}",
    "lattice: honeycomb, cells: [[1, 0], [0, 0], [0, 1], [2, 1], [2, 0], [0, 2], [1, 2]]",
    "lattice: honeycomb, cells: [[1, 0], [0, 0]]",
    "lattice: brick, cells: [3, 4], rim: closed",
    "lattice: brick, cells: [[3, 1], [3, 2], [4, 2]], rim: open",
    "lattice: rhombus, cells: [4, 5]",
    "lattice: rhombus, cells: [5, 5], angle_deg: 75.52248781407008",
    "lattice: rhombus, cells: [[0, 0], [1, 0], [1, 1]], angle_deg: 117.3",
    "lattice: octagon, cells: [3, 3], cell_mm: 0.37",
    "lattice: octagon, cells: [4, 2], rim: closed",
    "lattice: graph, " + two_squares,
    "lattice: graph, " + two_squares + ", cell_mm: 3.3, wall_mm: {thickness: 0.1}",
    "lattice: graph, drawing: squares.dxf",
};

TEST(LatticeSection, SurvivesWritingAndReadingBitForBit) {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const std::string& keys : sheets)
    for (int round = 0; round < 8; ++round) {
      SCOPED_TRACE(keys + " seed 21 round " + std::to_string(round));
      Design file = read_text(structure(keys));
      const double edge = file.structure.size().edge_mm;
      for (int h = 0; h < file.structure.hinges(); ++h)
        if (random() % 3)
          file.structure.hinge(h) = {0.01 + 0.98 * unit(random), 0.1 + 2.9 * unit(random), unit(random) - 0.5,
                                     0.5 * edge * (unit(random) - 0.5) / edge};
      for (int h = 0; h < file.structure.hinges(); ++h)  // a file's offsets are limited to a number of mm
        file.structure.hinge(h).offset = std::round(1e6 * file.structure.hinge(h).offset * edge) / 1e6 / edge;
      file.theta = unit(random) - 0.5;
      if (round % 2) file.drive = model::HingeTurn{file.structure.hinges() - 1, 2 * unit(random) - 1};
      expect_equal_designs(read_text(design_text(file)), file);
    }
}

TEST(LatticeSection, KeepsVerticesOfAnyDrawingBitForBit) {
  std::mt19937 random(22);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int round = 0; round < 20; ++round) {
    const double edge = 0.1 + 30 * unit(random);
    model::PlanarGraph graph = testing::random_quads(4, round);
    for (Eigen::Vector2d& p : graph.vertices) p = (p * 17.3 + Eigen::Vector2d(-30, 5)) / edge;
    Design file{.name = "drawn", .structure = make_planar_structure(graph, {edge, edge / 10, edge})};
    const Design once = read_text(design_text(file));
    expect_equal_designs(read_text(design_text(once)), once);
    for (int v = 0; v < file.structure.bodies(); ++v)
      EXPECT_LE((once.structure.rest_position(v) - file.structure.rest_position(v)).norm(), 1e-13);
  }
}

// Regression: a file that gave one of the two sizes got the other from a sheet's defaults. Walls of 6 mm then
// overlapped in a block with 10 mm edges.
TEST(LatticeSection, GivesBlocksSlenderWallsWhicheverOfTheirSizesAFileGives) {
  for (const auto& [keys, thickness, height] : {std::tuple("", 1.0, 1.0),
                                                {", wall_mm: {thickness: 0.9}", 0.9, 1.0},
                                                {", wall_mm: {height: 2}", 1.0, 2.0}}) {
    const Design file = read_text(structure(std::string("lattice: sodalite, cells: [1, 1, 1]") + keys));
    EXPECT_EQ(file.structure.size().thickness_mm, thickness) << keys;
    EXPECT_EQ(file.structure.size().height_mm, height) << keys;
  }
}

// Regression: an exported pattern that gives its unit (mm) was read back with walls of 10 mm.
TEST(LatticeSection, KeepsTheSizeOfAPatternThatSaysItsUnit) {
  const std::string pattern = testing::read_file(std::string(KINETIX_SOURCE) + "/targets/shapes/miura.fold"),
                    none = "\"frame_unit\": \"unit\"";
  ASSERT_NE(pattern.find(none), std::string::npos);
  const auto sheet_of = [&](const std::string& unit, const std::string& keys) {
    std::string text = pattern;
    text.replace(text.find(none), none.size(), "\"frame_unit\": \"" + unit + "\"");
    const TemporaryFolder folder;
    folder.write("a.fold", text);
    return read_design(folder.write("a.yaml", structure("lattice: graph, origami: a.fold" + keys))).structure;
  };
  EXPECT_EQ(sheet_of("unit", "").size().edge_mm, 10);
  EXPECT_EQ(sheet_of("cm", ", cell_mm: 4").size().edge_mm, 4);
  const model::Lattice sheet = sheet_of("cm", "");
  EXPECT_NEAR(sheet.size().edge_mm, 10 * sheet_of("mm", "").size().edge_mm, 1e-9);
  double left = sheet.rest_position(0).x(), right = left;
  for (int v = 0; v < sheet.bodies(); ++v) {
    left = std::min(left, sheet.rest_position(v).x());
    right = std::max(right, sheet.rest_position(v).x());
  }
  // Six facets of 10 mm slant by 4.2 mm. Bodies are within them, by less than half a facet at either boundary.
  EXPECT_LT(right - left, 64.2);
  EXPECT_GT(right - left, 54.2);
}

TEST(LatticeSection, DrawsTheSameByListAndByDrawing) {
  const Design listed = read_text(structure("lattice: graph, " + two_squares)),
               drawn = read_text(structure("lattice: graph, drawing: squares.dxf"));
  EXPECT_EQ(drawn.structure.size().edge_mm, 10) << "the mean length of the walls";
  ASSERT_EQ(drawn.structure.bodies(), 6);
  for (int v = 0; v < 6; ++v) EXPECT_EQ(drawn.structure.rest_position(v), listed.structure.rest_position(v));
  EXPECT_EQ(drawn.structure.cells(), 2);
}

TEST(LatticeSection, RefusesAGapThatIsLongerThanItsOwnWall) {
  const std::string oblong = structure(
      "lattice: graph, vertices_mm: [[0, 0], [20, 0], [0, 5], [20, 5]], walls: [[0, 1], [2, 3], [0, 2], [1, "
      "3]]");
  const std::string hinge = "hinge: {kind: block, material: tango, thickness_mm: 0.5, height_mm: 4, gap_mm: ";
  EXPECT_EQ(read_text(oblong + hinge + "4.9}\n").hinge.made->gap_mm, 4.9);
  try {
    read_text(oblong + hinge + "6}\n");
    FAIL() << "no error";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("the gap of 6 mm does not fit on wall"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("5 mm long. Give a smaller gap_mm"));
  }
}

TEST(LatticeSection, DrawsRegularLatticesAsTheModelDoes) {
  const Design file = read_text(structure("lattice: honeycomb, cells: [4, 3], rim: closed, cell_mm: 20") +
                                "design: {hinges: [{wall: [0, 4], t: 0.25, offset_mm: 3}]}\n");
  const model::PlanarGraph graph = closed_boundary(lattice_graph(model::honeycomb_lattice, 4, 3));
  ASSERT_EQ(file.structure.bodies(), static_cast<int>(graph.vertices.size()));
  EXPECT_EQ(file.structure.planar()->graph.edges, graph.edges);
  EXPECT_EQ(file.structure.size().edge_mm, 20);
  EXPECT_EQ(file.structure.hinge(0).t, 0.25);
  EXPECT_DOUBLE_EQ(file.structure.hinge(0).offset, 0.15);
  EXPECT_NEAR(
      read_text(structure("lattice: rhombus, cells: [1, 1], angle_deg: 90")).structure.rest_position(3).x(),
      10, 1e-12);
}

TEST(LatticeSection, ClosesTheRimOfADrawing) {
  const std::string hexagon =
      "vertices_mm: [[2, 0], [1, 1.7], [-1, 1.7], [-2, 0], [-1, -1.7], [1, -1.7]],\n"
      "  walls: [[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [5, 0]]";
  EXPECT_EQ(read_text(structure("lattice: graph, " + hexagon)).structure.hinges(), 6);
  const Design closed = read_text(structure("lattice: graph, " + hexagon + ", rim: closed"));
  EXPECT_EQ(closed.structure.hinges(), 7);
  EXPECT_EQ(closed.structure.cells(), 2);
  expect_equal_designs(read_text(design_text(closed)), closed);
}

TEST(LatticeSection, SaysWhereAndWhatIsAllowed) {
  const std::string honeycomb = structure("lattice: honeycomb, cells: [3, 3]");
  const auto graph = [](const std::string& vertices, const std::string& walls) {
    return structure("lattice: graph, vertices_mm: [" + vertices + "], walls: [" + walls + "]");
  };
  const std::string square = "[0, 0], [9, 0], [9, 9], [0, 9]", round = "[0, 1], [1, 2], [2, 3], [3, 0]";
  const auto drawing = [](const std::string& file) { return structure("lattice: graph, drawing: " + file); };
  const std::vector<BadInput> cases = {
      {structure("lattice: honeycom, cells: [3, 3]"),
       2,
       22,
       "structure.lattice",
       {"did you mean `honeycomb`?"}},
      {structure("lattice: kagome, cells: [3, 3]"),
       2,
       22,
       "structure.lattice",
       {"square, honeycomb, brick, rhombus, octagon, graph"}},
      {graph("[0, 0], [9, 0], [0, 9]", "[0, 1], [1, 2], [2, 0]"),
       2,
       12,
       "structure",
       {"the face of vertices 0, 1, 2 has 3 walls", "an even number"}},
      {graph(square, "[0, 2], [1, 3], [0, 1]"),
       2,
       12,
       "structure",
       {"from vertex 0 to 2 crosses the wall from vertex 1 to 3"}},
      {graph(square, round + ", [2, 2]"), 2, 12, "structure", {"from vertex 2 to 2 has no length"}},
      {graph(square + ", [0, 0]", round + ", [0, 4]"), 2, 12, "structure", {"has no length"}},
      {graph(square, round + ", [1, 0]"), 2, 12, "structure", {"from vertex 1 to 0 is there twice"}},
      {graph(square, "[0, 1], [2, 3]"), 2, 12, "structure", {"are not connected"}},
      {graph(square + ", [4.5, 0], [4.5, -3]", round + ", [4, 5]"),
       2,
       12,
       "structure",
       {"vertex 4", "lies on the wall from vertex 0 to 1"}},
      {graph(square, ""), 2, 12, "structure", {"a wall between them"}},
      {graph(square, "[0, 4]"), 2, 88, "structure.walls[0][1]", {"0 to 3"}},
      {graph("[0, 0, 0], [1, 0]", "[0, 1]"), 2, 43, "structure.vertices_mm[0]", {"a point [x, y] in mm"}},
      {graph("[0, 0], [2e6, 0]", "[0, 1]"), 2, 52, "structure.vertices_mm[1][0]", {"-1000000 to 1000000"}},
      {structure("lattice: graph, vertices_mm: [[0, 0], [1, 0]]"),
       2,
       12,
       "structure",
       {"`walls` is missing"}},
      {structure("lattice: graph"), 2, 12, "structure", {"`drawing` is missing", "DXF or SVG"}},
      {drawing("squares.dxf, walls: [[0, 1]]"), 2, 51, "structure.walls", {"allowed"}},
      {drawing("panel.pdf"), 2, 38, "structure.drawing", {".dxf or .svg"}},
      {drawing("triangle.dxf"), 2, 38, "structure.drawing", {"has 3 walls"}},
      {structure("lattice: honeycomb, cells: [3, 3], angle_deg: 60"),
       2,
       48,
       "structure.angle_deg",
       {"cells of lattice: honeycomb have one shape only"}},
      {structure("lattice: rhombus, cells: [3, 3], angle_deg: 20"),
       2,
       57,
       "structure.angle_deg",
       {"30 to 150"}},
      {structure("cells: [3, 3], rim: closed"), 2, 28, "structure.rim", {"allowed: lattice, cells"}},
      {structure("lattice: square, cells: [3, 3], rim: closed"), 2, 45, "structure.rim", {"allowed"}},
      {structure("lattice: honeycomb, cells: [3, 3], rim: shut"), 2, 53, "structure.rim", {"open, closed"}},
      {structure("lattice: honeycomb"), 2, 12, "structure", {"`cells` is missing"}},
      {structure("lattice: honeycomb, cells: [[0, 0], [1, 0], [0, 0]]"),
       2,
       57,
       "structure.cells[2]",
       {"cell [0, 0] is listed twice"}},
      {structure("lattice: rhombus, cells: [[0, 0], [1, 1]]"),
       2,
       38,
       "structure.cells",
       {"cells [0, 0] and [1, 1]", "are not connected by a wall"}},
      {structure("lattice: honeycomb, cells: [[0, 0], [3, 3]]"),
       2,
       40,
       "structure.cells",
       {"are not connected"}},
      {honeycomb + "design: {pattern: {even: {P: [0.5, 0.5, 0.5, 0.5]}}}\n",
       3,
       10,
       "design.pattern",
       {"cells of four walls", "honeycomb"}},
      {honeycomb + "drive: {kind: plates, compression: 0.1, grip: [[0, 0], [1, 1]]}\n",
       3,
       41,
       "drive.grip",
       {"rectangle of squares", "plates then grip the boundary"}},
      {honeycomb + "design: {hinges: [{wall: [3, 0]}]}\n",
       3,
       26,
       "design.hinges[0].wall",
       {"runs the other way. Write [0, 3]"}},
      {honeycomb + "design: {hinges: [{wall: [0, 1]}]}\n",
       3,
       26,
       "design.hinges[0].wall",
       {"no wall joins vertices 0 and 1"}},
      {honeycomb + "design: {hinges: [{wall: [0, 99]}]}\n", 3, 30, "design.hinges[0].wall[1]", {"0 to 29"}},
      {honeycomb + "design: {hinges: [{wall: [[0, 0], [1, 0]]}]}\n", 3, 27, "design.hinges[0].wall[0]", {}},
      {honeycomb + "design: {hinges: [{wall: [0, 3]}, {wall: [0, 3]}]}\n",
       3,
       35,
       "design.hinges[1]",
       {"listed twice, first in line 3"}},
      {honeycomb + "drive: {kind: hinge, wall: [0, 1], angle_deg: 20}\n",
       3,
       28,
       "drive.wall",
       {"no wall joins"}},
      {structure("cell_mm: 10, lattice: graph, vertices_mm: [[0, 0], [3, 0], [3, 15], [0, 15]],\n"
                 "  walls: [[0, 1], [1, 2], [2, 3], [3, 0]]") +
           "design: {hinges: [{wall: [0, 1], offset_mm: 2}]}\n",
       4,
       18,
       "design.hinges",
       {"offset of the hinge on wall [0, 1] is 0.2", "half the wall's length"}},
  };
  const TemporaryFolder folder;
  folder.write("squares.dxf", drawn_squares);
  folder.write("triangle.dxf", dxf(line(0, 0, 9, 0) + line(9, 0, 0, 9) + line(0, 9, 0, 0)));
  for (const BadInput& bad : cases) {
    const std::string file = folder.write("sheet.yaml", bad.text);
    expect_refused(bad, file, [&] { read_design(file); });
  }
}

TEST(LatticeSection, TakesUnitScaleAndJoiningOfADrawing) {
  const TemporaryFolder folder;
  // A square whose second wall begins beyond the end of the first.
  const std::string plain = "0\nSECTION\n2\nENTITIES\n" + line(0, 0, 1, 0) + line(1, 0.01, 1, 1) +
                            line(1, 1, 0, 1) + line(0, 1, 0, 0) + "0\nENDSEC\n0\nEOF\n";
  folder.write("plain.dxf", plain);
  const auto read = [&](const std::string& keys) {
    return read_design(folder.write("sheet.yaml", structure("lattice: graph, drawing: plain.dxf" + keys)))
        .structure;
  };
  EXPECT_THAT(refusal([&] { read(""); }), HasSubstr("would measure 1 x 1 mm (mm, assumed because"));
  EXPECT_THAT(refusal([&] { read(", unit: in"); }), HasSubstr("Set structure.join_mm: 0.28"));
  const model::Lattice sheet = read(", unit: in, scale: 2, join_mm: 1");
  EXPECT_EQ(sheet.bodies(), 4);
  EXPECT_NEAR(sheet.rest_position(1).x() - sheet.rest_position(0).x(), 2 * 25.4, 1e-9);
  EXPECT_THAT(refusal([&] { read(", unit: furlong"); }), HasSubstr("structure.unit"));
  EXPECT_THAT(refusal([&] { read(", join_mm: 0"); }), HasSubstr("structure.join_mm"));
}

TEST(LatticeSection, SplitsAndMergesTheLinesOfADrawing) {
  const TemporaryFolder folder;
  // A frame of 20 mm with a cross in it, drawn as long lines that overlap.
  folder.write("grid.dxf",
               dxf(line(0, 0, 20, 0) + line(20, 0, 20, 20) + line(0, 20, 20, 20) + line(0, 0, 0, 20) +
                   line(10, 0, 10, 20) + line(0, 10, 20, 10) + line(10, 0, 15, 0)));
  const model::Lattice sheet =
      read_design(folder.write("sheet.yaml", structure("lattice: graph, drawing: grid.dxf"))).structure;
  EXPECT_EQ(sheet.bodies(), 9);
  EXPECT_EQ(sheet.hinges(), 12);
}

TEST(LatticeSection, NamesTheDrawingThatItCannotRead) {
  const TemporaryFolder folder;
  folder.write("arc.dxf", dxf("0\nARC\n10\n0\n20\n0\n40\n5\n"));
  folder.write("circle.svg", "<svg width='9mm' viewBox='0 0 9 9'><circle r='5'/></svg>");
  folder.write("curved.svg", "<svg width='9mm' viewBox='0 0 9 9'><path d='M0 0 Q1 1 2 0'/></svg>");
  const std::pair<BadInput, std::string> cases[] = {
      {{"arc.dxf", 16, 1, "", {"(ARC) is not a wall. Draw straight walls"}}, "arc.dxf"},
      {{"circle.svg", 1, 1, "", {"the curve near (5, 0) mm (circle)"}}, "circle.svg"},
      {{"curved.svg", 1, 1, "", {"(curved path)"}}, "curved.svg"},
      {{"nothing.dxf", 0, 0, "", {"no such file"}}, "nothing.dxf"},
  };
  for (const auto& [bad, name] : cases) {
    const std::string file = folder.write("sheet.yaml", structure("lattice: graph, drawing: " + name));
    expect_refused(bad, folder.path(name), [&] { read_design(file); });
  }
}

}  // namespace
}  // namespace kinetix::app
