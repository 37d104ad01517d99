#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <atomic>
#include <fstream>
#include <random>

#include "app/pipeline/drive_loads.hpp"
#include "app/studio/messages/templates.hpp"
#include "app/studio/session/autosave.hpp"
#include "app/studio/session/session.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "tests/app/studio/client.hpp"
#include "tests/app/studio/studio.hpp"

namespace kinetix::testing {
namespace {

using nlohmann::json;

/// Computes the largest difference in position, mm, and in rotation between a frame and a state.
double difference(const Received& frame, const model::State& state) {
  double largest = 0;
  for (std::size_t b = 0; b < state.size(); ++b) {
    const std::vector<double> v = frame.pose(static_cast<int>(b));
    const Eigen::Quaterniond q(v[3], v[4], v[5], v[6]);
    largest = std::max({largest, (Eigen::Vector3d(v[0], v[1], v[2]) - state[b].p).norm(),
                        (q.toRotationMatrix() - state[b].R).norm()});
  }
  return largest;
}

model::State state_of(const Received& frame) {
  model::State state(static_cast<std::size_t>(frame.head(9)));
  for (std::size_t b = 0; b < state.size(); ++b) {
    const std::vector<double> v = frame.pose(static_cast<int>(b));
    state[b].p = {v[0], v[1], v[2]};
    state[b].R = Eigen::Quaterniond(v[3], v[4], v[5], v[6]).toRotationMatrix();
  }
  return state;
}

/// Returns the next stable state. The stable states are known some time after a path was followed.
Received snapped(Client& client) {
  for (int tries = 0; tries < 600; ++tries) {
    const Received frame = client.ask({{"type", "snap"}});
    if (!frame.frame.empty()) return frame;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  ADD_FAILURE() << "no stable state came to be known";
  return {};
}

/// Finds the body with the nearest rest position, in cells from the lower left.
int body_at(const model::Structure& sheet, double i, double j) {
  int nearest = 0;
  const Eigen::Vector3d place = sheet.size.edge_mm * Eigen::Vector3d(i, j, 0);
  for (int b = 0; b < static_cast<int>(sheet.bodies.size()); ++b)
    if ((sheet.rest_position(b) - place).norm() < (sheet.rest_position(nearest) - place).norm()) nearest = b;
  return nearest;
}

TEST(Templates, MoveAsTheyAreSaidTo) {
  for (const app::studio::Template& one : app::studio::templates()) {
    const app::Design design = app::studio::template_design(one.name);
    const model::Structure& sheet = *design.structure.squares();
    EXPECT_EQ(design.name, one.name);
    const auto exact = exact_motion(sheet);
    ASSERT_TRUE(exact) << one.name << ": " << exact.why;
    const model::State folded = exact.at(0.4);
    EXPECT_LT(hinge_gaps(sheet, folded).max, 1e-9) << one.name;
    const model::Pose &first = folded[body_at(sheet, 0, 0)], &last = folded[body_at(sheet, 8, 0)],
                      &above = folded[body_at(sheet, 0, 2)];
    const bool stays_flat = one.name == "panel" || one.name == "shear";
    EXPECT_EQ((first.R.col(2) - last.R.col(2)).norm() < 1e-9, stays_flat) << one.name;
    if (one.name == "strip") continue;  // the strip has one row
    const Eigen::Vector3d up = first.R.transpose() * (above.p - first.p);
    const Eigen::Vector3d rest = sheet.rest_position(body_at(sheet, 0, 2));
    EXPECT_LT(up.norm(), 0.99 * rest.norm()) << one.name << " shrinks";
  }
  EXPECT_THROW(app::studio::template_design("dome"), InvalidInput);
}

TEST_F(Studio, AColumnIsTiltedInOneStepThatCanBeUndone) {
  const model::Structure& squares = *file.structure.squares();
  const int front = *squares.hinge_at({{3, 0}, model::Axis::x}),
            back = *squares.hinge_at({{3, 1}, model::Axis::x});
  const json edit = {{"type", "hinge"}, {"indices", {front, back}}, {"beta_deg", 12}, {"alternate", true}};
  client.send(edit.dump());
  const json tilted = client.text("design");
  EXPECT_TRUE(tilted["exact"]);
  const auto tilt = [&](const json& one, int hinge) {
    return one["structure"]["hinges"][hinge]["beta_rad"].get<double>();
  };
  EXPECT_DOUBLE_EQ(tilt(tilted, front), 12 * radians_per_degree);
  EXPECT_DOUBLE_EQ(tilt(tilted, back), -12 * radians_per_degree);
  client.send(R"({"type": "undo"})");
  EXPECT_EQ(client.text("design")["structure"], design["structure"]);
}

TEST_F(Studio, TakesAStrokeOverNoHinge) {
  client.send(R"({"type": "hinge", "indices": [], "beta_deg": 12, "alternate": true})");
  EXPECT_EQ(client.text("design")["structure"], design["structure"]);
}

TEST_F(Studio, FoldsAlongTheClosedForm) {
  for (const double deg : {20.0, -31.0, 0.0, 40.0}) {
    const Received frame = client.ask({{"type", "theta"}, {"deg", deg}});
    EXPECT_LT(difference(frame, exact_motion(file.structure).at(deg * radians_per_degree)), 1e-12);
    EXPECT_NEAR(frame.head(3), deg * radians_per_degree, 1e-15);
  }
}

TEST_F(Studio, FollowsAHandAlongTheClosedForm) {
  const int last = file.structure.bodies() - 1;
  const Eigen::Vector3d to = exact_motion(file.structure).at(0.2)[last].p;
  client.ask({{"type", "theta"}, {"deg", 5}});
  const Received frame = client.ask({{"type", "drag"}, {"body", last}, {"to", {to.x(), to.y(), to.z()}}});
  EXPECT_NEAR(frame.head(3), 0.2, 1e-6);
}

TEST_F(Studio, KeepsTheShapeWhenItsModelChanges) {
  const Received exact = client.ask({{"type", "theta"}, {"deg", 25}});
  const Received elastic = client.ask({{"type", "mode"}, {"mode", "equilibrium"}});
  const Received played = client.ask({{"type", "mode"}, {"mode", "bullet"}});
  const model::Linkage linkage = file.structure;
  EXPECT_EQ(elastic.head(8), 1);
  EXPECT_GT(elastic.head(6), 0);
  EXPECT_LT(aligned_distance(linkage, state_of(elastic), state_of(exact)).max, 0.01);
  EXPECT_EQ(played.head(8), 2);
  EXPECT_LT(aligned_distance(linkage, state_of(played), state_of(elastic)).max, 0.01);
}

TEST_F(Studio, MarksWhatBreaksTheMotionAndMendsIt) {
  client.ask({{"type", "theta"}, {"deg", 20}});
  client.ask({{"type", "hinge"}, {"index", 2}, {"beta_deg", 33}});
  client.send(R"({"type": "undo"})");
  json reported = client.text("design");
  EXPECT_TRUE(reported["exact"]);
  client.send(R"({"type": "redo"})");
  reported = client.text("design");
  EXPECT_FALSE(reported["exact"]);
  EXPECT_EQ(reported["breaking"].size(), 1u);
  client.send(R"({"type": "nearest"})");
  reported = client.text("design");
  EXPECT_TRUE(reported["exact"]);
  EXPECT_EQ(client.text("state")["mode"], "exact");
}

TEST_F(Studio, ShowsAnEditedColumnAsItsSavedDesignFolds) {
  client.ask({{"type", "theta"}, {"deg", 30}});
  std::vector<int> column;
  for (int h = 0; h < file.structure.hinges(); ++h) {
    const model::Hinge& hinge = file.structure.squares()->hinges[h];
    if (hinge.wall.axis == model::Axis::x && hinge.wall.from.i == 3) column.push_back(h);
  }
  ASSERT_EQ(column.size(), 2u);
  const bool first_is_lower = file.structure.squares()->hinges[column[0]].wall.from.j == 0;
  client.ask({{"type", "hinge"}, {"index", column[first_is_lower ? 0 : 1]}, {"beta_deg", -12}});
  const Received frame =
      client.ask({{"type", "hinge"}, {"index", column[first_is_lower ? 1 : 0]}, {"beta_deg", 12}});
  EXPECT_EQ(frame.head(8), 0);
  client.send(R"({"type": "save", "at_fold": true})");
  const std::string path = client.text("saved")["path"];
  const app::Design saved = app::read_design(path);
  EXPECT_LT(difference(frame, exact_motion(saved.structure).at(saved.theta)), 1e-9);
}

/// The slider changes the view of a design, not the design.
TEST_F(Studio, SavesTheDesignWhereverTheSliderStands) {
  const auto saved = [&](Client& page, const char* command) {
    page.send(command);
    const json reported = page.text("saved");
    const double theta = app::read_design(reported["path"].get<std::string>()).theta;
    EXPECT_EQ(reported["theta_rad"].get<double>(), theta);
    return theta;
  };
  client.ask({{"type", "theta"}, {"deg", 30}});
  EXPECT_EQ(saved(client, R"({"type": "save"})"), 0) << "a template is flat";
  EXPECT_NEAR(saved(client, R"({"type": "save", "at_fold": true})"), 30 * radians_per_degree, 1e-12);
  client.ask({{"type", "theta"}, {"deg", -10}});
  EXPECT_NEAR(saved(client, R"({"type": "save"})"), 30 * radians_per_degree, 1e-12) << "as it says now";
  client.ask({{"type", "undo"}});
  EXPECT_EQ(saved(client, R"({"type": "save"})"), 0) << "the fold was a step that can be undone";
  app::Design folded = file;
  folded.theta = 0.4;
  OpenStudio one{folded};
  Client page{one.port()};
  ASSERT_TRUE(page.open(one.token));
  page.ask({{"type", "theta"}, {"deg", 5}});
  page.ask({{"type", "mode"}, {"mode", "bullet"}});
  page.ask({{"type", "hinge"}, {"index", 0}, {"t", 0.4}});
  EXPECT_EQ(saved(page, R"({"type": "save"})"), 0.4) << "an edit leaves it";
  page.send(R"({"type": "save", "at_fold": "yes"})");
  EXPECT_THAT(page.text("error")["message"].get<std::string>(), ::testing::HasSubstr("true or false"));
}

TEST_F(Studio, SavesADriveThatEndsWhereItIsShown) {
  app::Design pressed = app::studio::template_design("panel");
  pressed.drive = model::Plates{.compression = 0.3};
  OpenStudio one{pressed};
  Client page{one.port()};
  ASSERT_TRUE(page.open(one.token));
  page.ask({{"type", "theta"}, {"deg", 30}});
  page.send(R"({"type": "save"})");
  EXPECT_EQ(app::read_design(page.text("saved")["path"].get<std::string>()).drive, pressed.drive);
  page.send(R"({"type": "save", "at_fold": true})");
  const app::Design saved = app::read_design(page.text("saved")["path"].get<std::string>());
  ASSERT_TRUE(saved.drive);
  EXPECT_NEAR(app::drive_of(saved).theta(), 30 * radians_per_degree, 1e-12);
}

TEST_F(Studio, SavesOverNoOtherDesign) {
  const auto saved = [&] {
    client.send(R"({"type": "save"})");
    return client.text("saved")["path"].get<std::string>();
  };
  const std::string own = saved(), before = read_file(own);
  std::vector<std::string> panels;
  for (int k = 0; k < 2; ++k) {
    client.send(R"({"type": "open", "template": "panel"})");
    panels.push_back(saved());
    EXPECT_EQ(app::read_design(panels.back()).name, "panel");
    client.send(R"({"type": "hinge", "index": 0, "t": 0.4})");
    EXPECT_EQ(saved(), panels.back()) << "an edit stays with its design";
  }
  EXPECT_EQ(panels[0], studio.folder.path("results/panel/design.yaml"));
  EXPECT_EQ(panels[1], studio.folder.path("results/panel_2/design.yaml"));
  EXPECT_EQ(read_file(own), before);
  for (int k = 0; k < 4; ++k) client.send(R"({"type": "undo"})");
  EXPECT_EQ(saved(), own);
  EXPECT_EQ(app::read_design(own).name, "strip");
}

TEST_F(Studio, GrowsAlongItsCreases) {
  client.send(R"({"type": "sheet", "columns": 6, "rows": 4})");
  const json reported = client.text("design");
  EXPECT_TRUE(reported["exact"]);
  EXPECT_EQ(reported["family"], "F2");
  EXPECT_EQ(reported["structure"]["bodies"].size(), 35u);
}

/// The twist unit of the paper has two stable states. The studio reaches one after the other.
TEST_F(Studio, SnapsFromOneStableStateToTheOther) {
  OpenStudio twist{app::read_design(std::string(KINETIX_SOURCE) + "/targets/sweeps/twist.yaml")};
  Client other{twist.port()};
  ASSERT_TRUE(other.open(twist.token));
  other.text("design");
  other.ask({{"type", "mode"}, {"mode", "equilibrium"}});
  other.send(R"({"type": "snap"})");
  EXPECT_NE(other.text("error")["message"].get<std::string>().find("no other stable state is known"),
            std::string::npos);
  other.ask({{"type", "theta"}, {"deg", -43}});
  const Received first = snapped(other), second = snapped(other), third = snapped(other);
  const double a = std::abs(first.head(3)), b = std::abs(second.head(3));
  EXPECT_LT(std::min(a, b), 0.05) << "flat";
  EXPECT_GT(std::max(a, b), 0.5) << "over the barrier";
  EXPECT_NEAR(std::abs(third.head(3)), a, 1e-9) << "and back";
}

/// Returns the first frame with an equilibrium at theta, rad, or the last frame after a while.
Received in_equilibrium(Client& client, double theta) {
  Received frame;
  for (int k = 0; k < 600; ++k) {
    Received next = client.receive();
    if (next.closed) break;
    if (next.frame.empty()) continue;
    client.acknowledge(next);
    frame = std::move(next);
    if (std::isfinite(frame.head(7)) && std::abs(frame.head(3) - theta) < 1e-6) break;
  }
  return frame;
}

TEST_F(Studio, OpensADesignWithoutClosedFormInEquilibrium) {
  app::Design twist = app::read_design(std::string(KINETIX_SOURCE) + "/targets/sweeps/twist.yaml");
  twist.theta = -30 * radians_per_degree;
  EXPECT_EQ(app::studio::Player(twist).sheet_theta(), twist.theta) << "before its equilibrium is known";
  OpenStudio one{twist};
  Client page{one.port()};
  ASSERT_TRUE(page.open(one.token));
  const Received frame = in_equilibrium(page, twist.theta);
  const model::Linkage linkage = twist.structure;
  EXPECT_TRUE(std::isfinite(frame.head(7)));
  EXPECT_NEAR(frame.head(3), twist.theta, 1e-6);
  EXPECT_GT(difference(frame, rest_state(linkage)), 1) << "it is not flat";
  page.send(R"({"type": "save"})");
  const app::Design saved = app::read_design(page.text("saved")["path"].get<std::string>());
  EXPECT_GT(std::abs(saved.theta), 0.1);
  EXPECT_NEAR(saved.theta, twist.theta, 1e-6) << "to which it goes when it is opened again";
  Client later{one.port()};
  ASSERT_TRUE(later.open(one.token));
  EXPECT_GT(later.text("path")["rows"].size(), 2u) << "the way is told to a page that comes later";
}

/// Returns the frame that reaches this fold, or the last frame after a while.
Received folded_to(Client& client, double deg) {
  Received frame;
  for (int k = 0; k < 600; ++k) {
    Received next = client.receive(std::chrono::seconds(1));
    if (next.closed) break;
    if (next.frame.empty()) continue;
    client.acknowledge(next);
    frame = std::move(next);
    if (std::abs(frame.head(3) - deg * radians_per_degree) < 0.01) break;
  }
  return frame;
}

TEST_F(Studio, ThePhysicsFoldsByTheDesignsOwnDrive) {
  const model::Structure& squares = *file.structure.squares();
  app::Design pulled = file, turned = file, hot = file;
  const auto wall = [&](int column) { return *squares.hinge_at({{column, 0}, model::Axis::y}); };
  pulled.drive = model::CordPull{{wall(0), wall(12)}, 20};
  turned.drive = model::HingeTurn{wall(6), -40 * radians_per_degree};
  hot.drive = model::ShapeMemory{.angle = 80 * radians_per_degree, .k_turn = 100};
  for (const app::Design& driven : {pulled, turned, hot}) {
    const bool is_hot = std::holds_alternative<model::ShapeMemory>(*driven.drive);
    OpenStudio one{driven};
    Client page{one.port()};
    ASSERT_TRUE(page.open(one.token));
    EXPECT_NE(page.text("design")["drive"], "");
    page.ask({{"type", "theta"}, {"deg", 5}});
    page.ask({{"type", "mode"}, {"mode", "bullet"}});
    page.send(R"({"type": "theta", "deg": 25})");
    EXPECT_EQ(page.text("state")["springs"], is_hot);
    EXPECT_NEAR(folded_to(page, 25).head(3), 25 * radians_per_degree, 0.05) << driven.drive->index();
  }
}

TEST_F(Studio, PaintsCellsAndMakesHinges) {
  client.send(R"({"type": "paint", "cell": [5, 1], "on": true})");
  EXPECT_EQ(client.text("design")["structure"]["cells"].size(), 13u);
  client.send(R"({"type": "made", "kind": "block", "material": "tango"})");
  EXPECT_EQ(client.text("design")["hinge"]["kind"], "block");
  client.send(R"({"type": "made", "kind": "pin"})");
  EXPECT_EQ(client.text("design")["hinge"]["kind"], "pin");
  client.send(R"({"type": "made", "kind": "stiff"})");
  EXPECT_EQ(client.text("design")["hinge"]["kind"], "stiff");
}

TEST_F(Studio, MadeHingesFollowTheirWalls) {
  client.send(R"({"type": "made", "kind": "block", "material": "tango"})");
  const auto saved = [&](const json& sheet) {
    client.ask(sheet);
    client.send(R"({"type": "save"})");
    return *app::read_design(client.text("saved")["path"].get<std::string>()).hinge.made;
  };
  EXPECT_EQ(saved({{"type", "sheet"}, {"height_mm", 4}}).height_mm, 4);
  EXPECT_EQ(saved({{"type", "sheet"}, {"height_mm", 12}}).height_mm, 12);
  const model::ManufacturedHinge small = saved({{"type", "sheet"}, {"cell_mm", 8}});
  EXPECT_NEAR(small.thickness_mm, 0.8, 1e-12);
  EXPECT_EQ(small.height_mm, 12) << "the walls' own, where their thickness is the usual";
  client.send(R"({"type": "sheet", "cell_mm": 1})");
  EXPECT_THAT(client.text("error")["message"].get<std::string>(), ::testing::HasSubstr("gap_mm"));
}

TEST_F(Studio, KeepsTheDriveWhileItsCellsStay) {
  app::Design pulled = file;
  const auto wall = [&](int column) {
    return *file.structure.squares()->hinge_at({{column, 0}, model::Axis::y});
  };
  pulled.drive = model::CordPull{{wall(0), wall(12)}, 20};
  OpenStudio one{pulled};
  Client page{one.port()};
  ASSERT_TRUE(page.open(one.token));
  const std::string drive = page.text("design")["drive"];
  EXPECT_NE(drive, "");
  page.send(R"({"type": "sheet", "height_mm": 7})");
  EXPECT_EQ(page.text("design")["drive"], drive);
  page.send(R"({"type": "sheet", "cell_mm": 5})");
  EXPECT_EQ(page.text("design")["drive"], drive);
  page.send(R"({"type": "save"})");
  const auto saved = app::read_design(page.text("saved")["path"].get<std::string>()).drive;
  ASSERT_TRUE(saved);
  EXPECT_DOUBLE_EQ(std::get<model::CordPull>(*saved).shorten_mm, 10);
  page.send(R"({"type": "paint", "cell": [11, 0], "on": false})");
  page.text("design");
  EXPECT_EQ(page.text("design")["drive"], "");
}

/// A mirror maps a hinge's point to the point of the mirrored hinge. It maps the axes in the same manner.
TEST_F(Studio, EditsComeTwiceWhereTheyAreToBeSymmetric) {
  OpenStudio panel{app::studio::template_design("panel")};
  Client other{panel.port()};
  ASSERT_TRUE(other.open(panel.token));
  const json before = other.text("design")["structure"];
  for (const auto& [name, mirror] :
       {std::pair("mirror_x", Eigen::Vector2d(-1, 1)), std::pair("mirror_y", Eigen::Vector2d(1, -1)),
        std::pair("rotate_2", Eigen::Vector2d(-1, -1))})
    for (const int index : {0, 37, 100}) {
      other.send(json{
          {"type", "hinge"},
          {"index", index},
          {"t", 0.3},
          {"alpha_deg", 80},
          {"beta_deg", 12},
          {"offset_mm", 0.7},
          {"symmetry",
           name}}.dump());
      const json now = other.text("design")["structure"];
      const auto point = [&](int h) {
        const json& p = now["hinges"][h]["point_mm"];
        return Eigen::Vector2d(p[0], p[1]);
      };
      const auto axis = [&](int h) {
        const json& a = now["hinges"][h]["axis"];
        return Eigen::Vector3d(a[0], a[1], a[2]);
      };
      std::vector<int> changed;
      for (std::size_t h = 0; h < now["hinges"].size(); ++h)
        if (now["hinges"][h] != before["hinges"][h]) changed.push_back(static_cast<int>(h));
      ASSERT_EQ(changed.size(), 2u) << name << " " << index;
      const Eigen::Vector2d middle(40, 40);
      const int image = changed[0] == index ? changed[1] : changed[0];
      EXPECT_LE((mirror.asDiagonal() * (point(index) - middle) - (point(image) - middle)).norm(), 1e-9)
          << name << " " << index;
      const Eigen::Vector3d mirrored = Eigen::Vector3d(mirror.x(), mirror.y(), 1).asDiagonal() * axis(index);
      EXPECT_LE(std::min((mirrored - axis(image)).norm(), (mirrored + axis(image)).norm()), 1e-9)
          << name << " " << index;
      other.send(R"({"type": "undo"})");
      ASSERT_EQ(other.text("design")["structure"], before);
    }
  other.send(R"({"type": "paint", "cells": [0, 0, 1, 0], "on": false, "symmetry": "rotate_2"})");
  EXPECT_EQ(other.text("design")["structure"]["cells"].size(), 60u);
  other.send(R"({"type": "undo"})");
  EXPECT_EQ(other.text("design")["structure"]["cells"].size(), 64u) << "one stroke, one step";
  other.send(R"({"type": "paint", "cell": [0, 0], "on": false, "symmetry": "spiral"})");
  EXPECT_NE(
      other.text("error")["message"].get<std::string>().find("must be none, mirror_x, mirror_y or rotate_2"),
      std::string::npos);
}

TEST_F(Studio, WakesUpToThePresent) {
  client.ask({{"type", "mode"}, {"mode", "bullet"}});
  client.send(R"({"type": "gravity", "on": true})");
  client.text("state");
  std::vector<Received> late;
  for (int k = 0; k < 2; ++k) late.push_back(client.receive());
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  while (!(late.back().frame.empty() && late.back().closed))
    late.push_back(client.receive(std::chrono::milliseconds(50)));
  late.pop_back();
  ASSERT_FALSE(late.empty());
  client.acknowledge(late.back());
  const Received now = client.receive();
  ASSERT_FALSE(now.closed);
  EXPECT_GT(now.head(4), late.back().head(4) + 0.5);
}

/// Without this rest, the simulation would keep a core busy while the program is open.
TEST(Session, RestsWhileNoPageIsThere) {
  const TemporaryFolder folder;
  std::atomic<int> shown = 0;
  app::studio::Session session({app::studio::template_design("strip"), folder.path("design.yaml"), {}, 1, 0},
                               {[](int, const app::studio::Text&) {},
                                [&](const std::shared_ptr<const app::studio::Frame>&) { ++shown; }});
  const std::jthread worker([&](const std::stop_token& stop) { session.run(stop); });
  const auto wait = [](int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); };
  const auto plays_from = [&](int before) {
    for (int tries = 0; shown < before + 20 && tries < 3000; ++tries) wait(10);
    return shown >= before + 20;
  };
  session.add_client(1);
  session.post(1, R"({"type": "mode", "mode": "bullet"})");
  session.post(1, R"({"type": "gravity", "on": true})");
  ASSERT_TRUE(plays_from(0));
  session.remove_client(1);
  wait(200);
  const int rested = shown;
  wait(300);
  EXPECT_EQ(shown, rested);
  session.add_client(2);
  EXPECT_TRUE(plays_from(rested)) << "it goes on for the next page";
}

TEST_F(Studio, KeepsItsHeadWhenPlayedWithAtRandom) {
  client.ask({{"type", "mode"}, {"mode", "bullet"}});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-80, 80);
  for (int k = 0; k < 40; ++k) {
    const int body = static_cast<int>(random() % file.structure.bodies());
    const Received frame =
        client.ask({{"type", "drag"}, {"body", body}, {"to", {place(random), place(random), place(random)}}});
    ASSERT_TRUE(is_finite(state_of(frame)));
    if (k % 5 == 0) client.ask({{"type", "fix"}, {"body", body}, {"fixed", k % 10 == 0}});
    if (k % 4 == 0) client.ask({{"type", "release"}});
  }
}

}  // namespace
}  // namespace kinetix::testing
