#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/bad_input.hpp"
#include "tests/support/drawings.hpp"

namespace kinetix::targets {
namespace {

using ::testing::AllOf;
using testing::dxf_file;
using testing::dxf_line;
using testing::dxf_unit;
using testing::expect_lines;
using ::testing::HasSubstr;
using testing::refusal;

// Flags and corners of a closed polyline.
const std::string closed_square = "70\n1\n10\n0\n20\n0\n10\n2\n20\n0\n10\n2\n20\n2\n10\n0\n20\n2\n";

/// Returns a section TABLES with one layer. @param colour negative if the layer is off   @param flags 1: frozen
std::string layer_table(const std::string& name, int colour, int flags) {
  return "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n70\n1\n0\nLAYER\n2\n" + name + "\n70\n" +
         std::to_string(flags) + "\n62\n" + std::to_string(colour) + "\n0\nENDTAB\n0\nENDSEC\n";
}

std::string block_section(const std::string& name, const std::string& parts) {
  return "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n8\n0\n2\n" + name + "\n70\n0\n10\n1\n20\n0\n" + parts +
         "0\nENDBLK\n0\nENDSEC\n";
}

TEST(DxfDrawing, HasTheLinesOfItsEntities) {
  expect_lines(parse_dxf(dxf_file(dxf_line(1, 2, 3.5, -4))), {{1, 2, 3.5, -4}});
  expect_lines(parse_dxf(dxf_file("0\nLWPOLYLINE\n90\n4\n" + closed_square)),
               {{0, 0, 2, 0}, {2, 0, 2, 2}, {2, 2, 0, 2}, {0, 2, 0, 0}});
  expect_lines(parse_dxf(dxf_file("0\nLWPOLYLINE\n70\n0\n10\n1\n20\n1\n10\n2\n20\n1\n10\n2\n20\n3\n" +
                                  dxf_line(0, 0, 1, 0))),
               {{1, 1, 2, 1}, {2, 1, 2, 3}, {0, 0, 1, 0}});
  expect_lines(parse_dxf(dxf_file("0\nLINE\n10\n0\n20\n0\n11\n5\n21\n1\n")), {{0, 0, 5, 1}});
}

TEST(DxfDrawing, TakesPolylinesOfVertices) {
  const auto vertex = [](double x, double y, double z = 0) {
    return "0\nVERTEX\n8\n0\n10\n" + std::to_string(x) + "\n20\n" + std::to_string(y) + "\n30\n" +
           std::to_string(z) + "\n";
  };
  const std::string three =
      "10\n7\n20\n7\n30\n0\n" + vertex(0, 0) + vertex(2, 0) + vertex(2, 1) + "0\nSEQEND\n8\n0\n";
  expect_lines(parse_dxf(dxf_file("0\nPOLYLINE\n66\n1\n70\n0\n" + three)), {{0, 0, 2, 0}, {2, 0, 2, 1}});
  expect_lines(parse_dxf(dxf_file("0\nPOLYLINE\n66\n1\n70\n1\n" + three + dxf_line(5, 5, 6, 5))),
               {{0, 0, 2, 0}, {2, 0, 2, 1}, {2, 1, 0, 0}, {5, 5, 6, 5}});
  EXPECT_THAT(refusal([&] { parse_dxf(dxf_file("0\nPOLYLINE\n70\n8\n" + vertex(0, 0) + vertex(2, 0, 3))); }),
              HasSubstr("not parallel to the xy plane"));
}

TEST(DxfDrawing, HasTheUnitOfItsHeader) {
  const std::pair<int, double> known[] = {{1, 25.4},   {2, 304.8},  {4, 1},     {5, 10},  {6, 1000},
                                          {9, 0.0254}, {10, 914.4}, {13, 1e-3}, {14, 100}};
  for (const auto& [unit, mm] : known)
    EXPECT_DOUBLE_EQ(parse_dxf(dxf_file(dxf_line(1, 0, 2, 3), dxf_unit(unit))).unit_mm, mm) << unit;
  for (int unit = 1; unit <= 24; ++unit)
    EXPECT_TRUE(parse_dxf(dxf_file("", dxf_unit(unit))).has_unit) << unit;
  EXPECT_EQ(parse_dxf(dxf_file("", dxf_unit(1))).unit_source, "$INSUNITS 1, inches");
}

TEST(DxfDrawing, IsAssumedToBeInMillimetresIfItsHeaderHasNoUnit) {
  for (const std::string& header : {std::string(), dxf_unit(0), std::string("9\n$MEASUREMENT\n70\n0\n")}) {
    const Drawing drawing = parse_dxf(dxf_file("", header));
    EXPECT_FALSE(drawing.has_unit) << header;
    EXPECT_EQ(drawing.unit_mm, 1) << header;
    EXPECT_THAT(drawing.unit_source, HasSubstr("mm, assumed because")) << header;
  }
}

TEST(DxfDrawing, MayHaveSpacesAndLineEndsOfAnySystem) {
  std::string text = dxf_file(dxf_line(1, 2, 3, 4), dxf_unit(4)), windows;
  for (const char c : text) windows += c == '\n' ? std::string(" \r\n  ") : std::string(1, c);
  expect_lines(parse_dxf(windows), {{1, 2, 3, 4}});
}

TEST(DxfDrawing, LeavesTextAndUnusedBlocksAlone) {
  expect_lines(parse_dxf(dxf_file(
                   "0\nTEXT\n10\n5\n20\n5\n1\nLINE\n" + dxf_line(0, 0, 1, 0) + "0\nPOINT\n10\n3\n20\n3\n", "",
                   block_section("B", dxf_line(9, 9, 8, 8)))),
               {{0, 0, 1, 0}});
}

// Regression: the frame of a layout was read as walls. It belongs to the paper (group 67), in another scale.
TEST(DxfDrawing, OmitsEntitiesOnPaper) {
  const std::string frame = "0\nLINE\n8\n0\n67\n1\n10\n0\n20\n0\n11\n297\n21\n0\n",
                    border = "0\nLWPOLYLINE\n67\n1\n90\n4\n" + closed_square,
                    old_border = "0\nPOLYLINE\n67\n1\n66\n1\n70\n0\n0\nVERTEX\n10\n0\n20\n0\n" +
                                 std::string("0\nVERTEX\n10\n1\n20\n0\n0\nSEQEND\n");
  expect_lines(parse_dxf(dxf_file(frame + border + old_border + dxf_line(1, 2, 3, 4) + frame)),
               {{1, 2, 3, 4}});
}

TEST(DxfDrawing, OmitsLayersThatAreOffOrFrozenAndHiddenEntities) {
  const std::string parts = dxf_line(0, 0, 9, 9, "notes") + dxf_line(1, 2, 3, 4);
  expect_lines(parse_dxf(dxf_file(parts, "", layer_table("notes", -7, 0))), {{1, 2, 3, 4}});
  expect_lines(parse_dxf(dxf_file(parts, "", layer_table("notes", 7, 1))), {{1, 2, 3, 4}});
  EXPECT_EQ(parse_dxf(dxf_file(parts, "", layer_table("notes", 7, 0))).lines.size(), 2u);
  expect_lines(parse_dxf(dxf_file("0\nLINE\n60\n1\n10\n0\n20\n0\n11\n9\n21\n9\n" + dxf_line(1, 2, 3, 4))),
               {{1, 2, 3, 4}});
}

TEST(DxfDrawing, InsertsBlocks) {
  const std::string block = block_section("B", dxf_line(1, 0, 3, 0));  // its base is (1, 0)
  expect_lines(parse_dxf(dxf_file("0\nINSERT\n8\n0\n2\nB\n10\n5\n20\n6\n", "", block)), {{5, 6, 7, 6}});
  expect_lines(parse_dxf(dxf_file("0\nINSERT\n2\nB\n10\n5\n20\n6\n41\n2\n42\n1\n50\n90\n", "", block)),
               {{5, 6, 5, 10}});
  expect_lines(
      parse_dxf(dxf_file("0\nINSERT\n2\nB\n10\n0\n20\n0\n70\n2\n71\n2\n44\n10\n45\n20\n", "", block)),
      {{0, 0, 2, 0}, {10, 0, 12, 0}, {0, 20, 2, 20}, {10, 20, 12, 20}});
  expect_lines(parse_dxf(dxf_file("0\nINSERT\n2\nB\n10\n5\n20\n6\n230\n-1\n", "", block)), {{-5, 6, -7, 6}});
}

TEST(DxfDrawing, HidesBlocksWithTheirLayer) {
  const std::string sections = layer_table("off", -1, 0) + block_section("B", dxf_line(1, 0, 3, 0));
  expect_lines(
      parse_dxf(dxf_file("0\nINSERT\n8\noff\n2\nB\n10\n5\n20\n6\n" + dxf_line(0, 0, 1, 0), "", sections)),
      {{0, 0, 1, 0}});
}

TEST(DxfDrawing, RefusesBlocksThatAreMissingOrInsertThemselves) {
  EXPECT_THAT(refusal([] { parse_dxf(dxf_file("0\nINSERT\n2\npart\n10\n0\n20\n0\n")); }),
              AllOf(HasSubstr("the block `part` is not in the file"), HasSubstr("6:1")));
  const std::string endless = block_section("B", "0\nINSERT\n2\nB\n10\n0\n20\n0\n");
  EXPECT_THAT(refusal([&] { parse_dxf(dxf_file("0\nINSERT\n2\nB\n10\n0\n20\n0\n", "", endless)); }),
              HasSubstr("nested more than 16 levels deep"));
  const std::string array = "0\nINSERT\n2\nB\n10\n0\n20\n0\n70\n30000\n71\n30000\n";
  EXPECT_THAT(refusal([&] { parse_dxf(dxf_file(array, "", block_section("B", ""))); }),
              HasSubstr("2 million"));
}

/// Expects chords of one curve from one point to another, all at a distance from a middle.
void expect_arc(const Drawing& drawing, const std::string& name, const Eigen::Vector2d& middle,
                double radius) {
  ASSERT_EQ(drawing.curves, std::vector<std::string>{name});
  ASSERT_GT(drawing.lines.size(), 3u);
  for (const DrawnLine& line : drawing.lines) {
    EXPECT_EQ(line.curve, 0);
    EXPECT_NEAR((line.from - middle).norm(), radius, 1e-9);
    EXPECT_NEAR((line.to - middle).norm(), radius, 1e-9);
  }
}

TEST(DxfDrawing, ReplacesCurvesByChords) {
  const Drawing arc = parse_dxf(dxf_file("0\nARC\n10\n1\n20\n2\n40\n3\n50\n270\n51\n0\n"));
  expect_arc(arc, "ARC", {1, 2}, 3);
  EXPECT_LE((arc.lines.front().from - Eigen::Vector2d(1, -1)).norm(), 1e-9);
  EXPECT_LE((arc.lines.back().to - Eigen::Vector2d(4, 2)).norm(), 1e-9);
  expect_arc(parse_dxf(dxf_file("0\nCIRCLE\n10\n1\n20\n2\n40\n3\n")), "CIRCLE", {1, 2}, 3);
  expect_arc(parse_dxf(dxf_file("0\nELLIPSE\n10\n1\n20\n2\n11\n3\n21\n0\n40\n1\n41\n0\n42\n1\n")), "ELLIPSE",
             {1, 2}, 3);
  const Drawing bulge = parse_dxf(dxf_file("0\nLWPOLYLINE\n10\n0\n20\n0\n42\n1\n10\n2\n20\n0\n"));
  expect_arc(bulge, "arc of a polyline", {1, 0}, 1);
  EXPECT_LT(bulge.lines[bulge.lines.size() / 2].from.y(), -0.9) << "a positive bulge turns counter-clockwise";
}

TEST(DxfDrawing, ReplacesSplinesByChords) {
  const std::string start = "0\nSPLINE\n70\n8\n71\n2\n", knots = "40\n0\n40\n0\n40\n0\n40\n1\n40\n1\n40\n1\n";
  const Drawing spline = parse_dxf(dxf_file(start + knots + "10\n0\n20\n0\n10\n1\n20\n2\n10\n2\n20\n0\n"));
  EXPECT_EQ(spline.curves, std::vector<std::string>{"SPLINE"});
  double highest = 0;
  for (const DrawnLine& line : spline.lines) highest = std::max(highest, line.to.y());
  EXPECT_NEAR(highest, 1, 1e-9) << "a parabola reaches half of its control point";
  expect_lines(parse_dxf(dxf_file(start + knots + "10\n0\n20\n0\n10\n1\n20\n0\n10\n2\n20\n0\n")),
               {{0, 0, 2, 0}});
  EXPECT_THAT(refusal([&] { parse_dxf(dxf_file(start + "40\n0\n10\n0\n20\n0\n10\n2\n20\n0\n")); }),
              HasSubstr("do not match"));
}

TEST(DxfDrawing, RefusesSolidsAndMeshesWithTheirLine) {
  for (const std::string kind : {"MLINE", "REGION", "3DSOLID"})
    EXPECT_THAT(
        refusal([&] { parse_dxf(dxf_file(dxf_line(0, 0, 1, 0) + "0\n" + kind + "\n10\n0\n20\n0\n")); }),
        AllOf(HasSubstr(kind + " is not supported"), HasSubstr("22:1")));
  EXPECT_THAT(
      refusal([] { parse_dxf(dxf_file("0\nPOLYLINE\n70\n16\n0\nVERTEX\n10\n0\n20\n0\n0\nSEQEND\n")); }),
      HasSubstr("is a mesh"));
  expect_lines(parse_dxf(dxf_file("0\n3DFACE\n10\n0\n20\n0\n11\n1\n21\n0\n12\n1\n22\n1\n13\n0\n23\n1\n")),
               {{0, 0, 1, 0}, {1, 0, 1, 1}, {1, 1, 0, 1}, {0, 1, 0, 0}});
}

TEST(DxfDrawing, RefusesMissingParts) {
  EXPECT_THAT(refusal([] { parse_dxf("AutoCAD Binary DXF\r\n"); }), HasSubstr("binary DXF"));
  EXPECT_THAT(refusal([] { parse_dxf("<svg/>"); }), HasSubstr("whole number"));
  EXPECT_THAT(refusal([] { parse_dxf(""); }), HasSubstr("not a DXF file"));
  EXPECT_THAT(refusal([] { parse_dxf(dxf_file("0\nLINE\n10\n0\n20\n0\n11\n5\n")); }),
              HasSubstr("coordinate"));
  EXPECT_THAT(refusal([] { parse_dxf(dxf_file("0\nLWPOLYLINE\n10\n0\n20\n0\n10\n4\n")); }),
              HasSubstr("coordinate"));
  EXPECT_THAT(refusal([] { parse_dxf(dxf_file("0\nLINE\n10\nx\n20\n0\n11\n1\n21\n1\n")); }),
              HasSubstr("`x`"));
  EXPECT_THAT(refusal([] { parse_dxf(dxf_file("0\nLINE\n10\n0\n20\n0\n11\n1\n21\n1\n31\n2\n")); }),
              HasSubstr("not parallel to the xy plane"));
}

TEST(DxfDrawing, MirrorsPlanesSeenFromBelow) {
  expect_lines(parse_dxf(dxf_file("0\nLWPOLYLINE\n210\n0\n220\n0\n230\n-1\n10\n0\n20\n0\n10\n1\n20\n2\n")),
               {{0, 0, -1, 2}});
  EXPECT_THAT(refusal([] { parse_dxf(dxf_file("0\nLWPOLYLINE\n210\n1\n220\n0\n230\n0\n" + closed_square)); }),
              HasSubstr("in a plane that is tilted"));
}

TEST(DxfDrawing, HasColoursOfEntitiesAndLayers) {
  const std::string coloured = "0\nLINE\n62\n5\n10\n0\n20\n0\n11\n9\n21\n9\n";
  const Drawing drawing =
      parse_dxf(dxf_file(coloured + dxf_line(1, 2, 3, 4, "mountains"), "", layer_table("mountains", 1, 0)));
  EXPECT_EQ(drawing.lines[0].colour, 0x0000FF);
  EXPECT_EQ(drawing.lines[1].colour, 0xFF0000);
}

}  // namespace
}  // namespace kinetix::targets
