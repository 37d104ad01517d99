#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"
#include "tests/targets/heads.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

// Half of a head's breadth, length and height, mm.
const std::string head = obj_text(ellipsoid({76, 98, 112}));

/// A cap of large cells, quick to verify.
constexpr const char* helmet = R"(kinetix: 1
name: cap
target: {kind: helmet, mesh: head.obj, ribs: 3, coverage_mm: 70, clearance_mm: 11}
structure: {cell_mm: 24}
tolerance: {rms_mm: 1.5, max_mm: 5}
)";

TEST(Helmet, IsFittedVerifiedAndReported) {
  const Scratch scratch;
  scratch.write("head.obj", head);
  const std::string folder = scratch / "out";
  const Outcome run = kinetix_opt(scratch.write("cap.yaml", helmet) + " -o " + folder);
  EXPECT_EQ(run.code, 0) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("goal met"));

  const Json result = Json::parse(text_of(folder + "/result.json"));
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_EQ(result["plan"]["family"], "F4");
  EXPECT_EQ(result["tolerance"], (Json{{"rms_mm", 1.5}, {"max_mm", 5.0}, {"verify", 0.02}}));
  EXPECT_EQ(result["helmet"]["ribs"].size(), 3u);
  EXPECT_EQ(result["target"]["sections_mm"].size(), 3u);
  EXPECT_EQ(result["helmet"]["body_mm"].size(), result["structure"]["bodies"].size());
  EXPECT_EQ(result["helmet"]["cell_mm"].size(), result["structure"]["cells"].size());
  EXPECT_LE(result["metrics"]["distance_rms_mm"], 1.5);
  EXPECT_LE(result["metrics"]["verify_rms"], 1e-4);
  EXPECT_NEAR(double(result["metrics"]["distance_rms_mm_physics"]),
              double(result["metrics"]["distance_rms_mm"]), 1e-3);
  EXPECT_THAT(text_of(folder + "/report.html"), HasSubstr("How it fits the head"));

  const Outcome again =
      kinetix_opt("simulate " + folder + "/design.yaml --model exact -o " + scratch.path() + "/again");
  EXPECT_EQ(again.code, 0) << again.out << again.err;
}

/// The states fit the mesh for any direction of its axes.
TEST(Helmet, IsGivenInTheFrameOfTheMesh) {
  const Scratch scratch;
  targets::TriangleMesh mesh = ellipsoid({76, 98, 112});
  for (Eigen::Vector3d& p : mesh.vertices)
    p = Eigen::Vector3d(p.y(), p.z(), p.x()) + Eigen::Vector3d(500, -40, 10);
  scratch.write("head.obj", obj_text(mesh));
  std::string text = helmet;
  text.replace(text.find("ribs: 3"), 7, "up: y, ribs: 3");
  const Outcome run =
      kinetix_opt(scratch.write("cap.yaml", text) + " --no-verify -o " + scratch.path() + "/out");
  ASSERT_EQ(run.code, 0) << run.out << run.err;
  const Json result = Json::parse(text_of(scratch / "out/result.json"));
  double highest = -1e9;
  for (const Json& pose : result["states"][0]["poses"]) {
    const Json& p = pose["position_mm"];
    highest = std::max(highest, double(p[1]));
    EXPECT_NEAR(double(p[0]), 500, 106);
    EXPECT_NEAR(double(p[2]), 10, 84);
  }
  EXPECT_NEAR(highest, 112 - 40 + 9, 3);
}

TEST(Helmet, SaysHowMuchOfTheHeadIsNearToARib) {
  const Scratch scratch;
  scratch.write("head.obj", head);
  const auto share = [&](const std::string& ribs, const std::string& least, int code) {
    std::string text = helmet;
    text.replace(text.find("ribs: 3"), 7, "ribs: " + ribs);
    text.replace(text.find("max_mm: 5"), 9, "max_mm: 50" + least);
    text.replace(text.find("rms_mm: 1.5"), 11, "rms_mm: 20");
    const Outcome run =
        kinetix_opt(scratch.write("cap.yaml", text) + " --no-verify -o " + scratch.path() + "/out");
    EXPECT_EQ(run.code, code) << run.out << run.err;
    EXPECT_THAT(run.out, HasSubstr("% of the head within a cell edge of a rib"));
    EXPECT_EQ(run.out.find("`tolerance.covered_share`") != std::string::npos, code == 3);
    const Json result = Json::parse(text_of(scratch / "out/result.json"));
    EXPECT_EQ(schema_errors(result), "");
    EXPECT_EQ(result["metrics"]["covered_share"], result["helmet"]["covered_share"]);
    EXPECT_GT(result["metrics"]["goal_max_mm"], result["metrics"]["goal_rms_mm"]);
    return double(result["metrics"]["covered_share"]);
  };
  const double one = share("1", "", 0), three = share("3", "", 0);
  EXPECT_GT(one, 0.1);
  EXPECT_LT(one, three);
  EXPECT_LE(three, 1);
  EXPECT_EQ(share("1", ", covered_share: 0.99", 3), one);
}

TEST(Helmet, ThatIsTooFarOffSaysByHowMuch) {
  const Scratch scratch;
  scratch.write("head.obj", head);
  std::string text = helmet;
  text.replace(text.find("rms_mm: 1.5"), 11, "rms_mm: 1e-3");
  const Outcome run =
      kinetix_opt(scratch.write("cap.yaml", text) + " --no-verify -o " + scratch.path() + "/out");
  EXPECT_EQ(run.code, 3) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("mm rms from head plus clearance; at most 0.001 mm is allowed"));
}

/// Applies to any tolerance.
TEST(Helmet, ThatRunsThroughAThinEarIsNotMet) {
  const Scratch scratch;
  scratch.write("head.obj", obj_text(head_with_thin_ears()));
  constexpr const char* ears = R"(kinetix: 1
name: ears
target: {kind: helmet, mesh: head.obj, front: y, ribs: 3, coverage_mm: 85, clearance_mm: 5}
structure: {cell_mm: 12, wall_mm: {thickness: 1, height: 4}}
tolerance: {rms_mm: 50, max_mm: 50}
)";
  const Outcome run =
      kinetix_opt(scratch.write("ears.yaml", ears) + " --no-verify -o " + scratch.path() + "/out");
  const Json result = Json::parse(text_of(scratch / "out/result.json"));
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_EQ(run.code, 3) << run.out;
  EXPECT_EQ(result["metrics"]["met"], false);
  EXPECT_GT(result["helmet"]["error"]["corners_inside"], 0);
  EXPECT_GT(result["helmet"]["error"]["inside_mm"], 0);
  EXPECT_GT(result["metrics"]["walls_inside"], 0);
  EXPECT_THAT(run.out, HasSubstr("in the head, up to"));
}

TEST(Helmet, WithLessClearanceThanItsWallsReachSaysSo) {
  const Scratch scratch;
  scratch.write("head.obj", head);
  std::string text = helmet;
  text.replace(text.find("clearance_mm: 11"), 16, "clearance_mm: 5");
  const Outcome run =
      kinetix_opt(scratch.write("cap.yaml", text) + " --no-verify -o " + scratch.path() + "/out");
  EXPECT_EQ(run.code, 3) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("clearance_mm is 5, less than half the height of the walls, 7.2 mm"));
}

TEST(Helmet, OverALampshadeSaysThatItsDomeIsInvented) {
  const Scratch scratch;
  scratch.write("lamp.obj", obj_text(lampshade(45)));
  std::string text = helmet;
  text.replace(text.find("head.obj"), 8, "lamp.obj");
  const Outcome run =
      kinetix_opt(scratch.write("cap.yaml", text) + " --no-verify -o " + scratch.path() + "/out");
  EXPECT_THAT(run.out, HasSubstr("A dome closes it"));
  EXPECT_THAT(run.out, HasSubstr("a hole in the covered part, 9"));
  const Json result = Json::parse(text_of(scratch / "out/result.json"));
  EXPECT_EQ(schema_errors(result), "");
  ASSERT_EQ(result["helmet"]["openings"].size(), 1u);
  EXPECT_NEAR(result["helmet"]["openings"][0]["width_mm"], 90, 6);
  EXPECT_THAT(std::string(result["helmet"]["invented"]), HasSubstr("not to the real head"));
  EXPECT_THAT(text_of(scratch / "out/report.html"), HasSubstr("not to the real head"));
}

TEST(Helmet, BadInputIsRefusedAndNothingIsWritten) {
  struct Case {
    std::string was, is;
    std::vector<std::string> says;
  };
  const std::vector<Case> cases = {
      {"mesh: head.obj", "mesh: none.obj", {"cap.yaml:3", "target.mesh", "none.obj"}},
      {"mesh: head.obj", "mesh: empty.obj", {"target.mesh", "triangle"}},
      {"mesh: head.obj", "mesh: nan.obj", {"target.mesh", "nan"}},
      {"mesh: head.obj", "mesh: head.obj, units: m", {"target.units", "units: mm"}},
      {"mesh: head.obj", "mesh: head.obj, units: ell", {"target.units", "allowed"}},
      {"mesh: head.obj", "mesh: head.obj, crown: [0, 0, 400]", {"target.crown", "mm from the mesh"}},
      {"mesh: head.obj", "mesh: head.obj, front: z", {"target.front"}},
      {"coverage_mm: 70", "coverage_mm: 190", {"target.coverage_mm", "beyond the mesh"}},
      {"clearance_mm: 11", "clearance_mm: -1", {"target.clearance_mm"}},
      {"ribs: 3", "ribs: 0", {"target.ribs"}},
      {"ribs: 3", "ribs: 60", {"overlap in the flat sheet"}},
      {"ribs: 3", "ribs: 3, spacing_mm: 40", {"target.spacing_mm", "cannot be combined with target.ribs"}},
      {"ribs: 3", "spacing_mm: 30", {"target.spacing_mm", "overlap in the flat sheet"}},
      {"cell_mm: 24", "cell_mm: 0.01", {"structure.cell_mm"}},
      {"cell_mm: 24", "cells: [3, 3]", {"structure.cells"}},
      {"max_mm: 5", "max_mm: 5, shape: 1", {"tolerance.shape"}},
      {"name: cap", "name: cap\nsolver: {starts: 1}", {"cap.yaml:3:10: solver.starts: ", "single start"}},
      {"name: cap", "name: cap\nsolver: {name: mma}", {"solver.name", "Give ceres"}},
  };
  for (const Case& bad : cases) {
    const Scratch scratch;
    scratch.write("head.obj", head);
    scratch.write("empty.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    scratch.write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    std::string text = helmet;
    text.replace(text.find(bad.was), bad.was.size(), bad.is);
    const Outcome run = kinetix_opt(scratch.write("cap.yaml", text) + " -o " + scratch.path() + "/out");
    EXPECT_EQ(run.code, 2) << bad.is << "\n" << run.out << run.err;
    for (const std::string& words : bad.says) EXPECT_THAT(run.err, HasSubstr(words)) << bad.is;
    EXPECT_FALSE(std::filesystem::exists(scratch / "out")) << bad.is;
  }
}

}  // namespace
}  // namespace kinetix::testing
