#include "app/print/folding_card.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/print/fit.hpp"
#include "app/print/print_report.hpp"
#include "tests/app/print/exports.hpp"

namespace kinetix::testing {
namespace {

using app::CardPicture;
using app::FoldingCard;
using ::testing::HasSubstr;
using ::testing::Not;

FoldingCard card_of(const std::string& design, const std::optional<app::Folding>& folding) {
  const Scratch scratch;
  const app::Design read = app::read_design(scratch.write("panel.yaml", design));
  app::PrintJob job = prepare_fitting_print(read, read.process, {}, false).job;
  job.folding = folding;
  return make_folding_card(job);
}

std::string words_of(const FoldingCard& card) {
  std::string all;
  for (const auto& [title, how] : card.steps) all += title + ": " + how + "\n";
  return all;
}

/// Returns the box of all shapes of one colour, mm.
Eigen::AlignedBox2d box_of(const CardPicture& picture, const std::string& fill) {
  Eigen::AlignedBox2d box;
  for (const CardPicture::Shape& shape : picture.shapes)
    if (shape.fill == fill)
      for (const auto& ring : shape.rings)
        for (const Eigen::Vector2d& p : ring) box.extend(p);
  return box;
}

constexpr const char *bodies = "#d9d9d4", *arrows = "#c03030";

// A panel of 3 x 2 cells of 12 mm, 36 mm wide between the outer vertices, fits on the page in true size.
TEST(FoldingCard, DrawsTheSheetToScale) {
  const FoldingCard card = card_of(panel, std::nullopt);
  ASSERT_EQ(card.pictures.size(), 2u);
  EXPECT_THAT(card.pictures[0].caption, HasSubstr("true size"));
  const Eigen::Vector2d sides = box_of(card.pictures[0], bodies).sizes();
  const std::string said = fmt::format("Flat: {:.1f} x {:.1f} x", sides.x(), sides.y());
  EXPECT_THAT(card.pictures[0].caption, HasSubstr(said));
  EXPECT_NEAR(sides.x() - sides.y(), 12, 1e-4);
  EXPECT_THAT(words_of(card), HasSubstr("not known"));
  std::string large = panel;
  large.replace(large.find("cell_mm: 12"), 11, "cell_mm: 60");
  const FoldingCard smaller = card_of(large, std::nullopt);
  EXPECT_THAT(smaller.pictures[0].caption, HasSubstr("1 : 3"));
  EXPECT_LE(smaller.pictures[0].size.x(), 180);
}

// Plates normal to y push from below and from above, each towards the sheet.
TEST(FoldingCard, PointsAtTheSidesThatArePushed) {
  for (const model::Axis axis : {model::Axis::x, model::Axis::y}) {
    app::Folding plates{.name = "plates", .load = 4.5};
    plates.drive = model::Plates{.axis = axis, .compression = 0.06};
    const FoldingCard card = card_of(panel, plates);
    const Eigen::AlignedBox2d sheet = box_of(card.pictures[0], bodies),
                              all = box_of(card.pictures[0], arrows);
    const int along = axis == model::Axis::x ? 0 : 1;
    EXPECT_NEAR(all.min()[along], sheet.min()[along] - 4, 0.1) << "heads are 4 mm long, tips at the sheet";
    EXPECT_NEAR(all.max()[along], sheet.max()[along] + 4, 0.1);
    EXPECT_THAT(words_of(card), HasSubstr(axis == model::Axis::x ? "until they are 2.16 mm nearer"
                                                                 : "until they are 1.44 mm nearer"));
    EXPECT_THAT(words_of(card), HasSubstr("It takes 4.5 N, which a hand gives"));
  }
}

/// Returns the angle about z by which a state turns a body, rad.
double yaw(const model::Pose& pose) { return std::atan2(pose.R(1, 0), pose.R(0, 0)); }

// The arrow about a hinge goes round as the upper body turns against the lower one on the way to the fold.
TEST(FoldingCard, TurnsAsTheSheetFolds) {
  for (const double theta_deg : {20.0, -20.0}) {
    const Scratch scratch;
    std::string design = panel;
    design.replace(design.find("theta_deg: 20"), 13, fmt::format("theta_deg: {:g}", theta_deg));
    const app::Design read = app::read_design(scratch.write("panel.yaml", design));
    app::PrintJob job = prepare_fitting_print(read, read.process, {}, false).job;
    for (int hinge = 0; hinge < read.structure.hinges(); ++hinge) {
      job.folding =
          app::Folding{.name = "hinge", .drive = model::HingeTurn{hinge, 0.7}, .load = 30, .is_force = false};
      const CardPicture flat = make_folding_card(job).pictures[0];
      const auto arc = std::find_if(flat.shapes.begin(), flat.shapes.end(),
                                    [](const auto& shape) { return shape.fill.empty(); });
      ASSERT_NE(arc, flat.shapes.end());
      const Eigen::Vector2d &a = arc->rings[0][0], &b = arc->rings[0][1], &c = arc->rings[0][2];
      const double round = -((b - a).x() * (c - b).y() - (b - a).y() * (c - b).x());  // y is down
      const model::RestHinge& at = job.sheet.linkage.hinges[hinge];
      const double turn = yaw(job.sheet.path.back()[at.upper]) - yaw(job.sheet.path.back()[at.lower]);
      EXPECT_GT(round * turn, 0) << hinge;
    }
    EXPECT_THAT(words_of(make_folding_card(job)), HasSubstr("30 N mm, which a hand gives"));
  }
}

TEST(FoldingCard, SaysThatSpringsFoldTheSheet) {
  const FoldingCard card =
      card_of(panel, app::Folding{.name = "springs of shape memory", .is_unaided = true});
  EXPECT_THAT(words_of(card), HasSubstr("Fold: Warm it. The springs in its hinges fold it."));
}

TEST(FoldingCard, SaysThatNoDriveFoldsTheSheet) {
  const FoldingCard card = card_of(panel, app::Folding{.name = {}, .why_not = "it buckles"});
  EXPECT_THAT(words_of(card), HasSubstr("No single push folds it: it buckles."));
  EXPECT_THAT(words_of(card), Not(HasSubstr("Start")));
  const FoldingCard none =
      card_of(panel, app::Folding{.name = {}, .why_not = "no drive folds it (plates: it leans)"});
  EXPECT_THAT(words_of(none), HasSubstr("Fold: No drive folds it (plates: it leans)."));
}

// Each print has a line of force, and a warning if nothing is known to fold it.
TEST(PrintReport, HasAForceOrTheReasonWithoutOne) {
  const Scratch scratch;
  const app::Design read = app::read_design(scratch.write("panel.yaml", panel));
  app::PrintJob job = prepare_fitting_print(read, read.process, {}, false).job;
  const auto text = [&] { return print_text(job, path_clearance(job.sheet), std::nullopt); };
  EXPECT_THAT(text(), HasSubstr("force        not computed"));
  EXPECT_THAT(text(), Not(HasSubstr("no drive is known")));
  job.folding = app::Folding{.name = {}, .why_not = "it buckles"};
  EXPECT_THAT(text(), HasSubstr("force        it buckles"));
  EXPECT_THAT(text(), HasSubstr("no drive is known"));
  job.folding = app::Folding{.name = "one hinge that is turned", .load = 30, .is_force = false};
  EXPECT_THAT(text(), HasSubstr("by hand with 30 N mm about one hinge\n"));
  EXPECT_THAT(text(), Not(HasSubstr("no drive is known")));
}

// Pins have friction of 0.1 N mm/rad each. The same force is in print.json, in print.txt, on the card, and in the
// equilibrium of the design.
TEST(FoldingCard, HasTheForceOfTheEquilibrium) {
  const Scratch scratch;
  std::string design = panel;
  design += "hinge: {kind: pin, diameter_mm: 1, clearance_mm: 0.05}\n";
  ASSERT_EQ(exported(scratch, design, "--format svg").code, 0);
  const auto json = print_json_of(scratch);
  EXPECT_EQ(json["folds"], "by hand");
  const double force = json["force_N"];
  const std::string said = fmt::format("{:.3g} N", force);
  EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr(said + " of friction"));
  EXPECT_THAT(text_of(scratch / "out/card.html"), HasSubstr("It takes " + said));
  const std::string pdf = text_of(scratch / "out/card.pdf");
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  EXPECT_THAT(pdf, HasSubstr("/Count 1"));
  const std::string out = scratch / "run";
  ASSERT_EQ(
      kinetix_opt("simulate " + std::string(scratch / "panel.yaml") + " --model equilibrium -o " + out).code,
      0);
  const auto result = nlohmann::json::parse(text_of(out + "/result.json"));
  EXPECT_NEAR(double(result["metrics"]["force_N"]) / force, 1, 0.01);
}

}  // namespace
}  // namespace kinetix::testing
