#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/print/format/zip_text.hpp"
#include "tests/app/print/exports.hpp"
#include "tests/app/print/slices.hpp"
#include "tests/app/print/threemf_judge.hpp"
#include "tests/app/program.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

constexpr const char* model_file = "3D/3dmodel.model";
constexpr const char* prusa_file = "Metadata/Slic3r_PE_model.config";
constexpr const char* orca_file = "Metadata/model_settings.config";

/// Place and form of a slicer's settings in a 3MF file.
struct SettingsPlace {
  const char *slicer, *file, *form;
};
constexpr SettingsPlace places[] = {
    {"prusa", prusa_file, R"(<metadata type="object" key="{}" value="{}"/>)"},
    {"orca", orca_file, R"(<metadata key="{}" value="{}"/>)"},
    {"bambu", orca_file, R"(<metadata key="{}" value="{}"/>)"},
    {"cura", model_file, R"(<metadata name="cura:{}" type="xs:string" preserve="1">{}</metadata>)"}};

/// Expects the settings of print.json in the 3MF file.
void expect_settings_in_file(const Scratch& scratch) {
  const Json settings = print_json_of(scratch)["slicer_settings"];
  for (const auto& [slicer, file, form] : places) {
    if (!settings.contains(slicer)) continue;
    const std::string text = app::text_in_zip(scratch / "out/panel.3mf", file);
    for (const auto& [key, value] : settings[slicer].items())
      EXPECT_THAT(text, HasSubstr(fmt::format(fmt::runtime(form), key, std::string(value)))) << slicer;
  }
}

TEST(SlicerSettings, OfAllSlicersAreInOneFileForFdm) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format 3mf --hinge pin --process fdm --cell-mm 24").code, 0);
  const Json settings = print_json_of(scratch)["slicer_settings"];
  EXPECT_EQ(settings.size(), 4);
  expect_settings_in_file(scratch);
  EXPECT_EQ(settings["prusa"]["perimeter_generator"], "arachne");
  EXPECT_EQ(settings["orca"]["wall_generator"], "arachne");
  EXPECT_EQ(settings["bambu"]["brim_type"], "no_brim");
  EXPECT_EQ(settings["cura"]["xy_offset_layer_0"], "-0.15");
  EXPECT_THAT(app::text_in_zip(scratch / "out/panel.3mf", model_file), Not(HasSubstr("PrusaSlicer")))
      << "Orca and Bambu take a file with this name for one of PrusaSlicer";
  EXPECT_THAT(text_of(scratch / "out/print.txt"),
              HasSubstr("made for     PrusaSlicer, OrcaSlicer, Bambu Studio and Cura: "));
}

TEST(SlicerSettings, OfOneSlicerAreThereAlone) {
  for (const auto& place : places) {
    const Scratch scratch;
    ASSERT_EQ(
        exported(scratch, panel,
                 std::string("--format 3mf --hinge pin --process fdm --cell-mm 24 --slicer ") + place.slicer)
            .code,
        0);
    const Json settings = print_json_of(scratch)["slicer_settings"];
    EXPECT_EQ(settings.size(), 1);
    EXPECT_TRUE(settings.contains(place.slicer));
    expect_settings_in_file(scratch);
    EXPECT_EQ(app::text_in_zip(scratch / "out/panel.3mf", prusa_file).empty(),
              place.slicer != std::string("prusa"));
    EXPECT_EQ(app::text_in_zip(scratch / "out/panel.3mf", orca_file).empty(),
              place.file != std::string(orca_file));
    EXPECT_EQ(app::text_in_zip(scratch / "out/panel.3mf", model_file).find("cura:") == std::string::npos,
              place.slicer != std::string("cura"));
  }
}

/// In SLA the elephant foot compensation is a setting of the printer. A key of the object has no effect.
TEST(SlicerSettings, OfSlaLeaveTheElephantFootToThePrinter) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format 3mf --hinge pin --process sla").code, 0);
  EXPECT_EQ(print_json_of(scratch)["slicer_settings"],
            Json::parse(R"({"prusa": {"slice_closing_radius": "0.049"}})"));
  EXPECT_THAT(text_of(scratch / "out/print.txt"),
              HasSubstr("Set elephant foot compensation 0.2 mm in the printer's settings"));
}

/// PrusaSlicer wants ranges of triangles in one object. The others want an object for each material.
TEST(SlicerSettings, SeparateTwoMaterialsAsTheSlicerReadsThem) {
  for (const auto& place : places) {
    const Scratch scratch;
    ASSERT_EQ(exported(scratch, panel,
                       std::string("--format 3mf --hinge block --process fdm --slicer ") + place.slicer)
                  .code,
              0);
    const ThreemfVerdict verdict = read_threemf(scratch / "out/panel.3mf");
    EXPECT_TRUE(verdict.is_read);
    EXPECT_TRUE(verdict.manifold);
    const bool is_prusa = place.slicer == std::string("prusa"), is_cura = place.slicer == std::string("cura");
    EXPECT_EQ(verdict.objects, is_prusa ? 1 : 2);
    const std::string text = app::text_in_zip(scratch / "out/panel.3mf", place.file);
    if (is_prusa) {
      EXPECT_THAT(text, HasSubstr("<volume "));
    } else if (is_cura) {
      EXPECT_THAT(text, HasSubstr(R"(name="cura:extruder_nr" type="xs:string" preserve="1">1<)"));
    } else {
      EXPECT_THAT(text, HasSubstr(R"(<object id="4">)")) << "joins the two";
      EXPECT_THAT(text, HasSubstr("<part id=\"3\" subtype=\"normal_part\">\n   <metadata key=\"name\" "
                                  "value=\"soft\"/>\n   <metadata key=\"extruder\" value=\"2\"/>"));
    }
    EXPECT_THAT(print_json_of(scratch)["warnings"].dump(), Not(HasSubstr("separates hard and soft")));
  }
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format 3mf --hinge block --process fdm").code, 0);
  EXPECT_THAT(print_json_of(scratch)["warnings"].dump(),
              HasSubstr("separates hard and soft parts for PrusaSlicer only: for another slicer export"));
}

/// No setting of a slicer narrows thin outlines on the bed.
TEST(SlicerSettings, LeaveTheFirstLayerOfThinWallsToTheUser) {
  for (const auto& [options, has_advice] : {std::pair{"--hinge pin --process fdm --cell-mm 24", true},
                                            {"--hinge pin --process sla", false},
                                            {"--hinge block --process fdm", false}}) {
    const Scratch scratch;
    ASSERT_EQ(exported(scratch, panel, std::string("--format 3mf ") + options).code, 0);
    const std::string advice =
        "first layer  layers of 0.2 mm or less, the first too: gaps between knuckles are at least two of "
        "them "
        "high. Separate parts that fuse on the bed with a knife, as slicers do not narrow outlines below 0.8 "
        "mm there";
    EXPECT_EQ(text_of(scratch / "out/print.txt").find(advice) != std::string::npos, has_advice) << options;
  }
}

TEST(SlicerSettings, OfAnUnknownSlicerAreRefusedWithTheAllowedNames) {
  expect_refused(panel, "--format 3mf --slicer slic3r",
                 "--slicer: unknown slicer `slic3r`; allowed: prusa, orca, bambu, cura");
}

TEST(SlicerSettings, ThatNobodyReadsAreNoted) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format stl --process fdm --hinge block --slicer cura").code, 0);
  EXPECT_THAT(print_json_of(scratch)["warnings"].dump(), HasSubstr("--slicer changes nothing in stl"));
  ASSERT_EQ(exported(scratch, panel, "--format 3mf --process polyjet --slicer orca").code, 0);
  EXPECT_THAT(print_json_of(scratch)["warnings"].dump(), HasSubstr("OrcaSlicer does not slice for polyjet"));
}

TEST(SlicerSettings, OfACouponAreForASlicerThatItNames) {
  for (const auto& [slicer, names] : {std::pair{"", "PrusaSlicer, OrcaSlicer, Bambu Studio and Cura"},
                                      {"--slicer bambu", "Bambu Studio"}}) {
    const Scratch scratch;
    const Outcome coupon = kinetix_opt(
        fmt::format("export --coupon --process fdm {} -o {}", slicer, std::string(scratch / "out")));
    ASSERT_EQ(coupon.code, 0) << coupon.err;
    EXPECT_THAT(coupon.out, HasSubstr(fmt::format("this coupon is for {}: another", names)));
  }
}

/// PrusaSlicer takes walls and brim from the file. An STL file leaves them to its profile: Classic walls omit films of
/// less than a line, and a brim joins parts.
TEST(SlicerSettings, BeatTheProfileOfPrusaSlicer) {
  const Scratch scratch;
  ASSERT_EQ(exported(scratch, panel, "--format stl,3mf --hinge film --process fdm").code, 0);
  const std::string file = scratch / "out/panel.3mf", bare = scratch / "out/all.stl";
  const auto used = [&](const std::string& of, const char* profile) {
    return filament_mm3(scratch.path(), of, profile);
  };
  const char *const arachne = "perimeter_generator = arachne\n",
                    *const classic = "perimeter_generator = classic\nthin_walls = 0\nbrim_width = 5\n";
  const double printed = used(file, arachne);
  EXPECT_NEAR(used(file, classic) / printed, 1, 1e-3) << "threads of PrusaSlicer change the last digit";
  EXPECT_GT(std::abs(used(bare, classic) / used(bare, arachne) - 1), 0.05);
  const Json volume = print_json_of(scratch)["volume_mm3"];
  EXPECT_NEAR(printed / (double(volume["hard"]) + double(volume["soft"])), 1, 0.1);
}

}  // namespace
}  // namespace kinetix::testing
