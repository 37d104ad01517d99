#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <filesystem>
#include <fstream>

#include "app/pipeline/drive_loads.hpp"
#include "tests/app/studio/studio.hpp"

namespace kinetix::testing {
namespace {

using nlohmann::json;

TEST_F(Studio, ExportsFilesForThePrinter) {
  client.send(R"({"type": "export", "formats": ["stl"], "process": "polyjet", "clearance_mm": 0.12})");
  const json out = client.text("exported");
  EXPECT_THAT(out["files"].get<std::vector<std::string>>(), ::testing::Contains("all.stl"));
  EXPECT_TRUE(std::filesystem::exists(out["folder"].get<std::string>() + "/all.stl"));
  EXPECT_THAT(out["summary"].get<std::string>(), ::testing::HasSubstr("clearance 0.12 mm per side"));
}

/// Returns a panel between plates with a compression of 0.3: theta is 45.6 degrees.
app::Design pressed_panel() {
  app::Design design = app::studio::template_design("panel");
  design.drive = model::Plates{.compression = 0.3};
  return design;
}

TEST(StudioExport, TakesTheDesignUnlessItIsAskedForAsItIsShown) {
  OpenStudio studio(pressed_panel());
  Client client(studio.port());
  ASSERT_TRUE(client.open(studio.token));
  client.ask({{"type", "theta"}, {"deg", 10}});
  const auto theta_deg = [&](json command) {
    command.update(
        {{"type", "export"}, {"formats", {"glb"}}, {"process", "polyjet"}, {"clearance_mm", 0.12}});
    client.send(command.dump());
    const json out = client.text("exported");
    EXPECT_EQ(out["at_fold"], command.contains("at_fold"));
    const std::string file = out["folder"].get<std::string>() + "/print.json";
    return json::parse(std::ifstream(file))["path"]["theta_deg"].get<double>();
  };
  EXPECT_NEAR(theta_deg(json::object()), std::acos(0.7) * 180 / pi, 1e-9);
  EXPECT_NEAR(theta_deg({{"at_fold", true}}), 10, 1e-9);
}

TEST(StudioExport, TakesTheDriveOfADesignWithoutClosedFormAsFarAsTheSlider) {
  app::Design design = pressed_panel();
  design.structure.hinge(30).t += 0.05;
  const app::studio::Moving moving(design);
  ASSERT_FALSE(bool(moving.exact));
  const app::Design shown = app::studio::design_at_shown_fold(design, moving, -0.2, -0.2);
  ASSERT_TRUE(shown.drive);
  EXPECT_NEAR(app::drive_of(shown).theta(), -0.2, 1e-12);
  EXPECT_EQ(shown.theta, -0.2);
  EXPECT_EQ(app::studio::design_at_shown_fold(design, moving, 0, 0).drive, design.drive)
      << "flat: as far as the design says";
}

}  // namespace
}  // namespace kinetix::testing
