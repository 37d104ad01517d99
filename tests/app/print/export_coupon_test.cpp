#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/print/exports.hpp"
#include "tests/app/program.hpp"
#include "tests/support/stl_volume.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

TEST(Export, TakesTheClearanceOfACouponInsteadOfTheProcesss) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format stl --process sla --hinge pin --clearance 0.15").code, 0);
  const Json json = print_json_of(scratch);
  EXPECT_EQ(json["clearance_mm"], 0.15);
  EXPECT_EQ(json["process"], "sla");
  EXPECT_NEAR(json["path"]["in_hinges"]["mm"], 0.15, 0.01) << "measured on the solids";
  const std::string described =
      std::string(panel) + "hinge: {kind: pin, diameter_mm: 1, clearance_mm: 0.2}\n";
  ASSERT_EQ(exported(scratch, described, "--format stl --process sla --clearance 0.15").code, 0);
  EXPECT_EQ(print_json_of(scratch)["clearance_mm"], 0.2) << "the design's own, which this printer can";
  EXPECT_THAT(text_of(scratch / "out/print.txt"),
              HasSubstr("--clearance 0.15 leaves the design's own pins as they are"));
  expect_refused(described, "--format stl --process sla --clearance 0.3",
                 "--clearance 0.3 is not the clearance of the design's pins, 0.2 mm. Change `clearance_mm` "
                 "in the design");
  const Outcome coupon =
      kinetix_opt("export --coupon --format stl --clearance 0.2 -o " + std::string(scratch / "coupon"));
  EXPECT_EQ(coupon.code, 2);
  EXPECT_THAT(coupon.err, HasSubstr("a coupon has several gaps"));
}

TEST(Export, WritesACouponAsA3mfWhereNoFormatIsGiven) {
  const Scratch scratch;
  const Outcome coupon = kinetix_opt("export --coupon -o " + std::string(scratch / "coupon"));
  EXPECT_EQ(coupon.code, 0) << coupon.err;
  EXPECT_TRUE(fs::exists(scratch / "coupon/coupon.3mf"));
  expect_refused(panel, "", "--format is missing. Give e.g. --format 3mf");
}

TEST(Export, RefusesOptionsOfDesignsForACoupon) {
  const Scratch scratch;
  for (const char* option :
       {"--hinge block", "--cell-mm 30", "--loose-rods", "--state folded", "--caps", "--clearance 0.2"}) {
    const Outcome coupon =
        kinetix_opt(fmt::format("export --coupon {} -o {}", option, std::string(scratch / "coupon")));
    EXPECT_EQ(coupon.code, 2) << option;
    EXPECT_THAT(coupon.err, HasSubstr("only applies to designs: ")) << option;
    EXPECT_FALSE(fs::exists(scratch / "coupon"));
  }
}

/// The cut leaves the hinges whole. Each tile has a share of the coupon in proportion to its hinges.
TEST(Export, CutsACouponIntoTilesBetweenItsHinges) {
  const Scratch scratch;
  const std::string coupon = "export --coupon --process sla --format stl -o " + std::string(scratch / "out");
  const Outcome whole = kinetix_opt(coupon);
  ASSERT_EQ(whole.code, 0) << whole.err;
  EXPECT_THAT(whole.out, HasSubstr("145 x 145 mm. Give the size of your bed (`--bed`) to cut it into tiles"));
  const Outcome cut = kinetix_opt(coupon + " --bed 145,145");
  ASSERT_EQ(cut.code, 0) << cut.err;
  EXPECT_THAT(cut.out, HasSubstr("2 x 1, one bed each: no hinge is between two of them"));
  EXPECT_EQ(cut.out.find("larger than the bed"), std::string::npos);
  double parts = 0;  // mm^3
  for (const char* tile : {"out/tile_1.stl", "out/tile_2.stl"})
    parts += volume_of_stl(text_of(scratch / tile));
  EXPECT_NEAR(parts / volume_of_stl(text_of(scratch / "out/all.stl")), 1, 1e-6);
}

}  // namespace
}  // namespace kinetix::testing
