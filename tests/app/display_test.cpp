#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/far_view.hpp"
#include "app/panel_picture.hpp"
#include "tests/app/program.hpp"
#include "tests/app/schema_errors.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using Json = nlohmann::json;

/// A square ring of a cell's width on a small panel: quick to search and to verify.
constexpr const char* ring = R"(kinetix: 1
name: ring
target: {kind: display, rows: ["000000", "011110", "010010", "010010", "011110", "000000"]}
)";

TEST(Display, IsSearchedVerifiedAndDrawn) {
  const Scratch scratch;
  const std::string folder = scratch / "out";
  const Outcome run = kinetix_opt(scratch.write("ring.yaml", ring) + " -o " + folder);
  EXPECT_EQ(run.code, 0) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("in the physics run: auc 1.000"));

  const Json result = Json::parse(text_of(folder + "/result.json"));
  EXPECT_EQ(schema_errors(result), "");
  EXPECT_EQ(result["target"]["rows"][1], "011110");
  EXPECT_EQ(result["metrics"]["contrast_rest"], 0);
  EXPECT_EQ(result["metrics"]["auc"], 1);
  EXPECT_GE(result["metrics"]["contrast_physics"], 3);
  EXPECT_LE(result["metrics"]["stretch_max"], 0.12);
  EXPECT_EQ(result["display"]["after"]["cells"].size(), 36u);
  for (const char* picture : {"before", "hinges", "after", "physics"}) {
    EXPECT_THAT(text_of(folder + "/" + picture + ".svg"), HasSubstr("<svg")) << picture;
    EXPECT_THAT(text_of(folder + "/" + picture + ".png"), StartsWith("\x89PNG")) << picture;
  }
  EXPECT_TRUE(std::filesystem::exists(folder + "/frames/00.png"));

  const Outcome again = kinetix_opt("verify " + folder + "/design.yaml -o " + scratch.path() + "/again");
  EXPECT_EQ(again.code, 0) << again.out << again.err;
}

TEST(Display, ThatCannotBeShownSaysWhy) {
  const Scratch scratch;
  const std::string text = std::string(ring) + "tolerance: {contrast: 1e6}\nsolver: {max_evaluations: 3}\n";
  const Outcome run = kinetix_opt(scratch.write("ring.yaml", text) + " --no-verify -o " + scratch.path());
  EXPECT_EQ(run.code, 3) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("asked is 1000000"));
}

TEST(PanelPicture, IsToScaleAndRefusesBrokenStates) {
  const Structure panel = make_structure(rectangle(3, 2), {});
  State state = rest_state(panel);
  // Half a cell of margin on both sides: 40 mm by 30 mm, in points of 1/72 inch.
  EXPECT_THAT(panel_picture(panel, state, {}), HasSubstr("113.38"));
  state[2].p.x() = NAN;
  EXPECT_THROW(panel_picture(panel, state, {}), std::runtime_error);
}

// Hinges sit elsewhere, but a flat wall is a flat wall: nothing betrays the letter before compression.
TEST(FarView, IsTheSameForEveryFlatPanel) {
  const Structure plain = make_structure(rectangle(10, 10), {}), letter = letter_panel(0.1);
  const State flat = rest_state(plain);
  EXPECT_EQ(far_view(letter, flat), far_view(plain, flat));
  EXPECT_EQ(panel_picture(letter, flat, {.format = PictureFormat::png}),
            panel_picture(plain, flat, {.format = PictureFormat::png}));
}

TEST(FarView, RefusesBrokenStates) {
  const Structure panel = make_structure(rectangle(3, 2), {});
  State state = rest_state(panel);
  state[0].R(0, 0) = NAN;
  EXPECT_THROW(far_view(panel, state), std::runtime_error);
}

}  // namespace
}  // namespace kinetix::testing
