#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <chrono>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/print/fit.hpp"
#include "app/print/format/print_format.hpp"
#include "app/print/sheet/coupon.hpp"
#include "app/print/slicer.hpp"
#include "app/report/report.hpp"
#include "tests/app/print/exports.hpp"
#include "tests/app/program.hpp"
#include "tests/support/stl_volume.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

/// The material equals the volume of the sheets, except for skirts and the rounding of lines to whole widths.
TEST(Slicer, TellsTimeAndAsMuchMaterialAsThereIsVolume) {
  for (const char* process : {"fdm", "sla"}) {
    const Scratch scratch;
    ASSERT_EQ(
        exported(scratch, panel, std::string("--format stl --hinge block --slice --process ") + process).code,
        0);
    const Json json = print_json_of(scratch);
    ASSERT_TRUE(json["slicer"].contains("seconds")) << json["slicer"];
    const double own = double(json["volume_mm3"]["hard"]) + double(json["volume_mm3"]["soft"]);
    EXPECT_NEAR(double(json["slicer"]["material_mm3"]) / own, 1, 0.15) << process;
    EXPECT_GT(json["slicer"]["seconds"], 60);
    EXPECT_EQ(json["slicer"]["prints"], std::string(process) == "sla" ? 2 : 1);
    EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr("of material"));
    EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr(", without supports, by PrusaSlicer"));
  }
}

/// Walls that lean by 50 degrees.
std::string steep_panel() {
  return std::string(panel).replace(
      std::string(panel).find("theta_deg: 20"), 13,
      "theta_deg: 15, hinges: [{wall: [[0, 0], [1, 0]], beta_deg: 50}, {wall: [[0, 1], "
      "[1, 1]], beta_deg: -50}, {wall: [[0, 2], [1, 2]], beta_deg: 50}]");
}

/// Undersides of knuckles bridge the gaps of upright pins. Leaning walls need supports, which SLA slices do not count.
TEST(Slicer, CountsTheSupportsThatPrintTxtPlans) {
  for (const auto& [design, options, counted, planned] :
       {std::tuple{std::string(panel), "--hinge pin --process fdm --cell-mm 24", ", without supports, by",
                   "supports     none: the "},
        {std::string(panel), "--hinge pin --process sla", ", without supports, by",
         "supports     none: the "},
        {steep_panel(), "--hinge block --process fdm", ", with supports, by", "supports     under the "},
        {steep_panel(), "--hinge block --process sla", ", without the supports that it needs, by",
         "supports     under the "}}) {
    const Scratch scratch;
    const Outcome run = exported(scratch, design, std::string("--format 3mf --slice ") + options);
    ASSERT_EQ(run.code, 0) << options << run.err;
    EXPECT_THAT(run.out, HasSubstr(counted)) << options;
    EXPECT_THAT(run.out, HasSubstr(planned)) << options;
    const Json settings = print_json_of(scratch)["slicer_settings"]["prusa"];
    EXPECT_EQ(settings.contains("support_material"),
              design == panel && std::string(options).find("fdm") != std::string::npos);
  }
}

/// Writes a program of shell commands. @return its path
std::string script(const Scratch& scratch, const std::string& name, const std::string& commands) {
  const std::string file = scratch.write(name, "#!/bin/sh\n" + commands + "\n");
  fs::permissions(file, fs::perms::owner_all);
  return file;
}

TEST(Slicer, ThatTakesTooLongIsEndedWithAdvice) {
  const Scratch scratch;
  const app::PreparedPrint print = app::prepared(app::read_design(scratch.write("panel.yaml", panel)),
                                                 *model::find_process("sla"), {}, false);
  const std::string slow = script(scratch, "slow", "exec sleep 60");
  const auto start = std::chrono::steady_clock::now();
  const app::SlicerAnswer answer = app::estimate_by_slicer(print.job, slow, 0.5);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
  EXPECT_FALSE(answer.estimate);
  EXPECT_THAT(answer.no_estimate_reason,
              HasSubstr("was ended after 0.5 s: open the 3MF file (--format 3mf) in the slicer itself"));
}

TEST(Slicer, IsOneLineOfProgress) {
  const Scratch scratch;
  script(scratch, "prusa-slicer", "sleep 3; exit 1");
  const Outcome run =
      kinetix_opt("export " + scratch.write("panel.yaml", panel) +
                      " --format stl --hinge block --process sla --slice -o " + std::string(scratch / "out"),
                  "PATH=" + scratch.path() + ":$PATH ");
  ASSERT_EQ(run.code, 0) << run.err;
  const std::size_t first = run.err.find("slicing ... PrusaSlicer, at most 60 s");
  EXPECT_NE(first, std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("slicing", first + 1), std::string::npos) << run.err;
  EXPECT_THAT(run.out, HasSubstr("slicer       prusa-slicer gave up"));
}

/// Loose rods are a separate file and a separate print.
TEST(Slicer, CountsLooseRods) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format stl --hinge pin --process sla --loose-rods --slice").code, 0);
  const Json json = print_json_of(scratch);
  ASSERT_TRUE(json["slicer"].contains("seconds")) << json["slicer"];
  const double hard = json["volume_mm3"]["hard"], rods = volume_of_stl(text_of(scratch / "out/rods.stl"));
  ASSERT_GT(rods, 0.02 * hard);
  EXPECT_NEAR(double(json["slicer"]["material_mm3"]) / (hard + rods), 1, 0.01);
  EXPECT_EQ(json["slicer"]["prints"], 2);
  EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr("in 2 prints"));
}

/// The report next to the design quotes the slicer if the print is of the same sheet.
TEST(Slicer, IsQuotedByTheReportOfTheSameSheet) {
  const Scratch scratch;
  const std::string folder = scratch / "result", page = folder + "/report.html",
                    design = folder + "/design.yaml";
  const std::string small = std::string(panel).replace(std::string(panel).find("[3, 2]"), 6, "[2, 1]");
  ASSERT_EQ(kinetix_opt("simulate " + scratch.write("panel.yaml", small) + " -o " + folder).code, 0);
  const std::string print = "export " + folder + " --format stl --hinge block --slice --process sla -o " +
                            std::string(scratch / "print");
  const Outcome run = kinetix_opt(print);
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("report       " + page));
  const Json reported = Json::parse(app::data_of_report(text_of(page)))["print"],
             slicer = Json::parse(text_of(scratch / "print/print.json"))["slicer"];
  EXPECT_EQ(reported["process"], "sla");
  EXPECT_EQ(reported["hinges"], "block");
  for (const char* key : {"seconds", "material_mm3", "prints"}) EXPECT_EQ(reported[key], slicer[key]) << key;

  const std::string before = text_of(page);
  const Outcome larger = kinetix_opt(print + " --cell-mm 15");
  ASSERT_EQ(larger.code, 0) << larger.err;
  EXPECT_EQ(text_of(page), before) << "of cells of another size";
  EXPECT_EQ(larger.out.find("report       "), std::string::npos) << larger.out;
  ASSERT_EQ(kinetix_opt(print + " --state folded").code, 0);
  EXPECT_EQ(text_of(page), before) << "of the sheet that stands folded in the printer";
  EXPECT_THAT(run.out, Not(HasSubstr("as if one bed held all tiles")));
  const Outcome tiles = kinetix_opt(print + " --bed 20,20");
  ASSERT_EQ(tiles.code, 0) << tiles.err;
  EXPECT_THAT(tiles.out, HasSubstr(" with its own settings for speed, as if one bed held all tiles"));
  EXPECT_EQ(text_of(page), before) << "in two prints one after the other";
  std::string other = small;
  other.replace(other.find("cell_mm: 12"), 11, "cell_mm: 13");
  std::ofstream(design) << other;
  ASSERT_EQ(kinetix_opt(print).code, 0);
  EXPECT_EQ(text_of(page), before);
}

TEST(Slicer, ThatIsNotThereIsSaidInWords) {
  const Scratch scratch;
  const app::PreparedPrint print = app::prepared(app::read_design(scratch.write("panel.yaml", panel)),
                                                 *model::find_process("sla"), {}, false);
  const app::SlicerAnswer answer = app::estimate_by_slicer(print.job, "no-such-slicer");
  EXPECT_FALSE(answer.estimate);
  EXPECT_EQ(answer.no_estimate_reason, "no slicer found: no-such-slicer is not on PATH");
  EXPECT_THAT(app::estimate_by_slicer(print.job, "false").no_estimate_reason, HasSubstr("gave up"));
}

TEST(Slicer, WithoutAProcessThatItKnowsIsNotAsked) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format stl --slice").code, 0);
  EXPECT_EQ(print_json_of(scratch)["slicer"]["why_none"], "no slicer found for polyjet");
}

TEST(Slicer, TimesAreReadInDaysHoursMinutesAndSeconds) {
  EXPECT_EQ(app::seconds_of("17m 40s"), 17 * 60 + 40);
  EXPECT_EQ(app::seconds_of("1d 2h 3m 4s"), 86400 + 2 * 3600 + 3 * 60 + 4);
  EXPECT_TRUE(std::isnan(app::seconds_of("soon")));
}

/// A square frustum on its wide end has no overhang. On its narrow end, its four slanting faces overhang.
TEST(Overhang, IsThatOfAFrustumByHand) {
  model::Polyhedron frustum;
  for (const double half : {1.0, 0.5})
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      frustum.points.emplace_back(half * x, half * y, half == 1 ? 0 : 0.25);
  frustum.add_face({3, 2, 1, 0});
  frustum.add_face({4, 5, 6, 7});
  for (int k = 0; k < 4; ++k) frustum.add_face({k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k});
  const Eigen::Matrix3d flat = Eigen::Matrix3d::Identity(), over = Eigen::Vector3d(1, -1, -1).asDiagonal();
  EXPECT_EQ(app::overhang_mm2(frustum, flat), 0);
  const double slant = std::hypot(0.5, 0.25);
  EXPECT_NEAR(app::overhang_mm2(frustum, over), 4 * 1.5 * slant, 1e-12);
}

TEST(Orientation, OfASheetThatIsLaidOnItsFaceIsThatOfItsFiles) {
  const Scratch flat, over;
  const std::string leaning = std::string(panel).replace(
      std::string(panel).find("theta_deg: 20"), 13,
      "theta_deg: 15, hinges: [{wall: [[0, 0], [1, 0]], beta_deg: 20}, {wall: [[0, 1], "
      "[1, 1]], beta_deg: -20}, {wall: [[0, 2], [1, 2]], beta_deg: 20}]");
  ASSERT_EQ(exported(flat, leaning, "--format stl --hinge block").code, 0);
  ASSERT_EQ(exported(over, leaning, "--format stl --hinge block --orient over").code, 0);
  const Json one = print_json_of(flat), other = print_json_of(over);
  EXPECT_EQ(one["orientation"], "flat");
  EXPECT_EQ(other["orientation"], "over");
  EXPECT_EQ(one["overhang_mm2"], other["overhang_mm2"]) << "of the same sheet";
  EXPECT_NEAR(volume_of_stl(text_of(over / "out/all.stl")) / volume_of_stl(text_of(flat / "out/all.stl")), 1,
              1e-6);
  EXPECT_NE(text_of(over / "out/all.stl"), text_of(flat / "out/all.stl"));
}

/// Formats that are not for printers keep the sheet in its original pose, as their motion does.
TEST(Orientation, LeavesTheSceneWhereItsMotionIs) {
  const Scratch flat, over;
  ASSERT_EQ(exported(flat, panel, "--format glb --hinge block").code, 0);
  ASSERT_EQ(exported(over, panel, "--format glb --hinge block --orient over").code, 0);
  EXPECT_EQ(text_of(over / "out/panel.glb"), text_of(flat / "out/panel.glb"));
  const std::string note = "--orient over changes nothing in glb, where the sheet is in its own place";
  EXPECT_THAT(print_json_of(over)["warnings"].dump(), HasSubstr(note));
  EXPECT_THAT(text_of(over / "out/print.txt"), HasSubstr(note));
  EXPECT_EQ(print_json_of(flat)["warnings"].dump().find("--orient"), std::string::npos);
}

TEST(Orientation, ThatIsProposedHasTheLeastOverhang) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format stl --hinge pin --orient best").code, 0);
  const Json json = print_json_of(scratch);
  const double here = json["overhang_mm2"][std::string(json["orientation"])];
  for (const auto& [way, area] : json["overhang_mm2"].items()) EXPECT_GE(double(area), here) << way;
  ASSERT_EQ(json["orientation"], "flat") << "both sides of upright pins are alike";
  EXPECT_THAT(text_of(scratch / "out/print.txt"), HasSubstr("flat on the bed; "));
  expect_refused(panel, "--format stl --orient upp", "unknown orient `upp`");
}

/// A block of 20 x 2 x 10 mm with text on its front.
TEST(RaisedText, KeepsTheSolidClosedAndAddsItsSquares) {
  model::Polyhedron block;
  for (const double z : {0.0, 10.0})
    for (const auto& [x, y] : {std::pair{0, 0}, {20, 0}, {20, 2}, {0, 2}}) block.points.emplace_back(x, y, z);
  block.add_face({3, 2, 1, 0});
  block.add_face({4, 5, 6, 7});
  for (int k = 0; k < 4; ++k) block.add_face({k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k});
  const app::TextFace face{{9.5, 0, 5}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(), 0.7, 0.4};
  for (const char* text : {"0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "7", "89."}) {
    model::Polyhedron with = block;
    app::raise_text(text, face, with);
    EXPECT_TRUE(is_closed(with)) << text;
    EXPECT_NEAR(volume_mm3(with) - volume_mm3(block), app::raised_squares(text) * 0.7 * 0.7 * 0.4, 1e-9)
        << text;
  }
  EXPECT_EQ(app::raised_squares("0.1"), 12 + 1 + 5);
  EXPECT_THROW(app::raise_text("a", face, block), std::invalid_argument);
  EXPECT_THROW(app::raise_text("0123456789", face, block), std::invalid_argument) << "wider than the block";
  app::TextFace nowhere = face;
  nowhere.middle.y() = -1;
  EXPECT_THROW(app::raise_text("1", nowhere, block), std::invalid_argument);
  EXPECT_TRUE(is_closed(block)) << "as it was";
}

/// The gap of opposite knuckles of a basic cell is L (cos theta - sin theta) minus their width.
TEST(PathClearance, IsThatOfTheClosedFormInABasicPanel) {
  const Scratch scratch;
  const app::PreparedPrint print = app::prepared(app::read_design(scratch.write("panel.yaml", panel)),
                                                 *model::find_process("sla"), {}, false);
  const double theta = 20 * M_PI / 180, knuckle = 1 + 2 * (0.25 + 0.8),
               tolerance = 0.02;  // mm: error of polygons for circles
  EXPECT_NEAR(print.clearance.elsewhere.mm, 12 * (std::cos(theta) - std::sin(theta)) - knuckle, tolerance);
  EXPECT_NEAR(print.clearance.elsewhere.theta, theta, 1e-12);
  EXPECT_NEAR(print.clearance.in_hinges.mm, 0.25, 1e-9);
}

}  // namespace
}  // namespace kinetix::testing
