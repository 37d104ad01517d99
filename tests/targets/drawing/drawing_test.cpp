#include "targets/drawing/drawing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

#include "tests/support/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"

namespace kinetix::targets {
namespace {

using ::testing::HasSubstr;
using testing::refusal;
using testing::TemporaryFolder;

constexpr double pixel_mm = 25.4 / 96;  // mm of a CSS pixel: an inch has 96

std::string dxf(const std::string& entities, const std::string& header = "") {
  return (header.empty() ? "" : "0\nSECTION\n2\nHEADER\n" + header + "0\nENDSEC\n") +
         "0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
}

std::string line(double x0, double y0, double x1, double y1) {
  std::ostringstream text;
  text << "0\nLINE\n8\n0\n10\n"
       << x0 << "\n20\n"
       << y0 << "\n30\n0\n11\n"
       << x1 << "\n21\n"
       << y1 << "\n31\n0\n";
  return text.str();
}

std::string units(int number) { return "9\n$INSUNITS\n70\n" + std::to_string(number) + "\n"; }

/// A drawing of 100 mm x 80 mm in user units of a millimetre.
std::string svg(const std::string& elements) {
  return "<?xml version=\"1.0\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100mm\" height=\"80mm\" "
         "viewBox=\"0 0 100 80\">" +
         elements + "</svg>\n";
}

void expect_lines(const Drawing& found, const std::vector<std::array<double, 4>>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k)
    for (int end = 0; end < 2; ++end)
      for (int i = 0; i < 2; ++i)
        EXPECT_NEAR(found[k][end][i], expected[k][2 * end + i], 1e-9) << "line " << k << ", end " << end;
}

// Flags and corners of a closed polyline.
const std::string square_of_lines = "70\n1\n10\n0\n20\n0\n10\n2\n20\n0\n10\n2\n20\n2\n10\n0\n20\n2\n";

TEST(DxfDrawing, HasTheLinesOfItsEntities) {
  expect_lines(parse_dxf(dxf(line(1, 2, 3.5, -4))), {{1, 2, 3.5, -4}});
  expect_lines(parse_dxf(dxf("0\nLWPOLYLINE\n90\n4\n" + square_of_lines)),
               {{0, 0, 2, 0}, {2, 0, 2, 2}, {2, 2, 0, 2}, {0, 2, 0, 0}});
  expect_lines(
      parse_dxf(dxf("0\nLWPOLYLINE\n70\n0\n10\n1\n20\n1\n10\n2\n20\n1\n10\n2\n20\n3\n" + line(0, 0, 1, 0))),
      {{1, 1, 2, 1}, {2, 1, 2, 3}, {0, 0, 1, 0}});
}

TEST(DxfDrawing, TakesPolylinesOfVertices) {
  const auto vertex = [](double x, double y) {
    return "0\nVERTEX\n8\n0\n10\n" + std::to_string(x) + "\n20\n" + std::to_string(y) + "\n30\n0\n";
  };
  const std::string three =
      "10\n7\n20\n7\n30\n0\n" + vertex(0, 0) + vertex(2, 0) + vertex(2, 1) + "0\nSEQEND\n8\n0\n";
  expect_lines(parse_dxf(dxf("0\nPOLYLINE\n66\n1\n70\n0\n" + three)), {{0, 0, 2, 0}, {2, 0, 2, 1}});
  expect_lines(parse_dxf(dxf("0\nPOLYLINE\n66\n1\n70\n1\n" + three + line(5, 5, 6, 5))),
               {{0, 0, 2, 0}, {2, 0, 2, 1}, {2, 1, 0, 0}, {5, 5, 6, 5}});
}

TEST(DxfDrawing, IsInItsUnit) {
  const std::pair<int, double> known[] = {{0, 1}, {1, 25.4}, {2, 304.8}, {4, 1}, {5, 10}, {6, 1000}};
  for (const auto& [unit, mm] : known)
    expect_lines(parse_dxf(dxf(line(1, 0, 2, 3), units(unit))), {{mm, 0, 2 * mm, 3 * mm}});
  EXPECT_THAT(refusal([] { parse_dxf(dxf(line(0, 0, 1, 0), units(3))); }),
              HasSubstr("the unit $INSUNITS 3 is not supported. Give mm, cm, m, inches or feet"));
  expect_lines(
      parse_dxf(dxf(line(1, 0, 2, 3), "9\n$LUNITS\n70\n2\n" + units(5) + "9\n$MEASUREMENT\n70\n1\n")),
      {{10, 0, 20, 30}});
}

TEST(DxfDrawing, MayHaveSpacesAndLineEndsOfAnySystem) {
  std::string text = dxf(line(1, 2, 3, 4), units(4)), windows;
  for (const char c : text) windows += c == '\n' ? std::string(" \r\n  ") : std::string(1, c);
  expect_lines(parse_dxf(windows), {{1, 2, 3, 4}});
}

TEST(DxfDrawing, LeavesTextAndOtherSectionsAlone) {
  expect_lines(
      parse_dxf("0\nSECTION\n2\nBLOCKS\n" + line(9, 9, 8, 8) + "0\nENDSEC\n" +
                dxf("0\nTEXT\n10\n5\n20\n5\n1\nLINE\n" + line(0, 0, 1, 0) + "0\nPOINT\n10\n3\n20\n3\n")),
      {{0, 0, 1, 0}});
}

// Regression: the frame of a layout was read as walls. It belongs to the paper (group 67), in another scale.
TEST(DxfDrawing, LeavesWhatStandsOnPaperOut) {
  const std::string frame = "0\nLINE\n8\n0\n67\n1\n10\n0\n20\n0\n11\n297\n21\n0\n",
                    border = "0\nLWPOLYLINE\n67\n1\n90\n4\n" + square_of_lines,
                    old_border = "0\nPOLYLINE\n67\n1\n66\n1\n70\n0\n0\nVERTEX\n10\n0\n20\n0\n" +
                                 std::string("0\nVERTEX\n10\n1\n20\n0\n0\nSEQEND\n");
  expect_lines(parse_dxf(dxf(frame + border + old_border + line(1, 2, 3, 4) + frame)), {{1, 2, 3, 4}});
}

TEST(DxfDrawing, RefusesCurvesWithTheirLine) {
  for (const std::string curve : {"ARC", "CIRCLE", "ELLIPSE", "SPLINE"})
    EXPECT_THAT(refusal([&] { parse_dxf(dxf("0\n" + curve + "\n10\n0\n20\n0\n40\n1\n")); }),
                AllOf(HasSubstr("the curve " + curve + " is not supported"), HasSubstr("6:1")));
  EXPECT_THAT(refusal([] { parse_dxf(dxf("0\nLWPOLYLINE\n10\n0\n20\n0\n42\n0.5\n10\n1\n20\n0\n")); }),
              HasSubstr("this polyline has an arc"));
  EXPECT_THAT(refusal([] { parse_dxf(dxf("0\nPOLYLINE\n70\n4\n0\nVERTEX\n10\n0\n20\n0\n0\nSEQEND\n")); }),
              HasSubstr("Draw straight walls"));
  for (const std::string kind : {"MLINE", "3DFACE"})
    EXPECT_THAT(refusal([&] { parse_dxf(dxf(line(0, 0, 1, 0) + "0\n" + kind + "\n10\n0\n20\n0\n")); }),
                HasSubstr(kind + " is not supported"));
  EXPECT_THAT(refusal([] { parse_dxf(dxf("0\nINSERT\n2\npart\n10\n0\n20\n0\n")); }), HasSubstr("Explode it"));
}

TEST(DxfDrawing, RefusesWhatIsMissing) {
  EXPECT_THAT(refusal([] { parse_dxf("AutoCAD Binary DXF\r\n"); }), HasSubstr("binary DXF"));
  EXPECT_THAT(refusal([] { parse_dxf("<svg/>"); }), HasSubstr("whole number"));
  EXPECT_THAT(refusal([] { parse_dxf(""); }), HasSubstr("is not a DXF file"));
  EXPECT_THAT(refusal([] { parse_dxf(dxf("0\nLINE\n10\n0\n20\n0\n11\n5\n")); }), HasSubstr("coordinate"));
  EXPECT_THAT(refusal([] { parse_dxf(dxf("0\nLWPOLYLINE\n10\n0\n20\n0\n10\n4\n")); }),
              HasSubstr("coordinate"));
  EXPECT_THAT(refusal([] { parse_dxf(dxf("0\nLINE\n10\nx\n")); }), HasSubstr("`x`"));
}

TEST(DxfDrawing, RefusesPolylinesSeenFromBelow) {
  const std::string below = "0\nLWPOLYLINE\n210\n0\n220\n0\n230\n-1\n";
  EXPECT_THAT(refusal([&] { parse_dxf(dxf(below + "10\n0\n20\n0\n10\n1\n20\n0\n")); }),
              HasSubstr("from below"));
}

// Every kind of entity once, so that damage may fall on each.
const std::string small_dxf =
    dxf("0\nLWPOLYLINE\n90\n4\n" + square_of_lines + line(0, 0, -1, -1) +
            "0\nPOLYLINE\n70\n1\n0\nVERTEX\n10\n4\n20\n4\n" + "0\nVERTEX\n10\n5\n20\n4\n0\nSEQEND\n",
        units(4));

TEST(DxfDrawing, CutOffIsRefusedWhereverItIsCut) {
  ASSERT_EQ(parse_dxf(small_dxf).size(), 6u);
  for (std::size_t length = 0; length + 1 < small_dxf.size(); ++length)
    EXPECT_THROW(parse_dxf(small_dxf.substr(0, length)), InvalidInput) << length;
}

TEST(SvgDrawing, HasTheLinesOfItsElementsYUpwards) {
  expect_lines(parse_svg(svg("<line x1='1' y1='2' x2='3' y2='4'/>")), {{1, -2, 3, -4}});
  expect_lines(parse_svg(svg("<line x2='3'/>")), {{0, 0, 3, 0}});
  expect_lines(parse_svg(svg("<polyline points='0,0 1,0 1,1'/>")), {{0, 0, 1, 0}, {1, 0, 1, -1}});
  expect_lines(parse_svg(svg("<polygon points='0 0,1 0,1 1'/>")),
               {{0, 0, 1, 0}, {1, 0, 1, -1}, {1, -1, 0, 0}});
  expect_lines(parse_svg(svg("<rect x='1' y='2' width='3' height='4'/>")),
               {{1, -2, 4, -2}, {4, -2, 4, -6}, {4, -6, 1, -6}, {1, -6, 1, -2}});
}

TEST(SvgDrawing, WalksPathsBothWays) {
  const std::vector<std::array<double, 4>> square_of_lines = {
      {1, -1, 3, -1}, {3, -1, 3, -3}, {3, -3, 1, -3}, {1, -3, 1, -1}};
  for (const std::string path :
       {"M1 1 L3 1 L3 3 L1 3 Z", "M1,1 3,1 3,3 1,3z", "M 1 1 H 3 V 3 H 1 Z", "m1 1 2 0 0 2 -2 0z",
        "M1 1h2v2h-2v-2", "m1 1h2v2h-2Z", "M1 1 3 1 3 3 1 3 1 1 Z", "M+1+1H3V3H1Z"}) {
    SCOPED_TRACE(path);
    expect_lines(parse_svg(svg("<path d='" + path + "'/>")), square_of_lines);
  }
  expect_lines(
      parse_svg(svg("<path d='m1 1 h1 v1 z m5 5 h1 M9 9 h-1.5.5'/>")),
      {{1, -1, 2, -1}, {2, -1, 2, -2}, {2, -2, 1, -1}, {6, -6, 7, -6}, {9, -9, 7.5, -9}, {7.5, -9, 8, -9}});
  expect_lines(parse_svg(svg("<path d='M0 0-1-2'/>")), {{0, 0, -1, 2}});
}

TEST(SvgDrawing, CarriesOutNestedTransforms) {
  const std::string element = "<line x1='1' y1='0' x2='2' y2='0'/>";
  const auto moved = [&](const std::string& how) {
    return parse_svg(svg("<g transform='" + how + "'>" + element + "</g>"));
  };
  expect_lines(moved("translate(10)"), {{11, 0, 12, 0}});
  expect_lines(moved("translate(10, 20)"), {{11, -20, 12, -20}});
  expect_lines(moved("scale(2)"), {{2, 0, 4, 0}});
  expect_lines(moved("rotate(90)"), {{0, -1, 0, -2}});
  expect_lines(moved("rotate(90 1 0)"), {{1, 0, 1, -1}});
  expect_lines(moved("matrix(1 2 3 4 5 6)"), {{6, -8, 7, -10}});
  expect_lines(moved("translate(10) scale(2)"), {{12, 0, 14, 0}});
  expect_lines(parse_svg(svg("<g transform='translate(10)'><g transform='scale(2, 3)'>"
                             "<line x1='1' y1='1' x2='2' y2='1' transform='rotate(90)'/></g></g>")),
               {{8, -3, 8, -6}});
}

TEST(SvgDrawing, TakesItsUnitFromItsSizeAndViewBox) {
  const auto read = [](const std::string& attributes) {
    return parse_svg("<svg " + attributes + "><line x1='1' y1='1' x2='2' y2='1'/></svg>")[0][1];
  };
  const auto expect_scale = [&](const std::string& attributes, double x, double y) {
    const Eigen::Vector2d end = read(attributes);
    EXPECT_NEAR(end.x(), 2 * x, 1e-12) << attributes;
    EXPECT_NEAR(end.y(), -y, 1e-12) << attributes;
  };
  expect_scale("", pixel_mm, pixel_mm);
  expect_scale("width='50mm' height='40mm'", pixel_mm, pixel_mm);
  expect_scale("width='50mm' height='40mm' viewBox='0 0 100 80'", 0.5, 0.5);
  expect_scale("width='5cm' viewBox='0 0 100 80'", 0.5, 0.5);
  expect_scale("height='1in' viewBox='0 0 100 254'", 0.1, 0.1);
  expect_scale("width='100' height='80' viewBox='0 0 100 80'", pixel_mm, pixel_mm);
  expect_scale("width='100px' height='80px' viewBox='0 0 100 80'", pixel_mm, pixel_mm);
  expect_scale("width='100%' height='100%' viewBox='0 0 100 80'", pixel_mm, pixel_mm);
  expect_scale("width='72pt' viewBox='0 0 254 100'", 0.1, 0.1);
  // A page of another shape than its box shows it whole and unstretched, unless it says otherwise.
  expect_scale("width='100mm' height='100mm' viewBox='0 0 100 50'", 1, 1);
  expect_scale("width='100mm' height='100mm' viewBox='0 0 100 50' preserveAspectRatio='none'", 1, 2);
}

TEST(SvgDrawing, RefusesLengthsInUnitsThatItDoesNotKnow) {
  EXPECT_THAT(refusal([] { parse_svg("<svg width='10em' viewBox='0 0 10 10'/>"); }), HasSubstr("`em`"));
  EXPECT_THAT(refusal([] { parse_svg(svg("<line x1='1mm'/>")); }), HasSubstr("1mm"));
  expect_lines(parse_svg(svg("<line x1='1px' y1='0' x2='2px' y2='0'/>")), {{1, 0, 2, 0}});
}

TEST(SvgDrawing, RefusesCurvesAndWhatItCannotRead) {
  const std::pair<std::string, std::string> bad[] = {
      {"<circle r='3'/>", "has a circle. Draw walls as line"},
      {"<ellipse rx='3' ry='1'/>", "has a ellipse"},
      {"<rect width='3' height='2' rx='0.5'/>", "round corners"},
      {"<svg viewBox='0 0 10 10'><line x2='3'/></svg>", "an svg within its svg"},
      {"<path d='M0 0 C1 1 2 2 3 3'/>", "the command `C`"},
      {"<path d='M0 0 a1 1 0 0 0 2 2'/>", "the command `a`"},
      {"<path d='1 2 L 3 4'/>", "begins with no M"},
      {"<path d='M0 0 L1 0 Z 5 5'/>", "the command `Z`"},
      {"<path d='M0 0 L1'/>", "instead of a number"},
      {"<path d='M0 0 L1 #'/>", "`#` instead of a number"},
      {"<path d='M0 0 L1 nan'/>", "instead of a number"},
      {"<polygon points='0 0 1'/>", "instead of a number"},
      {"<g transform='skewX(3)'/>", "has a transform `skewX`"},
      {"<g transform='scale(1, 2, 3)'/>", "has a transform scale of 3 numbers"},
      {"<g transform='scale 1'/>", "has no `(`"},
      {"<g transform='scale(1'/>", "instead of a number"},
      {"<line x1='1e999'/>", "instead of a number"},
      {"<line", "is not an SVG file"},
  };
  for (const auto& [text, says] : bad)
    EXPECT_THAT(refusal([&, &bad_text = text] { parse_svg(svg(bad_text)); }), HasSubstr(says)) << text;
  EXPECT_THAT(refusal([] { parse_svg("<html/>"); }), HasSubstr("is not an SVG file"));
  EXPECT_THAT(refusal([] { parse_svg(""); }), HasSubstr("is not an SVG file"));
}

TEST(SvgDrawing, RefusesGroupsWithoutEnd) {
  constexpr int levels = 300'000;
  std::string text = "<svg>";
  for (int k = 0; k < levels; ++k) text += "<g>";
  for (int k = 0; k < levels; ++k) text += "</g>";
  EXPECT_THAT(refusal([&] { parse_svg(text + "</svg>"); }), HasSubstr("levels deep"));
}

TEST(SvgDrawing, LeavesHiddenLayersOut) {
  const std::string wall = "<line x1='1' y1='0' x2='2' y2='0'/>";
  for (const std::string hidden :
       {"style='display:none'", "style='fill:none; display: none'", "display='none'"}) {
    SCOPED_TRACE(hidden);
    expect_lines(parse_svg(svg("<g " + hidden + "><g><path d='M0 0H9'/></g></g>" + wall)), {{1, 0, 2, 0}});
  }
  expect_lines(parse_svg(svg("<g style='display:inline' display='inline'>" + wall + "</g>")), {{1, 0, 2, 0}});
}

TEST(SvgDrawing, LeavesDefinitionsAlone) {
  expect_lines(parse_svg(svg("<defs><path d='M0 0 C1 1 2 2 3 3'/></defs><title>x</title><path d='M0 0H1'/>")),
               {{0, 0, 1, 0}});
}

// Every element and transform once, so that damage may fall on each.
const std::string small_svg =
    svg("<g transform='translate(1 2) rotate(30) matrix(1 0 0 1 2 3)'><line x1='1' y1='2' x2='3' y2='4'/>"
        "<polyline points='0,0 1,0 1,1'/><rect x='1' y='2' width='3' height='4'/><path d='m1 1 2 0 0 "
        "2h-2v-2z'/></g>");

/// Returns whether a damaged file gives finite lines, or an error message; anything else ends the test.
template <class Parse>
bool is_read(const std::string& text, const Parse& parse) {
  try {
    for (const DrawnLine& line : parse(text))
      for (const Eigen::Vector2d& end : line) EXPECT_TRUE(end.allFinite()) << text;
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

TEST(WallsOfADrawing, MeetWhereEndsAreNear) {
  const model::PlanarGraph graph = walls_of({{{{0, 0}, {10, 0}}},
                                             {{{10.004, 0.003}, {10, 10}}},
                                             {{{0.002, 10}, {9.998, 9.997}}},
                                             {{{0, 0.001}, {0, 10}}}});
  ASSERT_EQ(graph.vertices.size(), 4u);
  EXPECT_EQ(graph.edges, (std::vector<model::GraphEdge>{{0, 1}, {0, 2}, {1, 3}, {2, 3}}))
      << "from below, then from the left";
  EXPECT_NO_THROW(validate(graph));
}

/// Ends are off by a thousandth of a millimetre, as in files of three decimals. Plates still press on a whole side.
TEST(WallsOfADrawing, OfASideLieOnOneLine) {
  const model::PlanarGraph graph = walls_of({{{{0, 0.001}, {10, 0}}},
                                             {{{10, 0}, {20, 0.001}}},
                                             {{{0.001, 10}, {10.001, 10.001}}},
                                             {{{10.001, 10.001}, {20.001, 10}}},
                                             {{{0, 0.001}, {0.001, 10}}},
                                             {{{10, 0}, {10.001, 10.001}}},
                                             {{{20, 0.001}, {20.001, 10}}}});
  ASSERT_EQ(graph.vertices.size(), 6u);
  for (int v = 0; v < 6; ++v) EXPECT_EQ(graph.vertices[v].y(), v < 3 ? 0 : 10.001) << v;
  for (const int v : {0, 3}) EXPECT_EQ(graph.vertices[v].x(), 0) << v;
  for (const int v : {2, 5}) EXPECT_EQ(graph.vertices[v].x(), 20.001) << v;
}

TEST(WallsOfADrawing, StayApartWhereEndsAreNotNear) {
  EXPECT_EQ(walls_of({{{{0, 0}, {10, 0}}}, {{{10.02, 0}, {20, 0}}}}).vertices.size(), 4u);
}

TEST(WallsOfADrawing, AreThereOnceWhereLinesAreDrawnTwice) {
  const model::PlanarGraph graph =
      walls_of({{{{0, 0}, {10, 0}}}, {{{10, 0.001}, {0, 0}}}, {{{0, 0}, {0.001, 0}}}, {{{10, 0}, {10, 10}}}});
  EXPECT_EQ(graph.vertices.size(), 3u);
  EXPECT_EQ(graph.edges.size(), 2u);
}

/// Returns the error message for a drawing that a document names.
std::string refusal_of(const std::string& name, const std::string& content) {
  const TemporaryFolder folder;
  if (!content.empty()) folder.write(name, content);
  const Node root = parse_document("drawing: " + name + "\n", folder.path("design.yaml"));
  return refusal([&] { read_drawing(root.required("drawing", "a file")); });
}

TEST(ReadDrawing, NamesTheFileAndTheLineAtFault) {
  EXPECT_THAT(refusal_of("panel.pdf", "x"), AllOf(HasSubstr("design.yaml:1:10"), HasSubstr(".dxf or .svg")));
  EXPECT_THAT(refusal_of("panel.dxf", ""), HasSubstr("panel.dxf"));
  EXPECT_THAT(refusal_of("panel.dxf", dxf("0\nARC\n10\n0\n")), HasSubstr("panel.dxf:6:1"));
  EXPECT_THAT(refusal_of("panel.svg", svg("<circle r='1'/>")), HasSubstr("panel.svg"));
  EXPECT_THAT(refusal_of("panel.svg", svg("")), HasSubstr("has no straight lines"));
}

TEST(ReadDrawing, RefusesDrawingsWithoutSizeAndBeyondAllSize) {
  EXPECT_THAT(refusal_of("panel.dxf", dxf(line(3, 3, 3, 3))), HasSubstr("has no straight lines"));
  EXPECT_THAT(refusal_of("panel.svg", "<svg width='0mm' viewBox='0 0 1 1'><path d='M0 0H1V1'/></svg>"),
              HasSubstr("has no straight lines"));
  EXPECT_THAT(refusal_of("panel.dxf", dxf(line(0, 0, 1, 0) + line(1, 0, 1e300, 0))),
              HasSubstr("a kilometre"));
  EXPECT_THAT(refusal_of("panel.dxf", dxf(line(0, 0, 1e307, 0), units(6))), HasSubstr("a kilometre"));
  EXPECT_THAT(refusal_of("panel.dxf", dxf(line(0, 0, 1e-5, 0))), HasSubstr("shorter than a micrometre"));
}

}  // namespace
}  // namespace kinetix::targets
