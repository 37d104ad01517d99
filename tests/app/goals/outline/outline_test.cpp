#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <stop_token>

#include "app/exports/exporters.hpp"
#include "app/goals/outline/outline_goal.hpp"
#include "app/goals/registry.hpp"
#include "app/pipeline/pipeline.hpp"
#include "model/base/invalid_input.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "targets/outline/outline.hpp"
#include "tests/app/searched_goal.hpp"
#include "tests/support/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"

namespace kinetix::app {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

RunOptions quick_outline(bool verify = false) {
  RunOptions options;
  options.verify = verify;
  return options;
}

RunOptions on_threads(int threads) {
  RunOptions options = quick_outline();
  options.threads = threads;
  return options;
}

std::string ring(int points, double across, double high) {
  std::string text = "[";
  for (int k = 0; k < points; ++k)
    text += (k ? ", [" : "[") + std::to_string(across * std::cos(2 * pi * k / points)) + ", " +
            std::to_string(high * std::sin(2 * pi * k / points)) + "]";
  return text + "]";
}

std::string target(const std::string& points, const std::string& rest = "") {
  return "kinetix: 1\ntarget: {kind: outline, points: " + points + "}\n" + rest;
}

app::Run run_of(const std::string& text, bool verify) {
  TemporaryFolder folder;
  return run_goal(*read_target(folder.write("rim.yaml", text)).goal, quick_outline(verify));
}

/// Searches without checks of prints and contact. @param threads 0 = all cores
SearchResult searched_rim(const std::string& text, int threads = 0) {
  TemporaryFolder folder;
  return read_target(folder.write("rim.yaml", text)).goal->search(on_threads(threads));
}

/// Searches and measures without checks of prints and contact.
app::Run measured_rim(const std::string& text) {
  TemporaryFolder folder;
  return testing::searched_goal(*read_target(folder.write("rim.yaml", text)).goal, quick_outline());
}

nlohmann::json written(app::Run& run) {
  TemporaryFolder folder;
  return write_results(run, folder.path(".")).result;
}

/// Computes the rms distance of the boundary from a circle, as a share of the diameter times sqrt(2). Uses the poses
/// alone.
double rms_from_circle(const nlohmann::json& result) {
  std::vector<Eigen::Vector2d> rim;
  for (const int body : result["outline"]["rim"]) {
    const auto& p = result["states"][0]["poses"][body]["position_mm"];
    rim.push_back({p[0].get<double>(), p[1].get<double>()});
  }
  // Fits a circle by linear least squares: |p|^2 = 2 c p + (r^2 - c^2).
  Eigen::MatrixXd rows(rim.size(), 3);
  Eigen::VectorXd squares(rim.size());
  for (std::size_t k = 0; k < rim.size(); ++k) {
    rows.row(static_cast<Eigen::Index>(k)) << 2 * rim[k].x(), 2 * rim[k].y(), 1;
    squares[static_cast<Eigen::Index>(k)] = rim[k].squaredNorm();
  }
  const Eigen::Vector3d fit = (rows.transpose() * rows).ldlt().solve(rows.transpose() * squares);
  const double radius = std::sqrt(fit[2] + fit.head<2>().squaredNorm());
  double sum = 0;
  for (const Eigen::Vector2d& p : rim) sum += std::pow((p - fit.head<2>()).norm() - radius, 2);
  return std::sqrt(sum / static_cast<double>(rim.size())) / (2 * std::sqrt(2.0) * radius);
}

/// Formats a polygon that is turned about the origin as a YAML list.
std::string turned_points(const std::vector<Eigen::Vector2d>& points, double degrees) {
  const Eigen::Rotation2Dd turn(degrees * pi / 180);
  std::string text = "[";
  for (const Eigen::Vector2d& p : points) {
    const Eigen::Vector2d q = turn * p;
    text += fmt::format("{}[{:.9f}, {:.9f}]", text.size() > 1 ? ", " : "", q.x(), q.y());
  }
  return text + "]";
}

/// Returns points at r(angle) around the origin, mm.
std::vector<Eigen::Vector2d> round_points(int count, const std::function<double(double)>& radius) {
  std::vector<Eigen::Vector2d> out;
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * pi * k / count;
    out.push_back(radius(angle) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return out;
}

// An outline with two axes of symmetry, mm.
const std::vector<Eigen::Vector2d> ellipse =
    round_points(80, [](double a) { return 1 / std::hypot(std::cos(a) / 60, std::sin(a) / 40); });
// An outline with one axis of symmetry, mm.
const std::vector<Eigen::Vector2d> pear =
    round_points(60, [](double a) { return 50 + 12 * std::cos(a) + 6 * std::cos(2 * a); });
// An outline with four axes of symmetry, mm.
const std::vector<Eigen::Vector2d> clover =
    round_points(64, [](double a) { return 50 + 8 * std::cos(4 * a); });
const std::string gently_pressed =
    "variables: {offset_mm: 0.3, t: {range: [0.25, 0.75]}, theta: {range_deg: [30, 40]}}\ntolerance: {shape: "
    "0.05, iou: 0.8}\n";

// Regression: the panel overlapped the ellipse by 79 or 90 % of its area, depending on the orientation of the drawing.
TEST(Outline, DoesNotDependOnHowItWasTurnedWhenItWasDrawn) {
  struct Case {
    const char* name;
    std::vector<Eigen::Vector2d> points;
    const char* structure;
  };
  const Case cases[] = {
      {"ellipse", ellipse,
       "structure: {cells: [6, 6], trim: none, cell_mm: 12, wall_mm: {thickness: 1.5, height: 8}}\n"},
      {"pear", pear,
       "structure: {cells: [6, 4], trim: none, cell_mm: 12, wall_mm: {thickness: 1.5, height: 8}}\n"},
      {"clover", clover,
       "structure: {cells: [5, 5], trim: none, cell_mm: 12, wall_mm: {thickness: 1.5, height: 8}}\n"},
      {"pear of a cut", pear,
       "structure: {cells: [6, 6], trim: outline, cell_mm: 12, wall_mm: {thickness: 1.5, height: 8}}\n"}};
  for (const Case& one : cases) {
    double rms = 0, iou = 0;
    for (const double degrees : {0.0, 45.0, 199.0}) {
      const SearchResult found =
          searched_rim(target(turned_points(one.points, degrees), one.structure + gently_pressed));
      const auto& error = outcome_of<OutlineOutcome>(found).design.error;
      if (degrees == 0) rms = error.rms, iou = error.iou;
      EXPECT_NEAR(error.rms, rms, 0.01 * rms) << one.name << " turned by " << degrees;
      EXPECT_NEAR(error.iou, iou, 0.01) << one.name << " turned by " << degrees;
    }
  }
}

TEST(Outline, LiesAsItWasDrawn) {
  for (const double degrees : {0.0, 130.0}) {
    app::Run run = run_of(
        target(turned_points(pear, degrees),
               "structure: {cells: [6, 6], trim: none, cell_mm: 12, wall_mm: {thickness: 1.5, height: 8}}\n" +
                   gently_pressed),
        false);
    const auto result = written(run);
    const auto& outline = result["outline"];
    const double size = outline["size"];
    const auto point = [](const nlohmann::json& p) {
      return Eigen::Vector2d(p[0].get<double>(), p[1].get<double>());
    };
    const auto &drawn = result["target"]["points_mm"], &placed = outline["goal_mm"];
    for (std::size_t k = 1; k < pear.size(); ++k)
      EXPECT_NEAR((point(placed[k]) - point(placed[0]) - size * (point(drawn[k]) - point(drawn[0]))).norm(),
                  0, 1e-6);
    // The boundary of the sheet is on the outline that the result contains.
    std::vector<Eigen::Vector2d> corners;
    for (const auto& p : placed) corners.push_back(point(p));
    const targets::Outline goal(corners);
    double sum = 0;
    for (const int body : outline["rim"])
      sum += std::pow(goal.nearest(point(result["states"][0]["poses"][body]["position_mm"])).distance, 2);
    const double rms = std::sqrt(sum / static_cast<double>(outline["rim"].size()));
    EXPECT_NEAR(rms, result["metrics"]["outline_rms"].get<double>() * outline["diagonal_mm"].get<double>(),
                1e-6);
  }
}

TEST(Outline, OfASquarePanelIsADiscWhenItIsPressed) {
  app::Run run = run_of(
      target(ring(120, 60, 60),
             "structure: {cells: [8, 8], trim: none, cell_mm: 10, wall_mm: {thickness: 0.8, height: 6}}\n"
             "variables: {offset_mm: 0.8, theta: {range_deg: [30, 40]}}\ntolerance: {shape: 0.01}\n"),
      true);
  ASSERT_TRUE(run.met()) << run.violations.front();
  EXPECT_TRUE(run.verification->agrees);
  const auto result = written(run);
  EXPECT_LE(result["metrics"]["outline_rms"].get<double>(), 0.01);
  EXPECT_NEAR(result["metrics"]["outline_rms"].get<double>(), rms_from_circle(result), 1e-3);
  EXPECT_LE(result["metrics"]["outline_rms_physics"].get<double>(), 0.01);
  EXPECT_LE(result["outline"]["offset_mm"].get<double>(), 0.8 + 1e-12);
  EXPECT_LE(result["metrics"]["theta_rad"].get<double>(), 40 * radians_per_degree + 1e-12);
}

TEST(Outline, KeepsWallsApartAndHingesClosedAllTheWay) {
  app::Run run = run_of(target(ring(100, 60, 60), "structure: {cells: [8, 8], trim: none}\n"), false);
  const model::ExactMotion exact = exact_motion(run.design.structure);
  ASSERT_TRUE(exact);
  model::WallContact contact(run.design.structure);
  for (const double part : {0.2, 0.5, 0.8, 1.0}) {
    const model::State state = exact.at(part * run.theta);
    EXPECT_LE(hinge_gaps(run.design.structure, state).max, 1e-12);
    EXPECT_TRUE(contact.overlapping(state).empty()) << part;
  }
}

TEST(Outline, CutsTheLatticeToShapeWhereNoCellsAreGiven) {
  app::Run run = run_of(target(ring(150, 90, 60)), false);
  ASSERT_TRUE(run.met()) << run.violations.front();
  const auto result = written(run);
  EXPECT_GT(result["outline"]["cuts"], 1);
  EXPECT_GE(result["metrics"]["iou"].get<double>(), 0.95);
  EXPECT_NEAR(result["outline"]["size"].get<double>(), 1, 2e-3) << "as large as drawn";
}

TEST(Outline, TakesHexagonsWithAClosedRim) {
  const app::Run run =
      measured_rim(target(ring(100, 60, 60), "structure: {lattice: honeycomb, cells: [6, 6], trim: none}\n"));
  EXPECT_EQ(model::lattice_name(run.design.structure), "honeycomb");
  EXPECT_EQ(run.plan.mobility->dofs_along, 1);
  EXPECT_LE(testing::unwritten_result(run)["metrics"]["outline_rms"].get<double>(), 0.03);
}

TEST(Outline, MayBePrescribedFlatAndPressed) {
  const app::Run run = measured_rim(
      "kinetix: 1\ntarget: {kind: outline, points: " + ring(100, 60, 60) +
      ", flat: [[-60, -60], [60, -60], [60, 60], [-60, 60]]}\nstructure: {cells: [8, 8], trim: none}\n");
  const auto result = testing::unwritten_result(run);
  EXPECT_LE(result["metrics"]["outline_rms"].get<double>(), 0.015);
  EXPECT_LE(result["metrics"]["flat_rms"].get<double>(), 0.015);
  EXPECT_EQ(result["structure"]["lattice"], "graph");
  EXPECT_LE(result["states"][0]["hinge_gap_max"].get<double>(), 1e-12);
  EXPECT_EQ(run.plan.mobility->dofs_along, 1);
}

/// Computes the rms error of the poses in a result against the outline that the result draws below them.
double shown_rms(const nlohmann::json& result) {
  std::vector<Eigen::Vector2d> goal, rim;
  for (const auto& p : result["outline"]["goal_mm"]) goal.emplace_back(p[0], p[1]);
  for (const int body : result["outline"]["rim"]) {
    const auto& p = result["states"][0]["poses"][body]["position_mm"];
    rim.emplace_back(p[0], p[1]);
  }
  return outline_error(targets::Outline(goal), rim).rms;
}

/// All hinges are on their walls: the file allows no offset, or the blocks are as thick as the walls.
TEST(Outline, MovesExactlyWithAllHingesOnTheirWalls) {
  const std::string plain = "variables: {offset_mm: 0}\n";
  for (const std::string& rest : {"structure: {cells: [6, 6], trim: none, cell_mm: 10}\n" + plain,
                                  "structure: {cells: [6, 6], trim: outline}\n" + plain,
                                  "structure: {lattice: honeycomb, cells: [3, 3], trim: none}\n" + plain,
                                  "structure: {lattice: rhombus, cells: [4, 4], trim: none}\n" + plain,
                                  std::string("structure: {cells: [4, 4], trim: none, cell_mm: 10}\nhinge: "
                                              "{model: rotary, kind: block, material: "
                                              "tango, gap_mm: 1}\n")}) {
    SCOPED_TRACE(rest);
    app::Run run = run_of(target("[[0, 0], [60, 0], [60, 40], [0, 40]]", rest), false);
    ASSERT_TRUE(run.plan.exact) << run.plan.exact.why;
    for (int h = 0; h < run.design.structure.hinges(); ++h)
      EXPECT_EQ(run.design.structure.hinge(h).offset, 0);
    EXPECT_LE(run.states.front().gaps.max, 1e-12);
    const auto result = written(run);
    EXPECT_NEAR(shown_rms(result), result["outline"]["exact"]["rms"].get<double>(), 1e-9);
  }
}

TEST(Outline, OfASheetWithoutAnExactMotionIsRefused) {
  SearchResult found = run_of(target("[[0, 0], [60, 0], [60, 40], [0, 40]]",
                                     "structure: {lattice: honeycomb, cells: [3, 3], trim: none}\n"),
                              false);
  std::vector<model::HingeParameters>& hinges = found.design.structure.planar()->hinges;
  hinges[hinges.size() / 2].beta = 0.3;
  found.plan = {};  // the plan belongs to the sheet before the change
  try {
    planned(found);
    FAIL() << "no error";
  } catch (const InvalidInput& e) {
    EXPECT_THAT(e.what(), HasSubstr("no analytic motion: "));
  }
}

TEST(Outline, IsTheSameForAnyNumberOfThreads) {
  const auto offsets = [](int threads) {
    const SearchResult found = searched_rim(target(ring(60, 60, 50), gently_pressed), threads);
    std::vector<double> all;
    for (int h = 0; h < found.design.structure.hinges(); ++h)
      all.push_back(found.design.structure.hinge(h).offset);
    return all;
  };
  EXPECT_EQ(offsets(1), offsets(2));
}

TEST(Outline, SaysWhatHoldsARimBack) {
  app::Run run = run_of(target(ring(100, 120, 40), "structure: {cells: [6, 6], trim: none}\n"), false);
  EXPECT_FALSE(run.met());
  EXPECT_THAT(run.violations.front(), HasSubstr("of the area overlaps"));
  std::string lines;
  for (const auto& [label, words] : run.goal->summary_lines(run)) lines += label + ": " + words + "\n";
  EXPECT_THAT(lines, HasSubstr("of the walls have the largest offset"));
}

TEST(Outline, RefusesWhatIsNone) {
  const testing::BadInput bad[] = {
      {target("[[0, 0], [10, 10], [10, 0], [0, 10]]"), 2, 52, "target.points[2]", {"crosses itself"}},
      {target("[[0, 0], [10, 0]]"), 2, 33, "target.points", {"at least 3 points"}},
      {target(ring(8, 60, 60), "structure: {cells: [[0, 0], [1, 1]]}\n"),
       3,
       20,
       "structure.cells",
       {"rectangle"}},
      {target(ring(8, 60, 60), "structure: {rim: closed}\n"),
       3,
       13,
       "structure.rim",
       {"one degree of freedom"}},
      {target(ring(8, 60, 60), "variables: {t: {range: [0.6, 0.9]}}\n"),
       3,
       24,
       "variables.t.range",
       {"does not contain 0.5"}},
      {target(ring(8, 60, 60), "variables: {theta: {range_deg: [20, 60]}}\n"),
       3,
       37,
       "variables.theta.range_deg[1]",
       {"below 45"}},
  };
  for (const testing::BadInput& input : bad) {
    TemporaryFolder folder;
    const std::string file = folder.write("rim.yaml", input.text);
    testing::expect_refused(input, file, [&] { read_target(file); });
  }
}

TEST(Outline, ThatTookAsManyRoundsAsItMaySaysSo) {
  app::Run run = run_of(target(ring(60, 60, 50), "structure: {cells: [4, 4], trim: none}\n"), false);
  const auto outline = std::make_shared<OutlineOutcome>(outcome_of<OutlineOutcome>(run));
  run.goal = outline;
  optim::OutlineDesign& design = outline->design;
  design.clear = true;
  for (const bool settled : {true, false}) {
    design.settled = settled;
    const nlohmann::json ended = written(run)["optimiser"];
    EXPECT_EQ(ended["status"], settled ? "converged" : "evaluation limit");
    EXPECT_THAT(ended["why"].get<std::string>(),
                HasSubstr(settled ? "converged, no" : "stopped at the iteration limit before converging"));
  }
  design.clear = false;
  design.clearance_rounds = 9;
  const nlohmann::json ended = written(run)["optimiser"];
  EXPECT_EQ(ended["status"], "failed");
  EXPECT_THAT(ended["why"].get<std::string>(),
              HasSubstr("walls still collide during folding after 9 rounds"));
}

TEST(Outline, ThatIsStoppedSaysNeitherThatItEndedNorThatNothingHelps) {
  TemporaryFolder folder;
  std::stop_source stop;
  stop.request_stop();
  RunOptions options = quick_outline();
  options.stop = stop.get_token();
  app::Run run = run_goal(*read_target(folder.write("rim.yaml", target(ring(60, 60, 50)))).goal, options);
  const nlohmann::json result = written(run);
  EXPECT_EQ(result["optimiser"]["status"], "stopped");
  for (const auto& why : result["outline"]["reasons"])
    EXPECT_EQ(why.get<std::string>().find("use thinner walls"), std::string::npos) << why;
}

}  // namespace
}  // namespace kinetix::app
