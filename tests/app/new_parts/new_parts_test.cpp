#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/exports/exporters.hpp"
#include "app/goals/registry.hpp"
#include "app/pipeline/pipeline.hpp"
#include "app/result/result_json.hpp"
#include "app/sweep/plan/metric.hpp"
#include "tests/support/temporary_folder.hpp"

/// Tests the parts that width_goal.cpp, areas_export.cpp and window_lattice.cpp add to this program. Each is one file
/// and one line in CMakeLists.txt: nothing else in the project depends on it.
namespace kinetix::app {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::TemporaryFolder;

std::string strip(double width_mm) {
  return "kinetix: 1\ntarget: {kind: width, width_mm: " + std::to_string(width_mm) +
         ", cells: 6, cell_mm: 10}\n";
}

Run run_of(const std::string& text) {
  TemporaryFolder folder;
  return run_goal(*read_target(folder.write("strip.yaml", text)).goal, {});
}

nlohmann::json written(const TemporaryFolder& folder, const std::string& name) {
  return nlohmann::json::parse(testing::read_file(folder.path(name)));
}

TEST(NewGoalKind, IsOneMoreThanThoseThatShip) {
  EXPECT_EQ(goal_kinds().size(), 9u);
  EXPECT_EQ(goal_kinds().back()->name, "width");
}

TEST(NewGoalKind, GoesFromItsFileToResultJson) {
  app::Run run = run_of(strip(50));
  TemporaryFolder folder;
  write_results(run, folder.path("."));
  const auto json = written(folder, "result.json");
  EXPECT_EQ(json["name"], "strip");
  EXPECT_EQ(json["target"]["kind"], "width");
  EXPECT_NEAR(json["metrics"]["width_mm"].get<double>(), 50, 1e-9);
  EXPECT_NEAR(json["metrics"]["theta_rad"].get<double>(), std::acos(50.0 / 60), 1e-9);
  EXPECT_TRUE(json["metrics"]["met"].get<bool>());
  EXPECT_TRUE(json["metrics"]["verified"].get<bool>());
  EXPECT_EQ(json["tolerance"]["width_mm"], 1e-9);
  EXPECT_THAT(summary(run), HasSubstr("  width      50.0"));
}

TEST(NewGoalKind, SaysWhatItMissed) {
  const app::Run run = run_of(strip(61));
  EXPECT_FALSE(run.met());
  EXPECT_THAT(run.violations, Contains("no theta has this width"));
}

TEST(NewGoalKind, GivesSweepsItsMetrics) {
  EXPECT_THAT(metric_names({.model = Model::exact, .searches = true}), Contains("width_mm"));
  EXPECT_THAT(metric_names({.model = Model::exact, .searches = false}), Not(Contains("width_mm")));
}

/// Computes the area of the first cell from the corners in result.json.
double first_area(const nlohmann::json& result) {
  std::vector<std::array<double, 2>> corners;
  for (const int body : result["structure"]["cells"][0]["bodies"])
    corners.push_back({result["states"][0]["poses"][body]["position_mm"][0].get<double>(),
                       result["states"][0]["poses"][body]["position_mm"][1].get<double>()});
  double twice = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto &a = corners[k], &b = corners[(k + 1) % corners.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return std::abs(twice) / 2;
}

TEST(NewExporter, WritesItsFileBesideTheOthers) {
  ASSERT_EQ(exporters().size(), 5u);
  app::Run run = run_of(strip(50));
  TemporaryFolder folder;
  write_results(run, folder.path("."));
  const double area = std::stod(testing::read_file(folder.path("areas/flat.txt")));
  EXPECT_NEAR(area, first_area(written(folder, "result.json")), 1e-5);
  EXPECT_LT(area, 100);
  for (const char* name : {"design.yaml", "report.html"})
    EXPECT_TRUE(std::filesystem::exists(folder.path(name))) << name;
}

TEST(NewLattice, GoesFromItsFileToResultJson) {
  TemporaryFolder folder;
  const std::string file = folder.write(
      "panel.yaml",
      "kinetix: 1\nstructure: {lattice: window, cells: [3, 2], cell_mm: 12}\ndesign: {theta_deg: 20}\n");
  app::Run run = run_design(read_design(file), Model::exact, {});
  write_results(run, folder.path("."));
  const auto json = written(folder, "result.json");
  EXPECT_EQ(json["structure"]["lattice"], "window");
  EXPECT_EQ(json["structure"]["cells"][5]["cell"], nlohmann::json::parse("[2, 1]"));
  EXPECT_EQ(json["structure"]["cells"][5]["bodies"].size(), 6u);
  EXPECT_EQ(json["plan"]["family"], "planar");
  EXPECT_LE(json["states"][0]["hinge_gap_max"].get<double>(), 1e-12);
  const Design again = read_design(folder.path("design.yaml"));
  EXPECT_EQ(lattice_name(again.structure), "window");
  EXPECT_EQ(again.structure.hinges(), run.design.structure.hinges());
}

}  // namespace
}  // namespace kinetix::app
