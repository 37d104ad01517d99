#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/files/design_file.hpp"
#include "app/print/format/cut_drawing.hpp"
#include "model/base/geometry.hpp"
#include "tests/app/print/exports.hpp"
#include "tests/app/program.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

// mm: a cell whose outline has round numbers.
constexpr double cell_mm = 20, wall_mm = 2, bridge_mm = 1;

/// A row of basic cells with bridges of 1 x 4 mm. @param process after `process: `   @param scale of all lengths
std::string bridged_cell(const std::string& process, int cells = 1, double scale = 1) {
  return fmt::format(
      "kinetix: 1\nstructure: {{cells: [{}, 1], cell_mm: {}, wall_mm: {{thickness: {}}}}}\n"
      "design: {{theta_deg: 5}}\nhinge: {{model: rotary, kind: film, material: pp, gap_mm: {}, thickness_mm: "
      "{}}}\n"
      "process: {}\n",
      cells, scale * cell_mm, scale * wall_mm, scale * 4, scale * bridge_mm, process);
}

app::CutDrawing drawing_of(const std::string& text) {
  const Scratch scratch;
  const app::Design design = app::read_design(scratch.write("panel.yaml", text));
  const app::PrintPath flat{{0}, {rest_state(model::Linkage(design.structure))}};
  return cut_drawing(make_print_sheet(design, flat, design.process, {.kind = model::HingeKind::film}));
}

double cut_area_mm2(const app::CutDrawing& drawing) {
  double sum = 0;
  for (const auto& ring : drawing.cuts) sum += signed_area(ring);
  return sum;
}

/// Outline and hole of a cell with edge E, walls T and bridges of t x L. Each outer corner is a chamfer of T sqrt(2),
/// whose two ends turn by 45 degrees each. Notches beside bridges turn as often to the left as to the right. Cuts that
/// are d outside of the outline are longer by 2 d sum(tan(turn / 2)). The area within them is larger by
/// d (length of the outline) + d^2 sum(tan(turn / 2)).
TEST(Laser, CutsACellHalfAKerfOutsideOfItsOutline) {
  const double E = cell_mm, T = wall_mm, t = bridge_mm, L = 4;
  const double area_mm2 = 4 * ((E - T - L) * T + L * t + T * T / 2),
               length_mm = 8 * (E - t) + 4 * std::sqrt(2.0) * T,
               turns = 8 * std::tan(std::numbers::pi / 8) - 4;
  for (const double kerf : {0.0, 0.1, 0.2, 0.5}) {
    const app::CutDrawing cut = drawing_of(bridged_cell(fmt::format("{{base: laser, kerf_mm: {}}}", kerf)));
    EXPECT_EQ(cut.pieces, 1);
    EXPECT_EQ(cut.cuts.size(), 2u);
    EXPECT_NEAR(cut.length_mm(), length_mm + kerf * turns, 2e-3) << kerf;
    EXPECT_NEAR(cut_area_mm2(cut), area_mm2 + kerf / 2 * length_mm + kerf * kerf / 4 * turns, 5e-3) << kerf;
    EXPECT_NEAR((cut.high - cut.low).x(), E + T + kerf, 1e-3);
  }
}

/// The program keeps areas in whole numbers of grid steps. Steps of small sheets would reach no further than 21 m.
TEST(Laser, CutsASheetOf40MetresAsASmallOne) {
  constexpr int cells = 4;
  constexpr double scale = 500;
  const std::string process = "{base: laser, kerf_mm: 0}";
  const app::CutDrawing small = drawing_of(bridged_cell(process, cells)),
                        large = drawing_of(bridged_cell(process, cells, scale));
  EXPECT_EQ(large.cuts.size(), small.cuts.size());
  EXPECT_NEAR(large.length_mm() / scale, small.length_mm(), 2e-3);
  const double two_steps_mm = 2.1e-5;  // mm: so far outside are outlines
  EXPECT_NEAR(cut_area_mm2(large) / (scale * scale), cut_area_mm2(small), two_steps_mm * small.length_mm());
}

/// The sheet stays one piece with one hole for each cell, in all lattices and with walls in any direction.
TEST(Laser, CutsPanelsOfAllLatticesInOnePiece) {
  for (const char* structure :
       {"{cells: [3, 2], cell_mm: 20}", "{lattice: rhombus, angle_deg: 65, cells: [3, 2], cell_mm: 20}",
        "{lattice: honeycomb, cells: [3, 3], cell_mm: 20}", "{lattice: brick, cells: [3, 2], cell_mm: 20}"}) {
    const std::string text =
        fmt::format("kinetix: 1\nstructure: {}\ndesign: {{theta_deg: 5}}\nprocess: laser\n", structure);
    const Scratch scratch;
    const app::Design design = app::read_design(scratch.write("panel.yaml", text));
    const app::CutDrawing cut = drawing_of(text);
    EXPECT_EQ(cut.pieces, 1) << structure;
    EXPECT_EQ(cut.cuts.size(), 1u + design.structure.cells()) << structure;
    EXPECT_GE(cut.scores.size(), 2u * design.structure.hinges()) << "each number has two lines or more";
  }
}

/// Numbers are engraved within the walls: all their lines are inside of the outline and outside of the holes.
TEST(Laser, EngravesNumbersWithinTheWalls) {
  const app::CutDrawing cut = drawing_of(
      "kinetix: 1\nstructure: {cells: [4, 4], cell_mm: 20}\ndesign: {theta_deg: 5}\nprocess: laser\n");
  const auto crossings = [&](const Eigen::Vector2d& p) {
    int count = 0;
    for (const auto& ring : cut.cuts)
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Eigen::Vector2d &a = ring[k], &b = ring[(k + 1) % ring.size()];
        if ((a.y() > p.y()) == (b.y() > p.y())) continue;
        if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) ++count;
      }
    return count;
  };
  for (const auto& line : cut.scores)
    for (const Eigen::Vector2d& p : line) EXPECT_EQ(crossings(p) % 2, 1) << p.transpose();
}

TEST(Laser, WritesLayersThatCuttersRead) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, bridged_cell("laser"), "--format dxf,svg,stl,3mf").code, 0);
  const std::string said = command_output(
      "/usr/bin/python3 -c \"import ezdxf; d = ezdxf.readfile('" + std::string(scratch / "out/panel.dxf") +
      "'); m = d.modelspace(); cut = m.query('POLYLINE[layer==\\\"CUT\\\"]'); print('errors', "
      "len(d.audit().errors), 'unit', d.header['\\$INSUNITS'], 'cuts', len(cut), 'open', sum(not p.is_closed "
      "for p in cut), 'others', len(m) - len(cut) - len(m.query('POLYLINE[layer==\\\"SCORE\\\"]')))\"");
  EXPECT_THAT(said, HasSubstr("errors 0 unit 4 cuts 2 open 0 others 0"));
  const std::string svg = text_of(scratch / "out/panel.svg");
  EXPECT_THAT(svg, HasSubstr("<g id=\"CUT\" fill=\"none\" stroke=\"#ff0000\""));
  EXPECT_THAT(svg, HasSubstr("<g id=\"SCORE\" fill=\"none\" stroke=\"#0000ff\""));
  EXPECT_TRUE(fs::exists(scratch / "out/panel.pdf"));
  EXPECT_FALSE(fs::exists(scratch / "out/panel_strips.svg")) << "the sheet is cut whole";
  const Json cut = print_json_of(scratch)["cut"];
  EXPECT_EQ(cut["sheet_mm"], 3);
  EXPECT_EQ(cut["material"], "pp");
  EXPECT_EQ(cut["bridges"]["width_mm"], Json({1, 1}));
  EXPECT_NEAR(cut["bridges"]["strain"], 10 * radians_per_degree * 1 / (2 * 4), 1e-6) << "turn 2 theta";
  EXPECT_EQ(cut["bridges"]["strain_max"], 0.1);
}

TEST(Laser, MakesWallsAsHighAsTheSheetIsThick) {
  const auto design = [](const std::string& text) {
    const Scratch scratch;
    return app::read_design(scratch.write("panel.yaml", text));
  };
  const std::string
      open = "kinetix: 1\nstructure: {cells: [1, 1], cell_mm: 20}\nprocess: ",
      given = "kinetix: 1\nstructure: {cells: [1, 1], cell_mm: 20, wall_mm: {height: 5}}\nprocess: ";
  EXPECT_EQ(design(open + "laser\n").structure.size().height_mm, 3);
  EXPECT_EQ(design(open + "{base: laser, sheet_mm: 2}\n").structure.size().height_mm, 2);
  EXPECT_EQ(design(given + "laser\n").process.sheet_mm, 5);
  EXPECT_EQ(design(given + "fdm\n").process.sheet_mm, 0);
  expect_refused(given + "{base: laser, sheet_mm: 2}\n", "--format dxf", "the thickness of the sheet");
  expect_refused(open + "{base: fdm, kerf_mm: 0.1}\n", "--format dxf",
                 "only applies to processes that cut sheets");
  expect_refused(open + "{base: sla, material: pp}\n", "--format dxf",
                 "made in one piece, which sla does not");
  const app::Design written = design(design_text(design(given + "{base: laser, material: acrylic}\n")));
  EXPECT_EQ(written.process.film, "acrylic");
  EXPECT_EQ(written.process.sheet_mm, 5);
}

TEST(Laser, RefusesWhatIsNotAFlatSheetOfBridges) {
  expect_refused(
      "kinetix: 1\nstructure: {cells: [2, 1], cell_mm: 20}\ndesign: {theta_deg: 5, hinges: [{wall: [[1, 0], "
      "[1, 1]], beta_deg: 20}]}\n",
      "--format dxf --process laser",
      "with upright walls, and wall [[1, 0], [1, 1]] is tilted (alpha 90, tilt 20 degrees)", not_printable);
  expect_refused(panel, "--format dxf --process laser --hinge pin",
                 "and the hinges are pins. Make them bridges", not_printable);
  expect_refused(bridged_cell("{base: laser, least_film_mm: 1.2}"), "--format dxf",
                 "a bridge of 1 mm is below the minimum of laser, 1.2 mm", not_printable);
  expect_refused(bridged_cell("{base: laser, kerf_mm: 5}"), "--format dxf",
                 "a bridge's length of 4 mm is below the minimum of laser, 5 mm", not_printable);
  expect_refused(bridged_cell("laser"), "--format dxf --bed 15,15", "cuts the sheet in one piece");
}

TEST(Laser, DrawsACouponOfBridges) {
  const Scratch scratch;
  const Outcome run = kinetix_opt("export --coupon --process laser -o " + std::string(scratch / "out"));
  ASSERT_EQ(run.code, 0) << run.err;
  for (const char* file : {"coupon.dxf", "coupon.svg", "coupon.pdf"})
    EXPECT_TRUE(fs::exists(scratch / "out" / file)) << file;
  const Json cut = print_json_of(scratch)["cut"];
  EXPECT_EQ(cut["pieces"], 7);
  EXPECT_NEAR(cut["bridges"]["width_mm"][0], 0.4, 1e-9);
  EXPECT_NEAR(cut["bridges"]["width_mm"][1], 1.6, 1e-9);
  EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr("min_film_mm"));
}

}  // namespace
}  // namespace kinetix::testing
