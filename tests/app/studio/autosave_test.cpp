#include "app/studio/session/autosave.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "app/studio/messages/templates.hpp"
#include "tests/app/studio/studio.hpp"

namespace kinetix::testing {
namespace {

namespace fs = std::filesystem;
using app::studio::Autosave;
using app::studio::SessionInput;
using nlohmann::json;

/// A design on the disk that is opened repeatedly. The studio is killed each time, so it cannot clean up.
class KilledStudio : public ::testing::Test {
 protected:
  std::shared_ptr<Autosave> place(const std::string& source = "design.yaml") const {
    return std::make_shared<Autosave>(folder.path("state"), folder.path(source));
  }
  SessionInput opened() const {
    SessionInput out{app::studio::template_design("strip"), folder.path("design.yaml")};
    out.results = folder.path("results");
    out.autosave = place();
    return out;
  }
  bool is_kept() const {
    for (const auto& entry : fs::recursive_directory_iterator(folder.path("state")))
      if (entry.path().filename() == "design.yaml") return true;
    return false;
  }

  TemporaryFolder folder;
};

json hinge(double t) { return {{"type", "hinge"}, {"index", 0}, {"t", t}}; }

double t_of(const json& design) { return design["structure"]["hinges"][0]["t"].get<double>(); }

TEST_F(KilledStudio, OpensWithWhatWasNotSaved) {
  {
    OpenStudio studio(opened());
    Client page(studio.port());
    ASSERT_TRUE(page.open(studio.token));
    const json first = page.text("design");
    EXPECT_EQ(first["unsaved"], false);
    EXPECT_EQ(first["restored"], false);
    page.ask(hinge(0.3));
    page.ask(hinge(0.4));
    EXPECT_TRUE(is_kept());
  }
  OpenStudio studio(opened());
  Client page(studio.port());
  ASSERT_TRUE(page.open(studio.token));
  const json again = page.text("design");
  EXPECT_EQ(t_of(again), 0.4);
  EXPECT_EQ(again["restored"], true);
  EXPECT_EQ(again["unsaved"], true);
  EXPECT_EQ(again["kept"], true);
  page.send(R"({"type": "undo"})");
  const json saved = page.text("design");
  EXPECT_EQ(t_of(saved), 0.5) << "the file's own is a step back";
  EXPECT_EQ(saved["restored"], false);
  EXPECT_FALSE(is_kept()) << "which is saved";
  page.send(R"({"type": "redo"})");
  EXPECT_EQ(t_of(page.text("design")), 0.4);
  page.send(R"({"type": "save"})");
  EXPECT_EQ(page.text("saved")["path"], folder.path("design.yaml"));
  EXPECT_FALSE(is_kept());
}

TEST_F(KilledStudio, KnowsThatATemplateIsOfNoFile) {
  {
    OpenStudio studio(opened());
    Client page(studio.port());
    ASSERT_TRUE(page.open(studio.token));
    page.ask({{"type", "open"}, {"template", "panel"}});
  }
  OpenStudio studio(opened());
  Client page(studio.port());
  ASSERT_TRUE(page.open(studio.token));
  EXPECT_EQ(page.text("design")["name"], "panel");
  page.send(R"({"type": "save"})");
  EXPECT_EQ(page.text("saved")["path"], folder.path("results/panel/design.yaml"));
  EXPECT_FALSE(fs::exists(folder.path("design.yaml"))) << "the strip's file is left alone";
}

TEST_F(KilledStudio, HasTheResultOfItsSearch) {
  const std::string target =
      "kinetix: 1\nname: arc\ntarget: {kind: curve, points: [[0, 0], [30, 5], [60, 18], [90, 40]]}\n"
      "structure: {cells: [10, 1], cell_mm: 10}\n";
  json found;
  {
    OpenStudio studio(opened());
    Client page(studio.port());
    ASSERT_TRUE(page.open(studio.token));
    page.send(json{{"type", "search"}, {"target", target}}.dump());
    found = page.text("result");
    ASSERT_TRUE(found.is_object());
  }
  OpenStudio studio(opened());
  Client page(studio.port());
  ASSERT_TRUE(page.open(studio.token));
  const json design = page.text("design");
  EXPECT_EQ(design["name"], "arc");
  EXPECT_EQ(design["has_result"], true);
  const json result = page.text("result");
  EXPECT_EQ(result["earlier"], true);
  EXPECT_EQ(result["met"], found["met"]);
  EXPECT_EQ(result["revision"], design["revision"]);
  page.send(R"({"type": "save"})");
  EXPECT_EQ(page.text("saved")["path"], folder.path("results/arc/design.yaml"));
  EXPECT_TRUE(fs::exists(folder.path("results/arc/result.json"))) << "it lay nowhere else";
}

TEST_F(KilledStudio, OpensTheFileWhereNothingReadableWasKept) {
  fs::path kept;
  {
    const auto own = place();
    own->keep(app::studio::template_design("panel"), "", nullptr);
    kept = own->folder() / "design.yaml";
    ASSERT_TRUE(own->kept());
  }
  for (const char* content : {"", "nonsense", "# Kept by the studio until it is saved: {", "kinetix: 1\n"}) {
    std::ofstream(kept) << content;
    OpenStudio studio(opened());
    Client page(studio.port());
    ASSERT_TRUE(page.open(studio.token));
    EXPECT_EQ(page.text("design")["name"], "strip") << content;
  }
}

TEST_F(KilledStudio, KeepsEachStudiosDesignApart) {
  const auto first = place(), second = place(), other = place("other.yaml");
  EXPECT_NE(first->folder(), second->folder());
  EXPECT_NE(first->folder(), other->folder());
  first->keep(app::studio::template_design("panel"), "/a \"b\"\n.yaml", nullptr);
  second->keep(app::studio::template_design("shear"), "", nullptr);
  EXPECT_EQ(first->kept()->design.name, "panel");
  EXPECT_EQ(first->kept()->save_file, "/a \"b\"\n.yaml");
  EXPECT_EQ(second->kept()->design.name, "shear");
  EXPECT_FALSE(other->kept());
}

TEST_F(KilledStudio, PutsAsideWhatAStudioThatEndsHasNotSaved) {
  std::string file;
  {
    const auto own = place();
    EXPECT_EQ(own->put_aside(), "");
  }
  {
    const auto own = place();
    own->keep(app::studio::template_design("panel"), "", nullptr);
    file = own->put_aside();
    own->keep(app::studio::template_design("shear"), "", nullptr);
    EXPECT_FALSE(own->kept()) << "nothing comes after the end";
  }
  EXPECT_FALSE(place()->kept()) << "the next one begins anew";
  EXPECT_EQ(app::read_design(file).name, "panel");
}

TEST_F(KilledStudio, SaysWhereNothingCanBeKept) {
  SessionInput strip = opened();
  const fs::path kept = strip.autosave->folder();
  OpenStudio studio(std::move(strip));
  folder.write(fs::relative(kept, folder.path("")).string(), "a file in the place of the folder");
  Client page(studio.port());
  ASSERT_TRUE(page.open(studio.token));
  page.text("design");
  page.send(hinge(0.3).dump());
  json reported = page.text("design");
  EXPECT_EQ(t_of(reported), 0.3) << "the edit is made all the same";
  EXPECT_EQ(reported["kept"], false);
  EXPECT_THAT(reported["not_kept"].get<std::string>(), ::testing::HasSubstr(kept.string()));
  fs::remove(kept);
  page.send(hinge(0.35).dump());
  reported = page.text("design");
  EXPECT_EQ(reported["kept"], true);
  EXPECT_FALSE(reported.contains("not_kept"));
}

}  // namespace
}  // namespace kinetix::testing
