#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "app/studio/session/autosave.hpp"
#include "tests/app/studio/studio.hpp"

namespace kinetix::testing {
namespace {

using nlohmann::json;

constexpr const char* target = R"(kinetix: 1
name: hook
target: {kind: curve, points: arc.csv}
structure: {cells: [14, 1], cell_mm: 10}
)";

std::string base64(const std::string& text) {
  std::string padded = text;
  while (padded.size() % 3 != 0) padded += '\n';
  std::string out;
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t k = 0; k < padded.size(); k += 3) {
    const unsigned bits = static_cast<unsigned char>(padded[k]) << 16 |
                          static_cast<unsigned char>(padded[k + 1]) << 8 |
                          static_cast<unsigned char>(padded[k + 2]);
    for (int shift = 18; shift >= 0; shift -= 6) out += digits[bits >> shift & 63];
  }
  return out;
}

std::string arc() {
  std::string csv = "x,z\n";
  for (int k = 0; k <= 30; ++k)
    csv += fmt::format("{:.4f},{:.4f}\n", 80 * std::sin(k * 0.05), 80 - 80 * std::cos(k * 0.05));
  return csv;
}

TEST_F(Studio, SearchesForAGoalAndTakesItsDesign) {
  client.send(json{{"type", "search"}, {"target", target}, {"files", {{"arc.csv", base64(arc())}}}}.dump());
  const json result = client.text("result");
  ASSERT_TRUE(result.is_object());
  EXPECT_TRUE(result["met"]) << result["summary"];
  EXPECT_EQ(result["result"]["name"], "hook");
  client.send(R"({"type": "save"})");
  EXPECT_EQ(client.text("saved")["path"], studio.folder.path("results/hook/design.yaml"));
  Client other(studio.port());
  ASSERT_TRUE(other.open(studio.token));
  EXPECT_EQ(other.text("design")["name"], "hook");
}

TEST(StudioAtStart, SearchesForATargetWithTheKeysThatOptionsReplace) {
  const TemporaryFolder folder;
  folder.write("arc.csv", arc());
  const std::string file = folder.write("hook.yaml", target);
  OpenStudio studio({.design = app::studio::template_design("panel"),
                     .target = targets::read_changed_document(file, app::max_design_bytes,
                                                              {{"process", "fdm"}, {"hinge", "{kind: pin}"}}),
                     .threads = 2,
                     .results = folder.path("results")});
  Client page(studio.port());
  ASSERT_TRUE(page.open(studio.token));
  const json result = page.text("result")["result"];
  EXPECT_EQ(result["name"], "hook");
  EXPECT_EQ(result["verdict"]["printable"], false);
  EXPECT_THAT(result["verdict"]["problems"].dump(), ::testing::HasSubstr("pins do not fit"));
}

TEST_F(Studio, KeepsItsResultWhereThereIsNothingToRedo) {
  client.send(json{{"type", "search"}, {"target", target}, {"files", {{"arc.csv", base64(arc())}}}}.dump());
  ASSERT_TRUE(client.text("result").is_object());
  client.ask({{"type", "redo"}});
  Client other(studio.port());
  ASSERT_TRUE(other.open(studio.token));
  EXPECT_EQ(other.text("design")["has_result"], true);
  EXPECT_EQ(other.text("result")["result"]["name"], "hook");
  client.ask({{"type", "undo"}});
  client.ask({{"type", "undo"}});
  Client last(studio.port());
  ASSERT_TRUE(last.open(studio.token));
  const json back = last.text("design");
  EXPECT_EQ(back["revision"], 3) << "its own, the found one, and back";
  EXPECT_EQ(back["has_result"], false) << "which nothing was found for";
}

/// The result is sent again and saved with the design.
TEST_F(Studio, HasItsResultAgainWhereUndoAndRedoComeBackToIt) {
  client.send(json{{"type", "search"}, {"target", target}, {"files", {{"arc.csv", base64(arc())}}}}.dump());
  ASSERT_TRUE(client.text("result").is_object());
  client.ask({{"type", "hinge"}, {"index", 0}, {"t", 0.4}});
  client.send(R"({"type": "undo"})");
  EXPECT_EQ(client.text("result")["result"]["name"], "hook");
  client.ask({{"type", "undo"}});
  client.send(R"({"type": "redo"})");
  EXPECT_EQ(client.text("result")["result"]["name"], "hook");
  Client other(studio.port());
  ASSERT_TRUE(other.open(studio.token));
  EXPECT_EQ(other.text("design")["has_result"], true);
  client.send(R"({"type": "save"})");
  client.text("saved");
  EXPECT_TRUE(std::filesystem::exists(studio.folder.path("results/hook/result.json")));
}

TEST_F(Studio, TakesFilesInPartsThatOneMessageWouldNotHold) {
  std::string csv = arc();
  csv.insert(csv.size(), 900'000, '\n');
  csv.resize(csv.size() / 3 * 3);
  constexpr std::size_t part = 480'000;
  for (std::size_t at = 0; at < csv.size(); at += part)
    client.ask(
        {{"type", "part"}, {"name", "arc.csv"}, {"at", at}, {"content", base64(csv.substr(at, part))}});
  client.send(json{{"type", "search"}, {"target", target}}.dump());
  EXPECT_TRUE(client.text("result")["met"]);
}

TEST_F(Studio, RefusesPartsOutOfTheirOrderAndTooManyOfThem) {
  client.send(json{{"type", "part"}, {"name", "a.csv"}, {"at", 6}, {"content", base64("abc")}}.dump());
  EXPECT_THAT(client.text("error")["message"].get<std::string>(), ::testing::HasSubstr("6 of the 0 bytes"));
  client.send(json{{"type", "part"}, {"name", "../a.csv"}, {"at", 0}, {"content", base64("abc")}}.dump());
  EXPECT_THAT(client.text("error")["message"].get<std::string>(), ::testing::HasSubstr("plain file name"));
  const std::string content = base64(std::string(480'000, 'x'));
  for (int k = 0; k < 69; ++k)
    client.ask({{"type", "part"}, {"name", fmt::format("{}.obj", k)}, {"at", 0}, {"content", content}});
  client.send(json{{"type", "part"}, {"name", "last.obj"}, {"at", 0}, {"content", content}}.dump());
  EXPECT_THAT(client.text("error")["message"].get<std::string>(), ::testing::HasSubstr("32 MiB in all"));
}

TEST_F(Studio, KnowsTheGoalOfADesignThatLiesBesideItsResult) {
  client.send(json{{"type", "search"}, {"target", target}, {"files", {{"arc.csv", base64(arc())}}}}.dump());
  const json found = client.text("result");
  client.send(R"({"type": "save"})");
  const std::string path = client.text("saved")["path"];
  app::Design saved = app::read_design(path);
  const auto again = app::studio::earlier_result(path, saved);
  ASSERT_FALSE(again.is_null());
  EXPECT_EQ(again["met"], true);
  EXPECT_EQ(again["summary"], found["summary"]) << "the short form of the search";
  EXPECT_THAT(again["summary"].get<std::string>(), ::testing::HasSubstr("\n  shape    "));
  EXPECT_THAT(found["details"].get<std::string>(), ::testing::HasSubstr("\n  search     "));
  EXPECT_THAT(found["summary"].get<std::string>(), ::testing::Not(::testing::HasSubstr("kinetix-opt")));
  EXPECT_EQ(app::studio::theta_reached(again), found["result"]["metrics"]["theta_rad"].get<double>());
  EXPECT_FALSE(app::studio::theta_reached(nullptr));
  EXPECT_EQ(json(again["result"]["curve"]), found["result"]["curve"]);
  Client other(studio.port());
  ASSERT_TRUE(other.open(studio.token));
  EXPECT_EQ(other.text("result")["result"]["name"], "hook") << "pages that come later know of it as well";
  saved.theta = 0.1;
  OpenStudio later{[&](app::studio::MessageSink outlet) {
    return std::make_unique<app::studio::Session>(app::studio::SessionInput{saved, path, {}, 2, 0, again},
                                                  std::move(outlet));
  }};
  Client page(later.port());
  ASSERT_TRUE(page.open(later.token));
  EXPECT_EQ(page.text("design")["has_result"], true);
  EXPECT_NEAR(page.ask({{"type", "release"}}).head(3), 0.1, 1e-12) << "as it was saved since";
}

TEST_F(Studio, SavesWhatASearchFoundAsItWasFound) {
  client.send(json{{"type", "search"}, {"target", target}, {"files", {{"arc.csv", base64(arc())}}}}.dump());
  const json found = client.text("result");
  const double theta = found["result"]["metrics"]["theta_rad"];
  client.ask({{"type", "theta"}, {"deg", 5}});
  client.send(R"({"type": "save"})");
  const std::string path = client.text("saved")["path"];
  EXPECT_NEAR(app::read_design(path).theta, theta, 1e-9);
  client.send(R"({"type": "save", "at_fold": true})");
  EXPECT_EQ(client.text("saved")["path"], path);
  EXPECT_NEAR(app::read_design(path).theta, 5 * pi / 180, 1e-9);
  const auto again = app::studio::earlier_result(path, app::read_design(path));
  ASSERT_FALSE(again.is_null()) << "its result is beside it all the same";
  EXPECT_EQ(again["result"]["metrics"]["theta_rad"], found["result"]["metrics"]["theta_rad"]);
}

TEST_F(Studio, KnowsNoGoalOfADesignThatWasChangedSince) {
  client.send(json{{"type", "search"}, {"target", target}, {"files", {{"arc.csv", base64(arc())}}}}.dump());
  client.text("result");
  client.send(R"({"type": "save"})");
  const std::string path = client.text("saved")["path"];
  EXPECT_TRUE(app::studio::earlier_result(path, file).is_null());
  EXPECT_TRUE(app::studio::earlier_result(path + "/none/design.yaml", app::read_design(path)).is_null());
  app::Design higher = app::read_design(path);
  ASSERT_FALSE(app::studio::earlier_result(path, higher).is_null());
  higher.structure.squares()->size.height_mm *= 5;
  EXPECT_TRUE(app::studio::earlier_result(path, higher).is_null()) << "its walls are other ones";
  const std::filesystem::path beside = std::filesystem::path(path).parent_path() / "result.json";
  const json known = json::parse(std::ifstream(beside));
  for (const json& odd : {json{{"name", 5}}, json{{"stopped", "yes"}}, json{{"metrics", 1}}}) {
    json other = known;
    other.update(odd);
    std::ofstream(beside) << other;
    EXPECT_TRUE(app::studio::earlier_result(path, app::read_design(path)).is_null()) << odd;
  }
  std::string deep = known.dump();
  deep.insert(deep.size() - 1, ", \"deep\": " + std::string(200'000, '[') + std::string(200'000, ']'));
  std::ofstream(beside) << deep;
  EXPECT_TRUE(app::studio::earlier_result(path, app::read_design(path)).is_null()) << "nested too deep";
}

}  // namespace
}  // namespace kinetix::testing
