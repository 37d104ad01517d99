#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "app/print/fit.hpp"
#include "app/print/format/print_format.hpp"
#include "app/print/format/sheet_drawing.hpp"
#include "tests/app/print/mesh_distance.hpp"
#include "tests/app/program.hpp"

namespace kinetix::testing {
namespace {

using app::PrintSheet;
using Eigen::Vector3d;

constexpr const char* leaning = R"(kinetix: 1
structure: {cells: [2, 2], cell_mm: 16, wall_mm: {thickness: 0.8, height: 6}}
design: {theta_deg: 12, hinges: [{wall: [[0, 0], [1, 0]], beta_deg: 20}, {wall: [[0, 1], [1, 1]], beta_deg: -20},
  {wall: [[0, 2], [1, 2]], beta_deg: 20}]}
)";
constexpr const char* upright = R"(kinetix: 1
structure: {cells: [3, 2], cell_mm: 12, wall_mm: {thickness: 0.8, height: 6}}
design: {theta_deg: 20}
)";

// Fewer of the same hinges, for distances of surfaces that take long to measure.
constexpr const char* small_leaning = R"(kinetix: 1
structure: {cells: [1, 2], cell_mm: 16, wall_mm: {thickness: 0.8, height: 6}}
design: {theta_deg: 12, hinges: [{wall: [[0, 0], [1, 0]], beta_deg: 20}, {wall: [[0, 1], [1, 1]], beta_deg: -20},
  {wall: [[0, 2], [1, 2]], beta_deg: 20}]}
)";
constexpr const char* small_upright = R"(kinetix: 1
structure: {cells: [2, 1], cell_mm: 12, wall_mm: {thickness: 0.8, height: 6}}
design: {theta_deg: 20}
)";

PrintSheet sheet_of(const char* design, const char* process, model::HingeKind kind) {
  const Scratch scratch;
  return app::prepared(app::read_design(scratch.write("panel.yaml", design)), *model::find_process(process),
                       {.kind = kind, .edge_mm = std::string(process) == "fdm" ? 30.0 : 0.0}, false)
      .job.sheet;
}

/// Returns a body in the flat sheet, mm.
model::Polyhedron at_rest(const PrintSheet& sheet, int body) {
  return placed_body(sheet, sheet.path.front(), body);
}

/// Returns one end of a block as a ring of four corners. The first four corners of a block are on the lower body's
/// wall, the last four on the upper's.
std::array<Vector3d, 4> end_of(const model::Polyhedron& block, int first) {
  const auto& p = block.points;
  return first == 0 ? std::array{p[0], p[2], p[3], p[1]} : std::array{p[4], p[5], p[7], p[6]};
}

/// A design and the kind of its hinges.
using Case = std::pair<const char*, model::HingeKind>;
class Soft : public ::testing::TestWithParam<Case> {};

/// At least 0.9 of each interface must touch, as the issue requires.
TEST_P(Soft, PartsTouchTheirWallsOverNearlyAllOfEachEnd) {
  const PrintSheet sheet = sheet_of(GetParam().first, "polyjet", GetParam().second);
  for (int h = 0; h < static_cast<int>(sheet.hinges.size()); ++h) {
    const model::RestHinge& hinge = sheet.linkage.hinges[h];
    const model::Polyhedron block = placed_soft(sheet, sheet.path.front(), h);
    EXPECT_GE(covered_share(end_of(block, 0), at_rest(sheet, hinge.lower)), 0.9) << h;
    EXPECT_GE(covered_share(end_of(block, 4), at_rest(sheet, hinge.upper)), 0.9) << h;
    EXPECT_EQ(covered_share(end_of(block, 0), at_rest(sheet, hinge.upper)), 0)
        << "it touches the other there";
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Soft,
                         ::testing::Values(Case(upright, model::HingeKind::block),
                                           Case(leaning, model::HingeKind::block),
                                           Case(upright, model::HingeKind::film),
                                           Case(leaning, model::HingeKind::film)));

class Pins : public ::testing::TestWithParam<const char*> {};

/// Measures the written surfaces by corners and edges, independently of the program's own distance.
TEST_P(Pins, KeepNineTenthsOfTheirClearanceInTheMeshes) {
  for (const char* design : {small_upright, small_leaning}) {
    const PrintSheet sheet = sheet_of(design, GetParam(), model::HingeKind::pin);
    for (int h = 0; h < static_cast<int>(sheet.hinges.size()); ++h) {
      const model::RestHinge& hinge = sheet.linkage.hinges[h];
      const double left = surface_distance(at_rest(sheet, hinge.lower), at_rest(sheet, hinge.upper)),
                   asked = sheet.hinges[h].made.clearance_mm;
      EXPECT_GE(left, 0.9 * asked) << h;
      EXPECT_LE(left, asked + 0.02) << "the circles' polygons";
    }
  }
}

/// An eye that moves along any of three axes by a little more than its clearance collides with its fork, in both
/// directions.
TEST_P(Pins, HoldInAllSixDirections) {
  const PrintSheet sheet = sheet_of(small_upright, GetParam(), model::HingeKind::pin);
  const model::HingePrint& made = sheet.hinges[0];
  const model::Polyhedron fork = at_rest(sheet, sheet.linkage.hinges[0].lower),
                          eye = at_rest(sheet, sheet.linkage.hinges[0].upper);
  for (int k = 0; k < 3; ++k)
    for (const double sign : {-1, 1}) {
      const double play = k == 2 ? made.axial_clearance_mm : made.made.clearance_mm;
      const auto moved = [&](double way) {
        model::Polyhedron out = eye;
        for (Vector3d& p : out.points) p[k] += sign * way;
        return out;
      };
      EXPECT_FALSE(surfaces_cross(fork, moved(0.9 * play))) << "direction " << k;
      EXPECT_TRUE(surfaces_cross(fork, moved(1.1 * play + 0.03))) << "direction " << k;
    }
}

INSTANTIATE_TEST_SUITE_P(Of, Pins, ::testing::Values("polyjet", "fdm", "sla", "sls"));

/// Only the rims overhang, not the cones within them. The overhang is smaller by the projections of both cones.
TEST(InclinedFaces, TakeTheOverhangFromWithinTheRims) {
  app::PrintSheet inclined = sheet_of(upright, "fdm", model::HingeKind::pin), flat = inclined;
  ASSERT_GT(inclined.hinges[0].rim_mm, 0);
  flat.meshes.clear();
  flat.rods.clear();
  flat.soft.clear();
  for (model::HingePrint& pin : flat.hinges) pin.rim_mm = 0;
  make_solids(flat);
  const auto hanging = [](const PrintSheet& sheet) {
    double area = 0;
    for (std::size_t b = 0; b < sheet.meshes.size(); ++b)
      area += app::overhang_mm2(placed_body(sheet, sheet.path.front(), static_cast<int>(b)),
                                Eigen::Matrix3d::Identity());
    return area;
  };
  const double rod = 1.5, bore = 1.8, rim = bore + 0.8 - 0.4;
  const double less = 17 * M_PI * (2 * rim * rim - rod * rod - bore * bore);
  EXPECT_NEAR(hanging(flat) - hanging(inclined), less, 0.03 * less);
}

double area_of(const std::vector<Eigen::Vector2d>& ring) {
  double twice = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Eigen::Vector2d &p = ring[k], &q = ring[(k + 1) % ring.size()];
    twice += p.x() * q.y() - p.y() * q.x();
  }
  return twice / 2;
}

/// Walls of 12 x 6 mm have their hinge in the middle. Tabs are 3 mm long, 6 mm wide at the base and 6 - 2 x 0.3 x 3 mm
/// wide at the end.
TEST(Strips, AreTheWallsAndTheirTabs) {
  const PrintSheet sheet = sheet_of(upright, "polyjet", model::HingeKind::film);
  const app::Strips strips = app::strips(sheet);
  ASSERT_EQ(strips.cuts.size(), 17U);
  const double tab = 3 * (6 + 6 - 2 * 0.3 * 3) / 2;
  for (const auto& cut : strips.cuts) {
    EXPECT_NEAR(area_of(cut), 12 * 6 + 2 * tab, 1e-9) << "counter-clockwise";
    for (const Eigen::Vector2d& p : cut) {
      EXPECT_TRUE((p.array() > 0).all() && (p.array() < strips.size.array()).all());
    }
  }
  EXPECT_EQ(strips.folds.size(), 3 * 17U) << "a hinge and two tabs each";
  for (const auto& [from, to] : strips.folds) EXPECT_NEAR((to - from).norm(), 6, 1e-9) << "from edge to edge";
  EXPECT_EQ(strips.numbers.size(), 17U);
  EXPECT_EQ(strips.vertices.size(), 2 * 17U);
}

/// Checks whether a line, horizontal or vertical, enters the box of a label.
bool strikes(const std::pair<Eigen::Vector2d, Eigen::Vector2d>& line, const app::Strips::Label& label) {
  const double half = app::digit_share * label.height * static_cast<double>(label.text.size()) / 2;
  for (int k = 0; k <= 100; ++k) {
    const Eigen::Vector2d to = line.first + k / 100.0 * (line.second - line.first) - label.place;
    if (std::abs(to.x()) <= half && to.y() >= 0 && to.y() <= app::capital_share * label.height) return true;
  }
  return false;
}

/// Labels in walls of 6 mm are at least 1.3 mm high. "[2, 3]" has half a wall of 12 mm as its space.
TEST(Strips, HaveLabelsThatAreReadAndStandClearOfLines) {
  for (const char* design : {upright, leaning}) {
    const app::Strips strips = app::strips(sheet_of(design, "polyjet", model::HingeKind::film));
    for (const auto* labels : {&strips.numbers, &strips.vertices})
      for (const app::Strips::Label& label : *labels) {
        EXPECT_GE(label.height, 1.3) << label.text;
        EXPECT_TRUE(std::ranges::none_of(strips.folds, [&](const auto& fold) {
          return strikes(fold, label);
        })) << label.text;
      }
  }
}

/// The drawing is as large as its parts, so numbers at its boundary move inwards.
TEST(Drawing, CutsNoNumberOff) {
  const Scratch scratch;
  const Outcome run = kinetix_opt("export " + scratch.write("panel.yaml", upright) + " -o " +
                                  std::string(scratch / "out") + " --format svg --hinge pin");
  ASSERT_EQ(run.code, 0) << run.err;
  const std::string svg = text_of(scratch / "out/panel.svg");
  std::smatch box, size;
  ASSERT_TRUE(std::regex_search(svg, box, std::regex(R"(viewBox="0 0 ([0-9.]+) ([0-9.]+)\")")));
  ASSERT_TRUE(std::regex_search(svg, size, std::regex(R"re(font-size="([0-9.]+)")re")));
  const double high = std::stod(size[1]);
  const std::regex number(R"re(<text x="([0-9.]+)" y="([0-9.]+)">(\d+)</text>)re");
  int numbers = 0;
  for (std::sregex_iterator at(svg.begin(), svg.end(), number), end; at != end; ++at, ++numbers) {
    const double x = std::stod((*at)[1]), y = std::stod((*at)[2]),
                 half = 0.6 * high * static_cast<double>((*at)[3].length()) / 2;
    EXPECT_GE(x, half);
    EXPECT_LE(x, std::stod(box[1]) - half);
    EXPECT_GE(y, 0.7 * high);
    EXPECT_LE(y, std::stod(box[2]));
  }
  EXPECT_EQ(numbers, 17);
}

/// Returns the first x of each outline, mm.
/// @param pattern with the number as its first group
std::vector<double> first_places(const std::string& text, const char* pattern) {
  std::vector<double> out;
  const std::regex place(pattern);
  for (std::sregex_iterator at(text.begin(), text.end(), place), end; at != end; ++at)
    out.push_back(std::stod((*at)[1]));
  return out;
}

/// Includes a sheet of more than a metre.
TEST(Drawing, HasTheSamePlacesInBothFormats) {
  const Scratch scratch;
  const std::string design =
      "kinetix: 1\nstructure: {cells: [62, 1], cell_mm: 20.0333}\ndesign: {theta_deg: 3}\n";
  const Outcome run = kinetix_opt("export " + scratch.write("long.yaml", design) + " -o " +
                                  std::string(scratch / "out") + " --format svg,dxf --hinge block");
  ASSERT_EQ(run.code, 0) << run.err;
  const std::string dxf = text_of(scratch / "out/long.dxf");
  const std::vector<double> low = first_places(dxf, R"(EXTMIN\n10\n(-?[0-9.]+))"),
                            drawn = first_places(text_of(scratch / "out/long.svg"), R"(M(-?[0-9.e-]+) )"),
                            cut = first_places(
                                dxf, R"(70\n1\n10\n0\n20\n0\n30\n0\n0\nVERTEX\n8\n\w+\n10\n(-?[0-9.]+))");
  ASSERT_EQ(low.size(), 1u);
  ASSERT_EQ(drawn.size(), cut.size());
  ASSERT_GT(drawn.size(), 300u);
  for (std::size_t k = 0; k < cut.size(); ++k) EXPECT_NEAR(drawn[k], cut[k] - low[0], 2e-4) << k;
}

/// Printers scale a drawing to their paper, which a line of known length reveals. Cutters read SVG and would cut such a
/// line.
TEST(Drawing, OfPaperHasALineToMeasureBelowWhatIsLargerThanA4) {
  const Scratch scratch;
  const auto foot_mm = [&](int columns) {
    const std::string design = "kinetix: 1\nname: strip\nstructure: {cells: [" + std::to_string(columns) +
                               ", 1], cell_mm: 20}\ndesign: {theta_deg: 10}\n";
    const Outcome run = kinetix_opt("export " + scratch.write("strip.yaml", design) + " -o " +
                                    std::string(scratch / "out") + " --format svg --hinge block");
    EXPECT_EQ(run.code, 0) << run.err;
    const std::string drawn = text_of(scratch / "out/strip.svg"), paper = text_of(scratch / "out/strip.pdf");
    std::smatch box, page;
    EXPECT_TRUE(std::regex_search(drawn, box, std::regex(R"(viewBox="0 0 ([0-9.]+) ([0-9.]+)\")")));
    EXPECT_TRUE(std::regex_search(paper, page, std::regex(R"(/MediaBox \[ *0 0 ([0-9.]+) ([0-9.]+) *\])")));
    EXPECT_NEAR(std::stod(page[1]) * 25.4 / 72, std::stod(box[1]), 0.01) << columns;
    return std::stod(page[2]) * 25.4 / 72 - std::stod(box[2]);
  };
  EXPECT_NEAR(foot_mm(5), 0, 0.01);
  EXPECT_NEAR(foot_mm(20), 10, 0.01);
}

/// rsvg-convert finds the width that the unit gives, and all parts.
TEST(Strips, AreDrawnOneToOneBesideTheSheetOfFilms) {
  const Scratch scratch;
  const Outcome run = kinetix_opt("export " + scratch.write("panel.yaml", upright) + " -o " +
                                  std::string(scratch / "out") + " --format svg --hinge film");
  ASSERT_EQ(run.code, 0) << run.err;
  const std::string svg = text_of(scratch / "out/panel_strips.svg");
  std::smatch size;
  ASSERT_TRUE(std::regex_search(svg, size, std::regex(R"(width="([0-9.]+)mm" height="([0-9.]+)mm")")));
  const std::string png = scratch / "strips.png";
  ASSERT_EQ(std::system(
                ("rsvg-convert -d 254 -p 254 " + std::string(scratch / "out/panel_strips.svg") + " -o " + png)
                    .c_str()),
            0);
  const std::string bytes = text_of(png);  // width and height are big-endian from byte 16 on
  const auto number = [&](std::size_t at) {
    int out = 0;
    for (std::size_t k = at; k < at + 4; ++k) out = 256 * out + static_cast<unsigned char>(bytes[k]);
    return out;
  };
  EXPECT_NEAR(number(16), 10 * std::stod(size[1]), 1);
  EXPECT_NEAR(number(20), 10 * std::stod(size[2]), 1);
  EXPECT_EQ(text_of(scratch / "out/panel_strips.pdf").substr(0, 5), "%PDF-");
  EXPECT_FALSE(fs::exists(scratch / "out/panel_strips.dxf"));
}

/// Includes walls that fill a page of more than a metre.
TEST(Strips, AreAsLongAsTheirWalls) {
  const Scratch scratch;
  const double edge_mm = 250.0333;
  const std::string design = fmt::format(
      "kinetix: 1\nstructure: {{cells: [8, 8], cell_mm: {}}}\ndesign: {{theta_deg: 3}}\n", edge_mm);
  const Outcome run = kinetix_opt("export " + scratch.write("large.yaml", design) + " -o " +
                                  std::string(scratch / "out") + " --format svg --hinge film");
  ASSERT_EQ(run.code, 0) << run.err;
  const std::string svg = text_of(scratch / "out/large_strips.svg");
  const std::regex foot(R"(M([0-9.]+) [0-9.]+L([0-9.]+) )");
  double farthest = 0;
  int strips = 0;
  for (std::sregex_iterator at(svg.begin(), svg.end(), foot), end; at != end; ++at, ++strips) {
    const double from = std::stod((*at)[1]), to = std::stod((*at)[2]);
    EXPECT_NEAR(to - from, edge_mm, 2e-4);
    farthest = std::max(farthest, to);
  }
  EXPECT_EQ(strips, 144);
  EXPECT_GT(farthest, 1000);
}

}  // namespace
}  // namespace kinetix::testing
