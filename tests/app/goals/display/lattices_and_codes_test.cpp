#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "app/exports/exporters.hpp"
#include "app/goals/display/display_outcome.hpp"
#include "app/goals/display/display_panel.hpp"
#include "app/goals/registry.hpp"
#include "app/pipeline/pipeline.hpp"
#include "tests/support/qr_reader.hpp"

namespace kinetix::app {
namespace {

using testing::TemporaryFolder;

RunOptions quick(bool verify = false) {
  RunOptions options;
  options.verify = verify;
  return options;
}

DisplayFile shipped(const std::string& name) {
  return read_display_file(targets::read_document(std::string(KINETIX_SOURCE) + "/targets/shapes/" + name));
}

/// Reads the code of a plain grid from its exact state and from the flat grid. The benchmark decodes the equilibrium,
/// which would take too long here.
void expect_code(const DisplayFile& file) {
  const model::Lattice panel = make_panel(file, {file.goal.columns, file.goal.rows});
  const optim::DisplayDesign found = search_panel(file, panel, {}, {});
  ASSERT_TRUE(found.scaled && found.scaled->clear);
  EXPECT_LE(found.scaled->offset, 0.06 + 1e-12);
  EXPECT_LE(found.view.stretch, 1e-12);
  const FarViewOptions options = testing::as_ink_on_paper(far_view_options(file.goal), !file.goal.inverted);
  EXPECT_EQ(testing::read_qr_code(far_view(panel, found.view.state, options)), "KINETIX");
  EXPECT_EQ(testing::read_qr_code(far_view(panel, rest_state(panel), options)), "");
}

/// The grid has two cells per module and direction. The shipped target has four.
TEST(QrCode, IsReadFromTheExactStateOfAPlainGridAndNotBefore) {
  expect_code(
      read_display_file(targets::parse_document("kinetix: 1\ntarget: {kind: display, image: " KINETIX_SOURCE
                                                "/targets/shapes/qr_code.png, invert: true}\n"
                                                "structure: {cells: [50, 50]}\nvariables: {offset_mm: 0.6}\n",
                                                "qr_code.yaml")));
}

TEST(QrCodeSoak, OfTheShippedTargetIsReadToo) { expect_code(shipped("qr_code.yaml")); }

/// @param cells of the picture, without those that close the rim
void expect_letter_on_hexagons(const std::string& file, std::size_t cells) {
  app::Run run = run_goal(*read_target(file).goal, {});
  ASSERT_TRUE(run.met()) << run.violations.front();
  EXPECT_TRUE(run.verification->agrees);
  EXPECT_EQ(model::lattice_name(run.design.structure), "honeycomb");
  EXPECT_EQ(run.plan.mobility->dofs_along, 1);
  const auto& display = measure_of<DisplayMeasure>(run);
  EXPECT_EQ(display.reading.channel.size(), cells) << "the cells of the picture, not those of the rim";
  EXPECT_GE(physics_measure_of<DisplayMeasure>(run)->reading.score.auc, 0.97);
  TemporaryFolder folder;
  const auto result = write_results(run, folder.path(".")).result;
  EXPECT_EQ(result["display"]["levels"].size(), cells);
  EXPECT_GT(result["structure"]["cells"].size(), cells);
  EXPECT_EQ(read_design(folder.path("design.yaml")).structure.hinges(), run.design.structure.hinges());
}

TEST(DisplayOnHexagons, ShowsItsLetterBetweenPlates) {
  const TemporaryFolder folder;
  expect_letter_on_hexagons(
      folder.write(
          "t.yaml",
          "kinetix: 1\ntarget: {kind: display, glyph: T}\nstructure: {lattice: honeycomb, cells: [8, 8]}\n"
          "drive: {compression: 0.1}\n"),
      64);
}

TEST(DisplayOnHexagonsSoak, ShowTheLetterOfTheShippedTarget) {
  expect_letter_on_hexagons(std::string(KINETIX_SOURCE) + "/targets/shapes/honeycomb_t.yaml", 144);
}

// Regression: "20 columns in its proportions" counted rows of squares, so a round picture on bricks was half as high.
TEST(DisplayOnOtherLattices, HasTheRowsThatKeepAnImagesProportions) {
  const TemporaryFolder folder;
  folder.write("a.pbm", "P1\n4 4\n1 1 0 0 1 1 0 0 0 0 0 0 0 0 0 0\n");
  const auto rows_of = [&](const std::string& lattice) {
    const std::string file = folder.write(
        "a.yaml",
        "kinetix: 1\ntarget: {kind: display, image: a.pbm}\nstructure: {lattice: " + lattice + "}\n");
    return read_display_file(targets::read_document(file)).goal.rows;
  };
  EXPECT_EQ(rows_of("square"), 20);
  EXPECT_EQ(rows_of("octagon"), 20);
  EXPECT_EQ(rows_of("brick"), 40);
  EXPECT_EQ(rows_of("honeycomb"), 23) << "rows are 1.5 apart, columns the root of 3";
  EXPECT_EQ(rows_of("rhombus, angle_deg: 30"), 40);
}

TEST(FarViewInReports, IsPartOfThePage) {
  TemporaryFolder folder;
  app::Run run = run_goal(
      *read_target(
           folder.write("t.yaml",
                        "kinetix: 1\ntarget: {kind: display, glyph: T}\nstructure: {cells: [6, 6]}\n"))
           .goal,
      quick());
  write_results(run, folder.path("."));
  const std::string page = testing::read_file(folder.path("report.html"));
  EXPECT_THAT(page, ::testing::HasSubstr("\"afar_after.png\":\"data:image/png;base64,iVBORw0KGgo"));
  EXPECT_THAT(page, ::testing::HasSubstr("\"afar_after_enhanced.png\":\"data:image/png;base64,iVBORw0KGgo"));
  EXPECT_THAT(page, ::testing::HasSubstr("img-src data:"));
}

}  // namespace
}  // namespace kinetix::app
