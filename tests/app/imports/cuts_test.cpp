#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"
#include "tests/support/cut_squares.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using CutJson = nlohmann::json;

class CutFolder {
 public:
  explicit CutFolder(const std::string& svg, const std::string& more = "") {
    scratch.write("sheet.svg", svg);
    scratch.write("sheet.yaml", "kinetix: 1\nstructure: {cuts: sheet.svg}\n" + more);
  }
  std::string design() const { return scratch / "sheet.yaml"; }
  std::string out(const char* name = "out") const { return scratch / name; }

  Scratch scratch;
};

TEST(Cuts, SquaresTurnAboutTheirBridges) {
  const CutFolder folder(svg_of(cut_squares(3, 20, 1.5), 60));
  const Outcome check =
      kinetix_opt("check " + folder.design() + " -v --picture " + folder.out("picture.svg"));
  ASSERT_EQ(check.code, 0) << check.err;
  EXPECT_THAT(check.out, HasSubstr("9 pieces, 12 bridges 1.3 to 1.3 mm wide after the cut"));
  EXPECT_THAT(check.out, HasSubstr("60 x 60 mm"));
  EXPECT_THAT(text_of(folder.out("picture.svg")), HasSubstr("fill-rule"));
  const Outcome run = kinetix_opt("verify " + folder.design() + " -o " + folder.out() + " --json");
  ASSERT_EQ(run.code, 0) << run.err;
  const CutJson result = CutJson::parse(run.out);
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_EQ(result["structure"]["bodies"].size(), 9U);
  // The sheet is widest at atan(9.25 / 10), since bridges are 0.75 mm from the corners. The pull also holds orientations,
  // so squares stop a little before.
  EXPECT_LT(result["metrics"]["theta_rad"].get<double>(), std::atan2(9.25, 10));
  EXPECT_GT(result["metrics"]["theta_rad"].get<double>(), std::atan2(9.25, 10) - 0.06);
  EXPECT_LT(result["metrics"]["verify_rms"], 0.02);
  // The design in the results is a drawing of cuts, too, and gives the same result.
  EXPECT_THAT(text_of(folder.out() + "/design.yaml"), HasSubstr("cuts: sheet_cuts.dxf"));
  const Outcome again =
      kinetix_opt("simulate " + folder.out() + "/design.yaml --json -o " + folder.out("again"));
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_NEAR(CutJson::parse(again.out)["metrics"]["theta_rad"].get<double>(),
              result["metrics"]["theta_rad"].get<double>(), 1e-6);
}

TEST(Cuts, AreExportedAsSheetAndForLasers) {
  const CutFolder folder(svg_of(cut_squares(2, 20, 1.5), 40), "process: {base: laser, sheet_mm: 2}\n");
  const Outcome run = kinetix_opt("export " + folder.design() + " --format dxf,svg,stl -o " + folder.out());
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(text_of(folder.out() + "/sheet.dxf"), HasSubstr("CUT"));
  const CutJson print = CutJson::parse(text_of(folder.out() + "/print.json"));
  EXPECT_EQ(print["cut"]["pieces"], 1);
  EXPECT_NEAR(print["cut"]["length_mm"].get<double>(), 4 * 40 + 4 * (20 - 1.5), 1e-3);
  EXPECT_NEAR(print["cut"]["bridges"]["width_mm"][0].get<double>(), 1.3, 1e-6);
  EXPECT_NEAR(print["bounds_mm"][2].get<double>(), 2, 1e-6);
  EXPECT_EQ(kinetix_opt("export " + folder.design() + " --format step -o " + folder.out("step")).code, 2);
}

TEST(Cuts, OfALivingHingeDoNotMoveInTheirPlane) {
  const std::string slits =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"24mm\" height=\"40mm\" viewBox=\"0 0 24 40\">"
      "<g fill=\"none\" stroke=\"black\"><rect width=\"24\" height=\"40\"/>"
      "<path d=\"M0 15H5M7 15H17M19 15H24M0 18H11M13 18H24M0 21H5M7 21H17M19 21H24\"/></g></svg>";
  const CutFolder folder(slits, "drive: {expand: 3}\n");
  const Outcome run = kinetix_opt("simulate " + folder.design() + " -o " + folder.out());
  EXPECT_EQ(run.code, 0 + 3) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("no body moves"));
}

TEST(Cuts, AreRefusedByOneLine) {
  const auto refusal_of = [](const std::string& svg, const std::string& more = "") {
    const CutFolder folder(svg, more);
    const Outcome run = kinetix_opt("check " + folder.design());
    EXPECT_EQ(run.code, 2) << run.out;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    return run.err;
  };
  const std::string squares = svg_of(cut_squares(2, 20, 1.5), 40);
  EXPECT_THAT(refusal_of(svg_of(cut_squares(2, 20, 0), 40)), HasSubstr("loose pieces"));
  EXPECT_THAT(refusal_of(svg_of(cut_squares(2, 20, 0.15), 40)), HasSubstr("process.kerf_mm"));
  EXPECT_THAT(refusal_of(squares, "process: fdm\n"), HasSubstr("base: laser"));
  EXPECT_THAT(refusal_of(squares, "process: {base: laser, kerf_mm: 0}\n"), HasSubstr("kerf_mm"));
}

}  // namespace
}  // namespace kinetix::testing
