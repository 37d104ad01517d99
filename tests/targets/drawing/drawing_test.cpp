#include "targets/drawing/drawing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>
#include <sstream>

#include "tests/support/bad_input.hpp"
#include "tests/support/drawings.hpp"
#include "tests/support/temporary_folder.hpp"

namespace kinetix::targets {
namespace {

using ::testing::AllOf;
using testing::dxf_file;
using testing::dxf_line;
using testing::dxf_unit;
using ::testing::HasSubstr;
using testing::refusal;
using testing::svg_file;
using testing::TemporaryFolder;

// Every kind of entity once, so that damage may fall on each.
const std::string small_dxf =
    dxf_file("0\nLWPOLYLINE\n90\n4\n70\n1\n10\n0\n20\n0\n10\n2\n20\n0\n42\n0.5\n10\n2\n20\n2\n" +
                 dxf_line(0, 0, -1, -1) +
                 "0\nPOLYLINE\n70\n1\n0\nVERTEX\n10\n4\n20\n4\n0\nVERTEX\n10\n5\n20\n4\n0\nSEQEND\n"
                 "0\nARC\n10\n0\n20\n0\n40\n3\n50\n0\n51\n9\n0\nELLIPSE\n10\n0\n20\n0\n11\n3\n21\n0\n"
                 "0\nSPLINE\n71\n1\n40\n0\n40\n0\n40\n1\n40\n1\n10\n0\n20\n0\n10\n1\n20\n1\n"
                 "0\nINSERT\n2\nB\n10\n1\n20\n1\n41\n2\n50\n30\n",
             dxf_unit(4),
             "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nB\n10\n0\n20\n0\n" + dxf_line(0, 0, 1, 2) +
                 "0\nENDBLK\n0\nENDSEC\n");

TEST(DxfDrawing, CutOffIsRefusedWhereverItIsCut) {
  ASSERT_GT(parse_dxf(small_dxf).lines.size(), 6u);
  for (std::size_t length = 0; length + 1 < small_dxf.size(); ++length)
    EXPECT_THROW(parse_dxf(small_dxf.substr(0, length)), InvalidInput) << length;
}

// Every element and transform once, so that damage may fall on each.
const std::string small_svg = svg_file(
    "<style>.a{stroke:red;display:inline}</style><defs><g id='u'><circle r='2'/></g></defs>"
    "<g transform='translate(1 2) rotate(30) matrix(1 0 0 1 2 3) skewX(3)'><line x1='1' y1='2' x2='3mm' "
    "y2='4'/>"
    "<polyline class='a' points='0,0 1,0 1,1'/><rect x='1' y='2' width='3' height='4' rx='1'/><path d='m1 1 "
    "2 0 0 "
    "2h-2v-2zC1 2 3 4 5 6S1 2 3 4Q1 2 3 4T5 6A1 2 3 0 1 5 7'/><use href='#u' x='3'/></g>");

/// Returns whether a damaged file gives finite lines, or an error message; anything else ends the test.
template <class Parse>
bool is_read(const std::string& text, const Parse& parse) {
  try {
    for (const DrawnLine& line : parse(text).lines)
      EXPECT_TRUE(line.from.allFinite() && line.to.allFinite()) << text;
    return true;
  } catch (const InvalidInput& e) {
    EXPECT_NE(std::string(e.what()), "");
    return false;
  }
}

template <class Parse>
void expect_no_harm(const std::string& good, unsigned seed, const Parse& parse) {
  for (std::size_t length = 0; length < good.size(); ++length) is_read(good.substr(0, length), parse);
  std::mt19937 random(seed);
  const std::string likely = "0123456789-+.e \n\"'<>/=MLHVZzmlhv()CELINE\xff";
  int kept = 0;
  for (int round = 0; round < 4000; ++round) {
    SCOPED_TRACE("seed " + std::to_string(seed) + " round " + std::to_string(round));
    std::string text = good;
    for (unsigned change = 0; change <= random() % 4; ++change) {
      const std::size_t at = random() % text.size();
      const char c = random() % 2 ? likely[random() % likely.size()] : static_cast<char>(random());
      if (random() % 3 == 0)
        text.erase(at, 1 + random() % 5);
      else if (random() % 2)
        text.insert(at, 1, c);
      else
        text[at] = c;
    }
    kept += is_read(text, parse);
  }
  EXPECT_GT(kept, 100) << "some changes do no harm";
  EXPECT_LT(kept, 3900) << "some do";
}

TEST(Drawing, DamagedGivesLinesOrARefusal) {
  expect_no_harm(small_dxf, 5, parse_dxf);
  expect_no_harm(small_svg, 6, parse_svg);
}

/// Returns what was understood of a drawing that a document names, with settings.
DrawnWalls examine(const std::string& name, const std::string& content,
                   const DrawingSettings& settings = {}) {
  const TemporaryFolder folder;
  if (!content.empty()) folder.write(name, content);
  const Node root = parse_document("drawing: " + name + "\n", folder.path("design.yaml"));
  return examine_drawing(root.required("drawing", "a file"), settings);
}

/// Returns the error message for a drawing that a document names.
std::string refusal_of(const std::string& name, const std::string& content,
                       const DrawingSettings& settings = {}) {
  return refusal([&] {
    const DrawnWalls walls = examine(name, content, settings);
    if (walls.fault) throw InvalidInput(*walls.fault);
  });
}

// Two cells of 10 mm as a frame and a wall across it.
const std::string two_cells =
    svg_file("<rect x='10' y='10' width='20' height='10'/><line x1='20' y1='10' x2='20' y2='20'/>");

TEST(ReadDrawing, NumbersVerticesFromBelowAndFromTheLeft) {
  const DrawnWalls walls = examine("panel.svg", two_cells);
  ASSERT_FALSE(walls.fault) << walls.fault->what();
  const std::vector<Eigen::Vector2d> expected = {{10, -20}, {20, -20}, {30, -20},
                                                 {10, -10}, {20, -10}, {30, -10}};
  ASSERT_EQ(walls.graph.vertices.size(), expected.size());
  for (std::size_t v = 0; v < expected.size(); ++v)
    EXPECT_LE((walls.graph.vertices[v] - expected[v]).norm(), 1e-9) << v;
  EXPECT_EQ(walls.graph.edges,
            (std::vector<model::GraphEdge>{{0, 1}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {4, 5}}));
  EXPECT_EQ(walls.unit, "1 unit = 1 mm (width 100mm)");
}

/// Ends are off by a thousandth of a millimetre, as in files of three decimals. Plates still press on a whole side.
TEST(ReadDrawing, StraightensSides) {
  const DrawnWalls walls =
      examine("panel.dxf", dxf_file(dxf_line(0, 0.001, 10, 0) + dxf_line(10, 0, 20, 0.001) +
                                        dxf_line(0.001, 10, 10.001, 10.001) +
                                        dxf_line(10.001, 10.001, 20.001, 10) + dxf_line(0, 0.001, 0.001, 10) +
                                        dxf_line(10, 0, 10.001, 10.001) + dxf_line(20, 0.001, 20.001, 10),
                                    dxf_unit(4)));
  ASSERT_EQ(walls.graph.vertices.size(), 6u);
  for (int v = 0; v < 6; ++v) EXPECT_EQ(walls.graph.vertices[v].y(), v < 3 ? 0 : 10.001) << v;
  for (const int v : {0, 3}) EXPECT_EQ(walls.graph.vertices[v].x(), 0) << v;
  for (const int v : {2, 5}) EXPECT_EQ(walls.graph.vertices[v].x(), 20.001) << v;
}

TEST(ReadDrawing, NamesTheUnitThatItAssumes) {
  const DrawnWalls dxf = examine("panel.dxf", dxf_file(dxf_line(0, 0, 10, 0) + dxf_line(10, 0, 10, 20)));
  EXPECT_EQ(dxf.unit, "1 unit = 1 mm (mm, assumed because the file has no $INSUNITS)");
  const DrawnWalls svg =
      examine("panel.svg", "<svg width='100%' viewBox='0 0 96 96'><path d='M0 0H96V96'/></svg>");
  EXPECT_THAT(svg.unit, HasSubstr("1 unit = 0.2646 mm (px of 1/96 inch, assumed because"));
  EXPECT_NEAR(svg.graph.vertices[2].x(), 25.4, 1e-9);
}

/// A way to write the unit of a drawing whose longer side has `number` in the file and is `mm` long.
struct WrittenUnit {
  std::string file;    ///< attributes of an SVG, or the header of a DXF file
  double number;       ///< in the file
  double mm;           ///< its length
  std::string source;  ///< part of the words about the unit
  DrawingSettings settings = {};
  std::string before = {};  ///< the svg element
};

void expect_unit(const WrittenUnit& way, bool is_svg) {
  std::ostringstream number;
  number.precision(17);
  number << way.number;
  const std::string elements = "<path d='M0 0H" + number.str() + "'/>",
                    groups = "0\nLINE\n10\n0\n20\n0\n11\n" + number.str() + "\n21\n0\n",
                    file = is_svg ? way.before + "<svg " + way.file + ">" + elements + "</svg>"
                                  : dxf_file(groups, way.file);
  const DrawnWalls walls = examine(is_svg ? "way.svg" : "way.dxf", file, way.settings);
  ASSERT_FALSE(walls.fault) << way.file << walls.fault->what();
  EXPECT_NEAR(walls.lines[0].to.x(), way.mm, 1e-6 * way.mm) << way.file;
  EXPECT_THAT(walls.unit, HasSubstr(way.source)) << way.file;
}

TEST(ReadDrawing, HasTheSizeOfSvgInEachWayToWriteItsUnit) {
  const std::string box = " viewBox='0 0 200 120'", old = " inkscape:version='0.91 r13725'",
                    comment = "<!-- Generator: Adobe Illustrator 24.0, SVG Export Plug-In -->";
  const double inch = 25.4, px = inch / 96;
  const WrittenUnit ways[] = {
      {"width='100mm' height='60mm'" + box, 200, 100, "width 100mm"},
      {"width='10cm' height='6cm'" + box, 200, 100, "width 10cm"},
      {"width='4in' height='2.4in'" + box, 200, 101.6, "width 4in"},
      {"width='288pt' height='172.8pt'" + box, 200, 101.6, "width 288pt"},
      {"width='24pc' height='14.4pc'" + box, 200, 101.6, "width 24pc"},
      {"width='400Q' height='240Q'" + box, 200, 100, "width 400Q"},
      {"width='384px' height='230.4px'" + box, 200, 101.6, "px of 1/96 inch"},
      {"width='384' height='230.4'" + box, 200, 101.6, "assumed because width and height have no unit"},
      {"width='100MM' height='60MM'" + box, 200, 100, "width 100mm"},
      {"width='100 mm' height='60 mm'" + box, 200, 100, "width 100mm"},
      {"width='100mm'" + box, 200, 100, "width 100mm"},
      {"height='60mm'" + box, 200, 100, "height 60mm"},
      {"width='100%' height='60mm'" + box, 200, 100, "height 60mm"},
      {"width='200mm' height='60mm'" + box, 200, 100, "width 200mm"},
      {"style='width: 100mm; height: 60mm'" + box, 200, 100, "width 100mm"},
      {"width='378' height='227' style='width: 100mm; height: 60mm'" + box, 200, 100, "width 100mm"},
      {"width='100mm' height='60mm' style='width: 100%'" + box, 200, 100, "width 100mm"},
      {"width='100mm' height='60mm'", 100, 100 * px, "px of 1/96 inch"},
      {"width='100%' height='100%'" + box, 200, 200 * px, "assumed because width and height are not lengths"},
      {"width='auto'" + box, 200, 200 * px, "assumed because width and height are not lengths"},
      {"width='10em'" + box, 200, 200 * px, "assumed because width and height are not lengths"},
      {box, 200, 200 * px, "assumed because the file has no width and height"},
      {"", 200, 200 * px, "assumed because the file has no width and height"},
      {"width='300px'" + box, 200, 300 * inch / 72, "px of 1/72 inch", {}, comment},
      {"x='0px' y='0px'" + box, 72, inch, "px of 1/72 inch, as in files of Illustrator"},
      {"width='100mm'" + box, 200, 100, "width 100mm", {}, comment},
      {"width='744' inkscape:version='1.2.2'", 100, 100 * px, "px of 1/96 inch, as in files of Inkscape"},
      {"width='744'" + old, 90, inch, "px of 1/90 inch, as in files of Inkscape before 0.92"},
      {"width='210mm' height='297mm'" + old, 90, inch, "px of 1/90 inch"},
      {"width='210mm' viewBox='0 0 210 297'" + old, 100, 100, "width 210mm"},
      {box, 10, 100, "structure.unit", {.unit_mm = 10}},
      {"width='200in'" + box, 100, 100, "structure.unit", {.unit_mm = 1}},
      {"width='100mm'" + box, 20, 100, "width 100mm, structure.scale", {.scale = 10}},
      {box, 2, 101.6, "structure.unit, structure.scale", {.unit_mm = inch, .scale = 2}}};
  for (const WrittenUnit& way : ways) expect_unit(way, true);
}

TEST(ReadDrawing, HasTheSizeOfDxfInEachUnit) {
  const double survey_foot = 1200.0 / 3937 * 1000;
  const double unit_mm[] = {25.4,
                            304.8,
                            1609344,
                            1,
                            10,
                            1000,
                            1e6,
                            25.4e-6,
                            0.0254,
                            914.4,
                            1e-7,
                            1e-6,
                            1e-3,
                            100,
                            1e4,
                            1e5,
                            1e12,
                            1.495978707e14,
                            9.4607304725808e18,
                            3.0856775814913673e19,
                            survey_foot,
                            survey_foot / 12,
                            3 * survey_foot,
                            5280 * survey_foot};
  for (int k = 0; k < 24; ++k)
    expect_unit({dxf_unit(k + 1), 100 / unit_mm[k], 100, "$INSUNITS " + std::to_string(k + 1) + ", "}, false);
  for (const int k : {0, 25}) expect_unit({dxf_unit(k), 100, 100, "mm, assumed because $INSUNITS"}, false);
  expect_unit({"", 100, 100, "mm, assumed because the file has no $INSUNITS"}, false);
  expect_unit({"9\n$MEASUREMENT\n70\n0\n", 100, 100, "mm, assumed because"}, false);
  expect_unit({dxf_unit(6), 100, 100, "structure.unit", {.unit_mm = 1}}, false);
}

TEST(ReadDrawing, TakesUnitAndScaleOfTheDocument) {
  const std::string file = dxf_file(dxf_line(0, 0, 2, 0) + dxf_line(2, 0, 2, 1));
  const DrawnWalls inches = examine("panel.dxf", file, {.unit_mm = 25.4});
  EXPECT_NEAR(inches.graph.vertices[1].x(), 50.8, 1e-9);
  EXPECT_EQ(inches.unit, "1 unit = 25.4 mm (structure.unit)");
  const DrawnWalls larger = examine("panel.svg", two_cells, {.scale = 10});
  EXPECT_NEAR(larger.graph.vertices[0].x(), 100, 1e-9);
  EXPECT_EQ(larger.unit, "1 unit = 10 mm (width 100mm, structure.scale)");
}

TEST(ReadDrawing, QuestionsUnusualSizes) {
  const std::string lines = dxf_line(0, 0, 100, 0) + dxf_line(100, 0, 100, 50);
  EXPECT_THAT(
      refusal_of("panel.dxf", dxf_file(lines, dxf_unit(6))),
      AllOf(HasSubstr("would measure 1e+05 x 5e+04 mm ($INSUNITS 6, m)"), HasSubstr("Set structure.unit")));
  EXPECT_THAT(refusal_of("panel.dxf", dxf_file(lines, dxf_unit(13))), HasSubstr("unusual"));
  EXPECT_EQ(refusal_of("panel.dxf", dxf_file(lines, dxf_unit(6)), {.unit_mm = 1000}), "");
}

TEST(ReadDrawing, NamesTheLineOfCurves) {
  EXPECT_THAT(refusal_of("panel.dxf", dxf_file("0\nARC\n10\n0\n20\n0\n40\n5\n", dxf_unit(4))),
              AllOf(HasSubstr("panel.dxf:16:1"),
                    HasSubstr("the curve near (5, 0) mm (ARC) is not a wall. Draw straight")));
  const DrawnWalls walls =
      examine("panel.svg", svg_file("<path d='M0 0H9'/>\n<circle cx='9' cy='9' r='5'/>"));
  ASSERT_TRUE(walls.fault);
  EXPECT_THAT(walls.fault->what(), AllOf(HasSubstr("panel.svg:3:1"), HasSubstr("(circle) is not a wall")));
  EXPECT_GT(walls.marks.size(), 3u);
}

// Ends miss each other by 0.06 mm, at walls of 10 mm.
const std::string loose = dxf_file(dxf_line(0, 0, 10, 0) + dxf_line(10, 0.06, 10, 10) +
                                       dxf_line(10.06, 10, 0, 10) + dxf_line(0, 10.06, 0, 0.06),
                                   dxf_unit(4));

TEST(ReadDrawing, AdvisesAJoiningDistanceThatSuffices) {
  const DrawnWalls walls = examine("panel.dxf", loose);
  ASSERT_TRUE(walls.fault);
  EXPECT_FALSE(walls.marks.empty());
  const std::string message = walls.fault->what(), mark = "Set structure.join_mm: ";
  EXPECT_THAT(message, AllOf(HasSubstr("0.06 mm apart"), HasSubstr("joined up to 0.02 mm"), HasSubstr(mark)));
  const double advised = std::stod(message.substr(message.find(mark) + mark.size()));
  EXPECT_LT(advised, 0.2);
  const DrawnWalls joined = examine("panel.dxf", loose, {.join_mm = advised});
  EXPECT_FALSE(joined.fault);
  EXPECT_EQ(joined.graph.vertices.size(), 4u);
  EXPECT_EQ(joined.graph.edges.size(), 4u);
}

TEST(ReadDrawing, NamesTheFileAtFault) {
  EXPECT_THAT(refusal_of("panel.pdf", "x"), AllOf(HasSubstr("design.yaml:1:10"), HasSubstr(".dxf or .svg")));
  EXPECT_THAT(refusal_of("panel.dxf", ""), HasSubstr("panel.dxf"));
  EXPECT_THAT(refusal_of("panel.dxf", dxf_file("0\nREGION\n8\n0\n")), HasSubstr("panel.dxf:6:1"));
  EXPECT_THAT(refusal_of("panel.svg", svg_file("")), HasSubstr("has no lines"));
}

TEST(ReadDrawing, RefusesDrawingsWithoutSizeAndBeyondAllSize) {
  const DrawingSettings mm{.unit_mm = 1};
  EXPECT_THAT(refusal_of("panel.dxf", dxf_file(dxf_line(3, 3, 3, 3)), mm),
              HasSubstr("no lines with a length"));
  EXPECT_THAT(refusal_of("panel.dxf", dxf_file(dxf_line(0, 0, 1, 0) + dxf_line(1, 0, 1e300, 0)), mm),
              HasSubstr("a kilometre"));
  EXPECT_THAT(refusal_of("panel.dxf", dxf_file(dxf_line(0, 0, 1e307, 0), dxf_unit(6))),
              HasSubstr("a kilometre"));
}

}  // namespace
}  // namespace kinetix::targets
