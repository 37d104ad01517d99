#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"
#include "tests/support/rotating_squares.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using TileJson = nlohmann::json;

std::string corners_text(const std::vector<std::vector<Eigen::Vector3d>>& tiles) {
  std::string out;
  for (const auto& tile : tiles) {
    for (const Eigen::Vector3d& c : tile) out += fmt::format("{} {} {} ", c.x(), c.y(), c.z());
    out += "\n";
  }
  return out;
}

/// Writes joints at both faces in both forms: one line with 3, or one line with 1 and one with 2 from either side.
std::string joints_text(const model::TileSheet& sheet) {
  std::string out;
  for (std::size_t j = 0; j < sheet.joints.size(); ++j) {
    const model::TileJoint& t = sheet.joints[j];
    const std::string there = fmt::format("{} {} {} {}", t.first, t.first_corner, t.second, t.second_corner),
                      back = fmt::format("{} {} {} {}", t.second, t.second_corner, t.first, t.first_corner);
    if (!t.both_faces)
      out += there + "\n";
    else
      out += j % 2 == 0 ? there + " 3\n" : there + " 1\n" + back + " 2\n";
  }
  return out;
}

class TileFolder {
 public:
  explicit TileFolder(const model::TileSheet& sheet, bool target = true) {
    fs::create_directory(scratch / "squares");
    scratch.write("squares/vertices.txt", corners_text(sheet.tiles));
    scratch.write("squares/constraints.txt", joints_text(sheet));
    if (target) scratch.write("squares/target.txt", corners_text(sheet.target));
  }
  std::string path() const { return scratch / "squares"; }
  std::string design() const { return scratch / "out/design.yaml"; }

  TileJson import(const std::string& options = "") const {
    const Outcome run =
        kinetix_opt("import " + path() + "/ " + options + " --json -o " + (scratch / "out").string());
    EXPECT_EQ(run.code, 0) << run.err;
    return TileJson::parse(run.out);
  }

  void expect_refused(const std::string& says, const std::string& options = "") const {
    const Outcome run =
        kinetix_opt("import " + path() + " --quiet " + options + " -o " + (scratch / "out").string());
    EXPECT_EQ(run.code, 2) << run.out << run.err;
    EXPECT_THAT(run.err, HasSubstr(says));
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_FALSE(fs::exists(scratch / "out")) << says;
  }

  Scratch scratch;
};

TEST(TileImport, DeploysSquaresToTheirTarget) {
  const TileFolder folder(rotating_squares(5, 4, 0.6));
  const TileJson found = folder.import("--tile-mm 10");
  EXPECT_EQ(found["name"], "squares");
  EXPECT_EQ(found["bodies"], 20);
  EXPECT_EQ(found["hinges"], 31);
  EXPECT_EQ(found["balls"], 0);
  EXPECT_NEAR(found["target_off"].get<double>(), 0, 1e-6);
  EXPECT_NEAR(found["scale_mm"].get<double>(), 10, 1e-9);
  EXPECT_EQ(kinetix_opt("check " + folder.design()).code, 0);
  const std::string out = (folder.scratch / "run").string();
  const Outcome run = kinetix_opt("verify " + folder.design() + " -o " + out + " --json");
  ASSERT_EQ(run.code, 0) << run.err;
  const TileJson result = TileJson::parse(run.out);
  EXPECT_EQ(schema_errors(TileJson::parse(run.out)), "");
  EXPECT_LT(result["metrics"]["pull_rms"], 1e-5);
  EXPECT_LT(result["metrics"]["verify_rms"], 1e-5);
  EXPECT_NEAR(result["metrics"]["theta_rad"].get<double>(), 0.6, 1e-5);
  EXPECT_EQ(kinetix_opt("simulate " + out + "/design.yaml -o " + out + "_again").code, 0);
  EXPECT_EQ(kinetix_opt("export " + folder.design() + " --format stl,glb -o " + out + "_print").code, 0);
}

TEST(TileImport, DeploysTheShippedSheets) {
  for (const char* sheet : {"squares", "vault"}) {
    const Scratch scratch;
    const std::string out = (scratch / "out").string();
    ASSERT_EQ(
        kinetix_opt(std::string("import " KINETIX_SOURCE "/targets/tiles/") + sheet + " -o " + out).code, 0)
        << sheet;
    const Outcome run = kinetix_opt("verify " + out + "/design.yaml -o " + out + "/run --json");
    ASSERT_EQ(run.code, 0) << sheet << run.err;
    EXPECT_EQ(schema_errors(TileJson::parse(run.out)), "");
    EXPECT_LT(TileJson::parse(run.out)["metrics"]["pull_rms"], 0.05) << sheet;
  }
}

TEST(TileImport, PullsSquaresApartWhereTheyHaveNoTarget) {
  const TileFolder folder(rotating_squares(4, 4, 0.6), false);
  EXPECT_EQ(folder.import()["target_off"], nullptr);
  EXPECT_THAT(text_of(folder.design()), HasSubstr("drive: {expand: 3}"));
  const std::string out = (folder.scratch / "run").string();
  const Outcome run = kinetix_opt("simulate " + folder.design() + " -o " + out + " --json");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NEAR(TileJson::parse(run.out)["metrics"]["theta_rad"].get<double>(), 0.7854, 0.05);
}

/// Returns the result.json of `simulate` or `verify` for an import.
TileJson run_of(const TileFolder& folder, const std::string& command, int code) {
  const Outcome run = kinetix_opt(command + " " + folder.design() + " --json --quiet -o " +
                                  (folder.scratch / "run").string());
  EXPECT_EQ(run.code, code) << run.out << run.err;
  const TileJson result = TileJson::parse(run.out);
  EXPECT_EQ(schema_errors(TileJson::parse(run.out)), "");
  return result;
}

std::string first_error(const TileJson& result) {
  const TileJson& problems = result["verdict"]["problems"];
  return problems.empty() || problems[0]["level"] != "error" ? "" : problems[0]["text"].get<std::string>();
}

// Squares joined at both ends of their edges cannot turn. Their target is another closed state that no motion reaches.
TEST(TileImport, SaysThatSheetsThatDoNotMoveAreNoMechanism) {
  for (const auto& [columns, rows] : {std::pair{2, 2}, {3, 2}, {4, 4}}) {
    model::TileSheet sheet = rotating_squares(columns, rows, 0.6);
    const auto joints = sheet.joints;
    for (const model::TileJoint& joint : joints) {  // the other end of each edge, too
      const int other = joint.second == joint.first + 1 ? 3 : 1;
      sheet.joints.push_back(
          {joint.first, joint.first_corner ^ other, joint.second, joint.second_corner ^ other, true});
    }
    const TileFolder folder(sheet);
    folder.import();
    for (const char* command : {"simulate", "verify"}) {
      const TileJson result = run_of(folder, command, 3);
      EXPECT_EQ(result["verdict"]["met"], false);
      EXPECT_EQ(result["verdict"]["reaches"], false);
      EXPECT_THAT(first_error(result), HasSubstr("two separate states, not a mechanism between them"));
    }
  }
}

// Tiles that move, with targets that their joints do not allow: one tile shifted, all tiles farther apart, one tile
// turned.
TEST(TileImport, ATargetThatIsMissedByMoreThanTheToleranceIsThree) {
  const auto missed = [](model::TileSheet sheet, const std::string& who) {
    const TileFolder folder(sheet);
    folder.import();
    const TileJson result = run_of(folder, "simulate", 3);
    EXPECT_EQ(result["verdict"]["met"], false) << who;
    EXPECT_EQ(result["tolerance"]["pull"], 0.05) << who;
    EXPECT_GT(result["metrics"]["pull_rms"], 0.05) << who;
    EXPECT_THAT(first_error(result), HasSubstr("cell edges (rms) from the requested poses")) << who;
    const std::string design = text_of(folder.design());
    folder.scratch.write("out/design.yaml", design + "tolerance: {pull: 3}\n");
    EXPECT_EQ(run_of(folder, "simulate", 0)["verdict"]["met"], true) << who;
    EXPECT_THAT(text_of(folder.scratch / "run/design.yaml"), HasSubstr("tolerance: {pull: 3}")) << who;
  };
  const model::TileSheet sheet = rotating_squares(3, 3, 0.5);
  model::TileSheet shifted = sheet, apart = sheet, turned = sheet;
  for (Eigen::Vector3d& corner : shifted.target[0]) corner.x() -= 1;
  missed(shifted, "shifted");
  for (std::size_t k = 0; k < apart.target.size(); ++k) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& corner : apart.target[k]) middle += corner / 4;
    for (Eigen::Vector3d& corner : apart.target[k]) corner += 0.5 * middle;
  }
  missed(apart, "apart");
  for (Eigen::Vector3d& corner : turned.target[4])
    corner = Eigen::Vector3d(2 * turned.target[4][0].x(), 0, 0) - corner;
  missed(turned, "turned");
}

TEST(TileImport, AToleranceWithoutPosesIsRefused) {
  const TileFolder folder(rotating_squares(2, 2, 0.4), false);
  folder.import();
  folder.scratch.write("out/design.yaml", text_of(folder.design()) + "tolerance: {pull: 0.1}\n");
  const Outcome run = kinetix_opt("check " + folder.design());
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("tolerance.pull: only applies to bodies that are pulled to `drive.poses`"));
}

TEST(TileImport, JoinsByBallsWhereOneFaceHolds) {
  model::TileSheet sheet = rotating_squares(3, 3, 0.4);
  for (model::TileJoint& joint : sheet.joints) joint.both_faces = false;
  const TileFolder folder(sheet);
  EXPECT_EQ(folder.import()["balls"], 12);
  EXPECT_THAT(text_of(folder.design()), HasSubstr("kind: ball"));
  EXPECT_THAT(kinetix_opt("simulate " + folder.design() + " --model equilibrium -o " +
                          (folder.scratch / "run").string())
                  .err,
              HasSubstr("drive: the model equilibrium turns one hinge"));
  EXPECT_THAT(
      kinetix_opt("simulate " + folder.design() + " --theta-deg 10 -o " + (folder.scratch / "run").string())
          .err,
      HasSubstr("the drive pulls bodies, and --fold-angle-deg needs a hinge"));
}

TEST(TileImport, SaysWhereAFileIsWrong) {
  const model::TileSheet sheet = rotating_squares(2, 1, 0.4);
  const auto with = [&](const char* file, const std::string& text, const std::string& says) {
    const TileFolder folder(sheet);
    folder.scratch.write(std::string("squares/") + file, text);
    folder.expect_refused(says);
  };
  with("vertices.txt", "0 0 0 1 0 0 1 1 0\n1 0 0 two 0 0 2 1 0\n", "vertices.txt:2:7: this is not a number");
  with("vertices.txt", "0 0 0 1 0 0 1 1 nan\n", "vertices.txt:1:17: this is not a number");
  with("vertices.txt", "0 0 0 1 0 0 1 1\n", "vertices.txt:1:1: the line has 8 numbers");
  with("vertices.txt", "\n\n", "vertices.txt: the file has no tiles");
  with("constraints.txt", "0 1 1 0 4\n",
       "constraints.txt:1:9: face 4 is not known. Give 1 (bottom), 2 (top) or 3 (both)");
  with("constraints.txt", "0 1 1\n", "constraints.txt:1:1: the line has 3 numbers");
  with("constraints.txt", "0 1 1 0.5 3\n", "constraints.txt:1:7: this is not a whole number");
  with("constraints.txt", "0 1 9 0 3\n", "squares: joint 1: the file has no tile 9");
  with("target.txt", "0 0 0 1 0 0 1 1 0\n", "target.txt: the file has 1 tiles, and vertices.txt has 2");
  with("target.txt", "0 0 0 1 0 0 1 1 0\n0 0 0 1 0 0 1 1 0\n",
       "target.txt: tile 1 has 3 corners, and 4 in vertices.txt");
  const TileFolder folder(sheet);
  folder.expect_refused("--hard only applies to models with hard and soft parts", "--hard a.stl");
  folder.expect_refused("--kerf-mm is -1 mm", "--kerf-mm -1");
  folder.expect_refused("tile 1 is narrower than the cuts", "--kerf-mm 30");
  fs::remove(folder.scratch / "squares/constraints.txt");
  folder.expect_refused("constraints.txt");
}

TEST(TileImport, RefusesDrivesThatContradictThemselves) {
  const TileFolder folder(rotating_squares(2, 1, 0.4));
  folder.import();
  const std::string design = text_of(folder.design());
  const std::size_t drive = design.find("drive:");
  const auto refused = [&](const std::string& text, const std::string& says) {
    const std::string file = folder.scratch.write("out/other.yaml", design.substr(0, drive) + text);
    const Outcome run = kinetix_opt("check " + file);
    EXPECT_EQ(run.code, 2) << text;
    EXPECT_THAT(run.err, HasSubstr(says)) << text;
  };
  refused("drive: {expand: 2, angle_deg: 20}\n", "drive.angle_deg: cannot be combined with `expand`");
  refused("drive: {expand: 2, poses: [[0,0,0,1,0,0,0],[0,0,0,1,0,0,0]]}\n",
          "cannot be combined with `poses`");
  refused("drive: {poses: [[0,0,0,1,0,0,0],[0,0,0,1,0,0,0],[0,0,0,1,0,0,0]]}\n",
          "has 3 poses, and the structure has 2 bodies");
  refused("drive: {poses: [[0,0,0,1,0,0,0],[0,0,0,2,0,0,0]]}\n", "the quaternion has length 2");
  refused("drive: {expand: 0}\n", "drive.expand");
  refused("drive: {hinge: joint_1}\n", "angle_deg");
}

}  // namespace
}  // namespace kinetix::testing
