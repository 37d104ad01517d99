#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/bad_input.hpp"
#include "tests/support/drawings.hpp"

namespace kinetix::targets {
namespace {

using testing::expect_lines;
using ::testing::HasSubstr;
using testing::refusal;
using testing::svg_file;

constexpr double mm_per_inch = 25.4;  // mm, by its definition

TEST(SvgDrawing, HasTheLinesOfItsElementsYUpwards) {
  expect_lines(parse_svg(svg_file("<line x1='1' y1='2' x2='3' y2='4'/>")), {{1, -2, 3, -4}});
  expect_lines(parse_svg(svg_file("<line x2='3'/>")), {{0, 0, 3, 0}});
  expect_lines(parse_svg(svg_file("<polyline points='0,0 1,0 1,1'/>")), {{0, 0, 1, 0}, {1, 0, 1, -1}});
  expect_lines(parse_svg(svg_file("<polygon points='0 0,1 0,1 1'/>")),
               {{0, 0, 1, 0}, {1, 0, 1, -1}, {1, -1, 0, 0}});
  expect_lines(parse_svg(svg_file("<rect x='1' y='2' width='3' height='4'/>")),
               {{1, -2, 4, -2}, {4, -2, 4, -6}, {4, -6, 1, -6}, {1, -6, 1, -2}});
}

TEST(SvgDrawing, WalksPathsBothWays) {
  const std::vector<std::array<double, 4>> square = {
      {1, -1, 3, -1}, {3, -1, 3, -3}, {3, -3, 1, -3}, {1, -3, 1, -1}};
  for (const std::string path :
       {"M1 1 L3 1 L3 3 L1 3 Z", "M1,1 3,1 3,3 1,3z", "M 1 1 H 3 V 3 H 1 Z", "m1 1 2 0 0 2 -2 0z",
        "M1 1h2v2h-2v-2", "m1 1h2v2h-2Z", "M1 1 3 1 3 3 1 3 1 1 Z", "M+1+1H3V3H1Z"}) {
    SCOPED_TRACE(path);
    expect_lines(parse_svg(svg_file("<path d='" + path + "'/>")), square);
  }
  expect_lines(
      parse_svg(svg_file("<path d='m1 1 h1 v1 z m5 5 h1 M9 9 h-1.5.5'/>")),
      {{1, -1, 2, -1}, {2, -1, 2, -2}, {2, -2, 1, -1}, {6, -6, 7, -6}, {9, -9, 7.5, -9}, {7.5, -9, 8, -9}});
  expect_lines(parse_svg(svg_file("<path d='M0 0-1-2'/>")), {{0, 0, -1, 2}});
}

TEST(SvgDrawing, TakesStraightCurvesAsLines) {
  for (const std::string path :
       {"M0 0C1 1 2 2 3 3", "M0 0c1 1 2 2 3 3", "M0 0Q1 1 3 3", "M0 0A0 5 0 0 1 3 3"}) {
    SCOPED_TRACE(path);
    const Drawing drawing = parse_svg(svg_file("<path d='" + path + "'/>"));
    expect_lines(drawing, {{0, 0, 3, -3}});
    EXPECT_TRUE(drawing.curves.empty());
  }
}

/// Expects chords of one curve, all at a distance from a middle.
void expect_round(const std::string& element, const Eigen::Vector2d& middle, double radius) {
  SCOPED_TRACE(element);
  const Drawing drawing = parse_svg(svg_file(element));
  EXPECT_EQ(drawing.curves.size(), 1u);
  EXPECT_GT(drawing.lines.size(), 3u);
  for (const DrawnLine& line : drawing.lines) {
    EXPECT_EQ(line.curve, 0);
    EXPECT_NEAR((line.from - middle).norm(), radius, 1e-9);
    EXPECT_NEAR((line.to - middle).norm(), radius, 1e-9);
  }
}

TEST(SvgDrawing, ReplacesCurvesByChords) {
  expect_round("<circle cx='1' cy='2' r='3'/>", {1, -2}, 3);
  expect_round("<ellipse cx='1' cy='2' rx='3' ry='3'/>", {1, -2}, 3);
  expect_round("<path d='M1 5a3 3 0 0 0 3 -3'/>", {1, -2}, 3);
  expect_round("<path d='M1 5a3 3 0 013-3'/>", {4, -5}, 3);
  expect_round("<rect x='-2' y='-1' width='6' height='6' rx='3'/>", {1, -2}, 3);
  const Drawing quadratic = parse_svg(svg_file("<path d='M0 0Q1 2 2 0T4 0'/>"));
  EXPECT_EQ(quadratic.curves.size(), 2u);
  double highest = 0, lowest = 0;
  for (const DrawnLine& line : quadratic.lines) {
    highest = std::max(highest, line.to.y());
    lowest = std::min(lowest, line.to.y());
  }
  EXPECT_NEAR(highest, 1, 1e-9);
  EXPECT_NEAR(lowest, -1, 1e-9);
}

TEST(SvgDrawing, CarriesOutNestedTransforms) {
  const std::string element = "<line x1='1' y1='0' x2='2' y2='0'/>";
  const auto moved = [&](const std::string& how) {
    return parse_svg(svg_file("<g transform='" + how + "'>" + element + "</g>"));
  };
  expect_lines(moved("translate(10)"), {{11, 0, 12, 0}});
  expect_lines(moved("translate(10, 20)"), {{11, -20, 12, -20}});
  expect_lines(moved("scale(2)"), {{2, 0, 4, 0}});
  expect_lines(moved("rotate(90)"), {{0, -1, 0, -2}});
  expect_lines(moved("rotate(90 1 0)"), {{1, 0, 1, -1}});
  expect_lines(moved("matrix(1 2 3 4 5 6)"), {{6, -8, 7, -10}});
  expect_lines(moved("skewY(45)"), {{1, -1, 2, -2}});
  expect_lines(moved("translate(10) scale(2)"), {{12, 0, 14, 0}});
  expect_lines(parse_svg(svg_file("<g transform='translate(10)'><g transform='scale(2, 3)'>"
                                  "<line x1='1' y1='1' x2='2' y2='1' transform='rotate(90)'/></g></g>")),
               {{8, -3, 8, -6}});
}

TEST(SvgDrawing, CarriesOutTransformsOfStyles) {
  const std::string element = "<line x1='1' y1='0' x2='2' y2='0'/>";
  expect_lines(parse_svg(svg_file("<g style='transform: translate(10px, 20px)'>" + element + "</g>")),
               {{11, -20, 12, -20}});
  expect_lines(parse_svg(svg_file("<style>.turned {transform: rotate(0.25turn)}</style><g class='turned'>" +
                                  element + "</g>")),
               {{0, -1, 0, -2}});
}

TEST(SvgDrawing, ReadsLengthsWithUnits) {
  const std::string css_page = "<svg width='96px' height='192px'>";
  expect_lines(parse_svg(css_page + "<line x1='1in' y1='25.4mm' x2='72pt' y2='50%'/></svg>"),
               {{96, -96, 96, -96}});
  expect_lines(parse_svg(css_page + "<line x1='0' y1='0' x2='50%' y2='1pc'/></svg>"), {{0, 0, 48, -16}});
  EXPECT_THAT(refusal([] { parse_svg(svg_file("<line x1='1em'/>")); }),
              HasSubstr("`1em` has an unknown unit"));
}

/// Returns the mm of a user unit along x; 0 if the file does not determine it.
double unit_of_svg(const std::string& attributes, const std::string& before = "") {
  return parse_svg(before + "<svg " + attributes + "><line x1='1' y1='1' x2='2' y2='1'/></svg>").unit_mm;
}

TEST(SvgDrawing, TakesItsUnitFromItsSizeAndViewBox) {
  const std::string box = " viewBox='0 0 100 80'";
  EXPECT_NEAR(unit_of_svg("width='50mm' height='40mm'" + box), 0.5, 1e-12);
  EXPECT_NEAR(unit_of_svg("width='5cm'" + box), 0.5, 1e-12);
  EXPECT_NEAR(unit_of_svg("height='1in' viewBox='0 0 100 254'"), 0.1, 1e-12);
  EXPECT_NEAR(unit_of_svg("width='72pt' viewBox='0 0 254 100'"), 0.1, 1e-12);
  EXPECT_NEAR(unit_of_svg("width='6pc' viewBox='0 0 254 100'"), 0.1, 1e-12);
  EXPECT_NEAR(unit_of_svg("width='101.6Q' viewBox='0 0 254 100'"), 0.1, 1e-12);
  EXPECT_NEAR(unit_of_svg("width='50mm' height='40mm'"), mm_per_inch / 96, 1e-12) << "user units are px";
  EXPECT_NEAR(unit_of_svg("width='100px' height='80px'" + box), mm_per_inch / 96, 1e-12);
  EXPECT_NEAR(unit_of_svg("width='200px' height='160px'" + box), 2 * mm_per_inch / 96, 1e-12);
  EXPECT_NEAR(unit_of_svg("width='100mm' height='100mm' viewBox='0 0 100 50'"), 1, 1e-12) << "not stretched";
}

TEST(SvgDrawing, HasThePixelsOfTheProgramThatWroteIt) {
  const std::string comment = "<!-- Generator: Adobe Illustrator 16.0.3, SVG Export Plug-In -->";
  EXPECT_NEAR(unit_of_svg("width='100px' height='80px' viewBox='0 0 100 80'", comment), mm_per_inch / 72,
              1e-12);
  EXPECT_NEAR(unit_of_svg("viewBox='0 0 100 80'", comment), mm_per_inch / 72, 1e-12);
  EXPECT_NEAR(unit_of_svg("x='0px' y='0px' viewBox='0 0 100 80'"), mm_per_inch / 72, 1e-12);
  EXPECT_NEAR(unit_of_svg("width='100' inkscape:version='0.48.4 r9939'"), mm_per_inch / 90, 1e-12);
  EXPECT_NEAR(unit_of_svg("width='100' inkscape:version='1.2.2'"), mm_per_inch / 96, 1e-12);
  EXPECT_NEAR(unit_of_svg("width='100mm' viewBox='0 0 100 80' inkscape:version='0.48'"), 1, 1e-12);
}

TEST(SvgDrawing, IsAssumedToBeInPixelsIfItsSizeHasNoUnit) {
  for (const std::string attributes :
       {"", "viewBox='0 0 100 80'", "width='100' height='80'", "width='100' height='80' viewBox='0 0 100 80'",
        "width='100%' height='100%' viewBox='0 0 100 80'", "width='10em' viewBox='0 0 10 10'",
        "width='0mm' viewBox='0 0 10 10'"}) {
    EXPECT_NEAR(unit_of_svg(attributes), mm_per_inch / 96, 1e-12) << attributes;
    EXPECT_FALSE(parse_svg(std::string("<svg ") + attributes + "/>").has_unit) << attributes;
  }
  EXPECT_NEAR(unit_of_svg("width='200' height='160' viewBox='0 0 100 80'"), 2 * mm_per_inch / 96, 1e-12);
  EXPECT_THAT(parse_svg("<svg width='100%' height='100%'/>").unit_source, HasSubstr("are not lengths"));
}

TEST(SvgDrawing, StretchesIfItsSizeRequestsIt) {
  expect_lines(parse_svg("<svg width='100mm' height='100mm' viewBox='0 0 100 50' preserveAspectRatio='none'>"
                         "<line x1='1' y1='1' x2='2' y2='1'/></svg>"),
               {{1, -2, 2, -2}});
}

TEST(SvgDrawing, OmitsHiddenElements) {
  const std::string wall = "<line x1='1' y1='0' x2='2' y2='0'/>";
  for (const std::string hidden :
       {"style='display:none'", "style='fill:none; display: none'", "display='none'", "class='hid'", "id='x'",
        "class='a hid'", "visibility='hidden'", "style='opacity:0'", "style='stroke:none;fill:none'",
        "fill='none' stroke='none'", "fill='#ffffff' stroke='none'"}) {
    SCOPED_TRACE(hidden);
    expect_lines(parse_svg(svg_file("<style>/* .b */ .hid, #x {display:none}</style><g " + hidden +
                                    "><g><path d='M0 0H9'/></g></g>" + wall)),
                 {{1, 0, 2, 0}});
  }
  expect_lines(parse_svg(svg_file("<g style='display:inline' display='inline'>" + wall + "</g>")),
               {{1, 0, 2, 0}});
  expect_lines(parse_svg(svg_file("<g visibility='hidden'><g visibility='visible'>" + wall + "</g></g>")),
               {{1, 0, 2, 0}});
  expect_lines(parse_svg(svg_file("<rect width='100%' height='100%' fill='white'/>" + wall)), {{1, 0, 2, 0}});
}

TEST(SvgDrawing, PrefersStylesByTheirRank) {
  const std::string sheet =
      "<style>line {display:none} .shown {display:inline} line.hid {display:none}</style>";
  expect_lines(
      parse_svg(svg_file(sheet + "<line x2='1'/><line class='shown' x2='2'/><line class='hid' x2='3'/>"
                                 "<line class='hid' style='display:inline' x2='4'/>")),
      {{0, 0, 2, 0}, {0, 0, 4, 0}});
}

TEST(SvgDrawing, RepeatsElementsThatAreUsed) {
  const std::string definitions =
      "<defs><path id='a' d='M0 0H1'/><symbol id='s' viewBox='0 0 10 10'>"
      "<path d='M0 0H10'/></symbol></defs>";
  expect_lines(parse_svg(svg_file(definitions)), {});
  expect_lines(parse_svg(svg_file(definitions + "<use href='#a' x='5' y='6'/>")), {{5, -6, 6, -6}});
  expect_lines(parse_svg(svg_file(definitions + "<use xlink:href='#a' transform='scale(2)' x='5'/>")),
               {{10, 0, 12, 0}});
  expect_lines(parse_svg(svg_file(definitions + "<use href='#s' x='1' y='2' width='5' height='5'/>")),
               {{1, -2, 6, -2}});
  EXPECT_THAT(refusal([] { parse_svg(svg_file("<use href='#b'/>")); }),
              HasSubstr("`#b` of a use is missing"));
  EXPECT_THAT(refusal([] { parse_svg(svg_file("<g id='g'><use href='#g'/></g>")); }),
              HasSubstr("levels deep"));
}

TEST(SvgDrawing, RefusesUseThatRepeatsWithoutEnd) {
  std::string text;
  for (int k = 0; k < 30; ++k) {
    const std::string next = std::to_string(k + 1);
    text += "<g id='g" + std::to_string(k) + "'><use href='#g" + next + "'/><use href='#g" + next + "'/></g>";
  }
  EXPECT_THAT(
      refusal([&] { parse_svg(svg_file("<defs>" + text + "<g id='g30'/></defs><use href='#g0'/>")); }),
      HasSubstr("2 million elements"));
}

TEST(SvgDrawing, ScalesNestedDrawings) {
  expect_lines(parse_svg(svg_file("<svg x='10' y='20' width='50' height='50' viewBox='0 0 10 10'>"
                                  "<line x1='0' y1='0' x2='10' y2='10'/></svg>")),
               {{10, -20, 60, -70}});
  expect_lines(parse_svg(svg_file("<svg width='50' height='100' viewBox='0 0 10 10'><line x2='10'/></svg>")),
               {{0, -25, 50, -25}});
}

TEST(SvgDrawing, HasColoursOfStrokes) {
  const std::pair<std::string, int> colours[] = {{"stroke='#f00'", 0xFF0000},
                                                 {"stroke='#0000FF'", 0x0000FF},
                                                 {"style='stroke:red'", 0xFF0000},
                                                 {"class='m'", 0x00FF00},
                                                 {"stroke='rgb(255, 0, 255)'", 0xFF00FF},
                                                 {"", 0},
                                                 {"stroke='rgb(100%,0%,0%)'", 0xFF0000},
                                                 {"stroke='black'", 0},
                                                 {"stroke='url(#x)'", 0}};
  for (const auto& [attributes, colour] : colours)
    EXPECT_EQ(parse_svg(svg_file("<style>.m{stroke:#00ff00;}</style><line x2='1' " + attributes + "/>"))
                  .lines[0]
                  .colour,
              colour)
        << attributes;
}

TEST(SvgDrawing, RefusesUnreadablePartsWithTheirLine) {
  const std::pair<std::string, std::string> bad[] = {
      {"<path d='1 2 L 3 4'/>", "does not begin with the command M"},
      {"<path d='M0 0 B1 1'/>", "the command `B`"},
      {"<path d='M0 0 L1 0 Z 5 5'/>", "after the command Z"},
      {"<path d='M0 0 L1'/>", "instead of a number"},
      {"<path d='M0 0 L1 #'/>", "`#` instead of a number"},
      {"<path d='M0 0 L1 nan'/>", "instead of a number"},
      {"<path d='M0 0 A1 1 0 2 0 3 3'/>", "no flag"},
      {"<polygon points='0 0 1'/>", "instead of a number"},
      {"<g transform='turn(3)'/>", "the transform `turn`"},
      {"<g transform='scale(1, 2, 3)'/>", "the transform scale has 3 numbers"},
      {"<g transform='scale 1'/>", "has no `(`"},
      {"<g transform='scale(1'/>", "instead of a number"},
      {"<line x1='1e999'/>", "instead of a number"},
      {"<use href='other.svg#a'/>", "another file"},
  };
  for (const auto& [text, reason] : bad)
    EXPECT_THAT(refusal([&, &bad_text = text] { parse_svg(svg_file("\n" + bad_text)); }),
                AllOf(HasSubstr(reason), HasSubstr("3:1")))
        << text;
}

TEST(SvgDrawing, RefusesOtherFiles) {
  for (const std::string text : {"<html/>", "", "<svg"})
    EXPECT_THAT(refusal([&] { parse_svg(text); }), HasSubstr("not an SVG file")) << text;
  EXPECT_THAT(refusal([] { parse_svg("<svg viewBox='0 0 0 10'/>"); }), HasSubstr("viewBox has no size"));
}

TEST(SvgDrawing, RefusesGroupsWithoutEnd) {
  constexpr int levels = 300'000;
  std::string text = "<svg>";
  for (int k = 0; k < levels; ++k) text += "<g>";
  for (int k = 0; k < levels; ++k) text += "</g>";
  EXPECT_THAT(refusal([&] { parse_svg(text + "</svg>"); }), HasSubstr("levels deep"));
}

}  // namespace
}  // namespace kinetix::targets
