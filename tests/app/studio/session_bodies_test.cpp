#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/files/bodies_section.hpp"
#include "app/io/atomic_file.hpp"
#include "app/io/bytes.hpp"
#include "app/pipeline/pipeline.hpp"
#include "app/studio/view_command.hpp"
#include "model/base/geometry.hpp"
#include "model/closure/closure.hpp"
#include "tests/app/studio/client.hpp"
#include "tests/app/studio/studio.hpp"
#include "tests/support/strip_solids.hpp"

namespace kinetix::testing {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using nlohmann::json;
using ::testing::HasSubstr;

constexpr double wall = 20, gap = 1;  // mm: from hinge to hinge, and between two walls

/// Returns a wall or a block at a place in the plane, turned there about z.
model::ModelPart part(const std::string& name, bool soft, double length, double x, double y, double deg) {
  const Isometry3d place = Eigen::Translation3d(x, y, 0) *
                           Isometry3d(Eigen::AngleAxisd(deg * radians_per_degree, Vector3d::UnitZ()));
  return {name, soft, moved(box_solid(-length / 2, length / 2, 0.8, 6), place)};
}

/// Returns two walls in line along x and the block between them. Its axis is parallel to z.
app::Design pair_of_walls() {
  return {.name = "pair",
          .structure = model::Lattice(model::make_assembly({part("left", false, wall - gap, -wall / 2, 0, 0),
                                                            part("right", false, wall - gap, wall / 2, 0, 0),
                                                            part("joint", true, gap, 0, 0, 0)}))};
}

/// Returns four crosses at the corners of a square, with walls between them: a parallelogram. Its blocks are in the
/// middle of the walls.
app::Design parallelogram() {
  std::vector<model::ModelPart> parts;
  const double corner[4][2] = {{0, 0}, {wall, 0}, {wall, wall}, {0, wall}};
  for (int k = 0; k < 4; ++k) {
    const double *a = corner[k], *b = corner[(k + 1) % 4];
    const double half = wall / 2 - gap / 2, deg = 90.0 * (k + 1);
    const Isometry3d place =
        Eigen::Translation3d(a[0], a[1], 0) *
        Isometry3d(Eigen::AngleAxisd((deg - 90) * radians_per_degree, Vector3d::UnitZ()));
    // An angle of two arms is one closed shell with an L-shaped section in the plane.
    model::Polyhedron angle;
    const std::vector<Eigen::Vector2d> outline = {{-0.4, -0.4}, {half, -0.4}, {half, 0.4},
                                                  {0.4, 0.4},   {0.4, half},  {-0.4, half}};
    const int n = static_cast<int>(outline.size());
    for (const double z : {-3.0, 3.0})
      for (const auto& p : outline) angle.points.emplace_back(p.x(), p.y(), z);
    for (int i = 0; i < n; ++i) angle.add_face({i, (i + 1) % n, n + (i + 1) % n, n + i});
    angle.add_face({3, 2, 1, 0});
    angle.add_face({5, 4, 3, 0});
    angle.add_face({n + 0, n + 1, n + 2, n + 3});
    angle.add_face({n + 0, n + 3, n + 4, n + 5});
    parts.push_back({"corner_" + std::to_string(k), false, moved(angle, place)});
    parts.push_back(part("joint_" + std::to_string(k), true, gap, (a[0] + b[0]) / 2, (a[1] + b[1]) / 2,
                         k % 2 == 0 ? 0 : 90));
  }
  return {.name = "parallelogram", .structure = model::Lattice(model::make_assembly(parts))};
}

Eigen::Isometry3d pose_of(const Received& frame, int body) {
  const std::vector<double> v = frame.pose(body);
  return Eigen::Translation3d(v[0], v[1], v[2]) * Eigen::Quaterniond(v[3], v[4], v[5], v[6]);
}

/// Computes the position in a frame of a body's point that is given at rest.
Vector3d carried(const Received& frame, const model::Assembly& assembly, int body, const Vector3d& at) {
  return pose_of(frame, body) * (at - assembly.bodies[body].position);
}

/// Waits until the path of a hinge is known, and returns the design.
/// @param hinge to be turned; nothing: any hinge
json followed(Client& client, std::optional<int> hinge = {}) {
  json design = client.text("design");
  const auto waits = [&] {
    const json& bodies = design["bodies"];
    return bodies["following"].get<bool>() || (hinge && bodies["driven"] != *hinge);
  };
  while (waits()) design = client.text("design");
  return design;
}

/// Returns the first design with another revision than `before`.
json changed(Client& client, const json& before) {
  json design = client.text("design");
  while (design["revision"] == before["revision"]) design = client.text("design");
  return design;
}

class StudioOfBodies : public ::testing::Test {
 protected:
  explicit StudioOfBodies(app::Design opened = pair_of_walls()) : file(std::move(opened)) {}
  void SetUp() override {
    ASSERT_TRUE(client.open(studio.token));
    meshes = client.text("meshes");
    design = followed(client);
  }
  std::string refusal(const json& command) {
    client.send(command.dump());
    return client.text("error")["message"];
  }
  /// Sends a command and checks that one of the next five states has this value.
  void expect_state(const json& command, const char* key, const json& value) {
    client.send(command.dump());
    json state;
    for (int reported = 0; reported < 5 && state[key] != value; ++reported) state = client.text("state");
    EXPECT_EQ(state[key], value) << command;
  }

  const model::Assembly& assembly() const { return *file.structure.assembly(); }

  app::Design file;
  OpenStudio studio{file};
  Client client{studio.port()};
  json meshes, design;
};

class StudioOfALoop : public StudioOfBodies {
 protected:
  StudioOfALoop() : StudioOfBodies(parallelogram()) {}
};

TEST_F(StudioOfBodies, TellsMeshesNamesAndHowFarAFreeHingeTurns) {
  for (int b = 0; b < 2; ++b) {
    const model::Polyhedron& solid = assembly().bodies[b].solid;
    const std::string bytes = app::from_base64(meshes["bodies"][b]["points"].get<std::string>());
    ASSERT_EQ(bytes.size(), 12 * solid.points.size());
    const auto* v = reinterpret_cast<const float*>(bytes.data());
    for (std::size_t p = 0; p < solid.points.size(); ++p)
      EXPECT_LT((Vector3d(v[3 * p], v[3 * p + 1], v[3 * p + 2]) - solid.points[p]).norm(), 1e-5);
    EXPECT_EQ(app::from_base64(meshes["bodies"][b]["triangles"].get<std::string>()).size(),
              12 * solid.triangles.size());
  }
  EXPECT_FALSE(meshes["hinges"][0].is_null());
  EXPECT_EQ(design["structure"]["bodies"][1]["name"], "right");
  EXPECT_EQ(design["structure"]["hinges"][0]["kind"], "block");
  EXPECT_GT(design["structure"]["hinges"][0]["k"]["turn"], 0);
  EXPECT_TRUE(design["exact"]);
  EXPECT_TRUE(design["bodies"]["opens"][0].is_null());
  EXPECT_NEAR(design["bodies"]["turn_range_rad"][0].get<double>(), -178 * radians_per_degree, 1e-12);
  EXPECT_NEAR(design["bodies"]["turn_range_rad"][1].get<double>(), 178 * radians_per_degree, 1e-12);
}

TEST_F(StudioOfBodies, NamesTheTurnAtWhichTwoWallsMeet) {
  while (design["bodies"]["meets"].is_null()) design = client.text("design");
  // Corners of the two ends are 0.5 mm before and behind the axis and 0.4 mm beside it. They meet once they subtend no
  // angle.
  const double meet = 2 * std::atan2(gap / 2, 0.4), step = 2 * radians_per_degree;
  const double late =
      0.1 / std::hypot(gap / 2, 0.4);  // rad: contact is detected once walls overlap by 0.1 mm
  for (int side = 0; side < 2; ++side) {
    const json& met = design["bodies"]["meets"][side];
    const double turn = met["turn_rad"], sign = side == 0 ? -1 : 1;
    EXPECT_GT(sign * turn, meet - 1e-9);
    EXPECT_LT(sign * turn, meet + late + step);
    EXPECT_EQ(met["bodies"], json({0, 1}));
  }
  EXPECT_THAT(design["why"].dump(), HasSubstr("left and right run into each other"));
}

TEST_F(StudioOfBodies, TurnsTheSecondBodyAboutTheAxis) {
  const model::AssemblyHinge& hinge = assembly().hinges[0];
  const double per_theta = design["bodies"]["turn_per_theta"];
  for (const double deg : {12.3, -60.0, 0.0, 88.0}) {
    const Received frame = client.ask({{"type", "theta"}, {"deg", deg}});
    const Eigen::AngleAxisd turn(per_theta * deg * radians_per_degree, hinge.axis);
    EXPECT_NEAR(frame.head(3), deg * radians_per_degree, 1e-12);
    const auto lower = pose_of(frame, hinge.lower), upper = pose_of(frame, hinge.upper);
    EXPECT_LT((lower.linear().transpose() * upper.linear() - turn.toRotationMatrix()).norm(), 1e-9);
    EXPECT_LT((carried(frame, assembly(), hinge.lower, hinge.point) -
               carried(frame, assembly(), hinge.upper, hinge.point))
                  .norm(),
              1e-8);
  }
}

TEST_F(StudioOfBodies, FollowsAHandAlongItsOneWay) {
  const model::AssemblyHinge& hinge = assembly().hinges[0];
  const Received there = client.ask({{"type", "theta"}, {"deg", 10}});
  const Vector3d to = pose_of(there, hinge.upper).translation();
  client.ask({{"type", "theta"}, {"deg", 3}});
  const Received frame =
      client.ask({{"type", "drag"}, {"body", hinge.upper}, {"to", {to.x(), to.y(), to.z()}}});
  EXPECT_NEAR(frame.head(3), 10 * radians_per_degree, 1e-5);
}

TEST_F(StudioOfBodies, RefusesWhatIsOfSheets) {
  EXPECT_THAT(refusal({{"type", "hinge"}, {"index", 0}, {"t", 0.4}}), HasSubstr("t: only applies to sheets"));
  EXPECT_THAT(refusal({{"type", "hinge"}, {"index", 0}, {"turn", -1}}), HasSubstr("turn: must be"));
  EXPECT_THAT(refusal({{"type", "made"}, {"kind", "pin"}}), HasSubstr("made: only applies to sheets"));
  EXPECT_THAT(refusal({{"type", "sheet"}, {"rows", 2}}), HasSubstr("sheet of squares only"));
  EXPECT_THAT(refusal({{"type", "springs"}, {"on", true}}), HasSubstr("turn freely"));
  EXPECT_THAT(refusal({{"type", "snap"}}), HasSubstr("mode equilibrium"));
  EXPECT_THAT(refusal({{"type", "dance"}}), HasSubstr("unknown command"));
  EXPECT_THAT(refusal({{"type", "driven"}, {"hinge", 1}}), HasSubstr("hinge: must be"));
  EXPECT_THAT(refusal({{"type", "step"}}), HasSubstr("mode bullet"));
}

TEST_F(StudioOfBodies, HasTheElasticStateOfASimulation) {
  client.ask({{"type", "mode"}, {"mode", "equilibrium"}});
  const double theta = 10 * radians_per_degree;
  const Received frame = client.ask({{"type", "theta"}, {"deg", 10}});
  app::Design turned = file;
  turned.theta = theta;
  const app::Run run = run_design(turned, app::Model::equilibrium, {});
  const model::EquilibriumPath& path = run.equilibrium->path;
  const model::EquilibriumStep& last = path.steps.back();
  EXPECT_EQ(frame.head(8), 1);
  EXPECT_NEAR(frame.head(3), theta, 1e-7);
  EXPECT_GT(last.energy, 0);
  EXPECT_NEAR(frame.head(7), last.energy, 1e-6 * last.energy);
  EXPECT_NEAR(frame.head(6), last.load / assembly().edge_mm, 1e-6 * std::abs(last.load));
  for (int b = 0; b < 2; ++b) EXPECT_LT((pose_of(frame, b).translation() - path.state[b].p).norm(), 1e-5);
}

TEST_F(StudioOfBodies, GivesAHingeAnotherStiffness) {
  client.ask({{"type", "mode"}, {"mode", "equilibrium"}});
  const double soft = client.ask({{"type", "theta"}, {"deg", 10}}).head(7);
  const double turn = assembly().hinges[0].k.turn;
  client.send(
      json{{"type", "hinge"}, {"index", 0}, {"turn", 3 * turn}, {"axial", 50}, {"reach_mm", 1.5}}.dump());
  const json stiffer = changed(client, design), &hinge = stiffer["structure"]["hinges"][0];
  EXPECT_EQ(hinge["k"]["turn"], 3 * turn);
  EXPECT_EQ(hinge["k"]["axial"], 50.0);
  EXPECT_EQ(hinge["k"]["shear"], assembly().hinges[0].k.shear) << "what is not given stays";
  EXPECT_EQ(hinge["reach_mm"], 1.5);
  EXPECT_EQ(stiffer["bodies"]["following"], false) << "its way is the same";
  EXPECT_EQ(stiffer["bodies"]["turn_range_rad"], design["bodies"]["turn_range_rad"]);
  EXPECT_EQ(stiffer["unsaved"], true);
  EXPECT_GT(client.ask({{"type", "theta"}, {"deg", 10}}).head(7), 2 * soft);
  client.send(R"({"type": "undo"})");
  const json undone = changed(client, stiffer);
  EXPECT_EQ(undone["structure"], design["structure"]);
  EXPECT_EQ(undone["unsaved"], false);
  EXPECT_NEAR(client.ask({{"type", "theta"}, {"deg", 10}}).head(7), soft, 1e-6 * soft);
  client.send(R"({"type": "redo"})");
  EXPECT_EQ(changed(client, undone)["structure"], stiffer["structure"]);
}

TEST_F(StudioOfBodies, SavesItsEditsWithTheMeshesAndOpensThemAgain) {
  client.ask({{"type", "hinge"}, {"indices", {0}}, {"turn", 7.25}});
  client.ask({{"type", "theta"}, {"deg", 12}});
  client.send(R"({"type": "save"})");
  const std::string path = client.text("saved")["path"];
  EXPECT_EQ(path, studio.folder.path("design.yaml"));
  app::Design saved = app::read_design(path);
  EXPECT_FALSE(saved.drive) << "the slider looks at it";
  EXPECT_EQ(saved.structure.assembly()->hinges[0].k.turn, 7.25);
  EXPECT_EQ(saved.structure.assembly()->bodies[1].solid.triangles.size(),
            assembly().bodies[1].solid.triangles.size());
  client.send(R"({"type": "save", "at_fold": true})");
  EXPECT_NEAR(client.text("saved")["theta_rad"].get<double>(), 12 * radians_per_degree, 1e-12);
  saved = app::read_design(path);
  const double turn = 12 * radians_per_degree * design["bodies"]["turn_per_theta"].get<double>();
  ASSERT_NE(app::turn_of(saved), nullptr);
  EXPECT_NEAR(app::turn_of(saved)->angle, turn, 1e-12);
  client.ask({{"type", "undo"}});
  client.send(R"({"type": "save"})");
  client.text("saved");
  EXPECT_FALSE(app::read_design(path).drive) << "the fold was a step that can be undone";
}

TEST_F(StudioOfBodies, IsExportedWhileItIsEdited) {
  client.send(R"({"type": "export", "formats": ["stl"], "at_fold": true})");
  const json out = client.text("exported");
  EXPECT_FALSE(out["files"].empty());
  EXPECT_EQ(out["at_fold"], true);
  EXPECT_THAT(refusal({{"type", "export"}, {"formats", {"svg"}}}), HasSubstr("only applies to sheets"));
}

TEST_F(StudioOfBodies, OpensASheetAndComesBackToItsBodies) {
  client.ask({{"type", "mode"}, {"mode", "equilibrium"}});
  client.send(R"({"type": "open", "template": "strip"})");
  const json sheet = changed(client, design);
  EXPECT_FALSE(sheet.contains("bodies"));
  client.send(R"({"type": "undo"})");
  const json back = changed(client, sheet);
  EXPECT_EQ(back["structure"], design["structure"]);
  followed(client);
  EXPECT_EQ(client.ask({{"type", "release"}}).head(8), 0) << "its bodies are not cut yet";
  EXPECT_NEAR(client.ask({{"type", "theta"}, {"deg", 10}}).head(3), 10 * radians_per_degree, 1e-12);
}

TEST_F(StudioOfBodies, IsPulledAndTurnedInThePhysics) {
  const Received before = client.ask({{"type", "mode"}, {"mode", "bullet"}});
  EXPECT_EQ(before.head(8), 2);
  client.ask({{"type", "fix"}, {"body", 0}, {"fixed", true}});
  client.send(R"({"type": "drag", "body": 1, "to": [6, 9, 0]})");
  const model::AssemblyHinge& hinge = assembly().hinges[0];
  Received frame;
  for (int tries = 0; tries < 2000; ++tries) {
    frame = client.receive();
    if (frame.frame.empty()) continue;
    client.acknowledge(frame);
    if (pose_of(frame, 1).translation().y() > 5) break;
  }
  EXPECT_GT(pose_of(frame, 1).translation().y(), 5);
  EXPECT_LT((pose_of(frame, 0).translation() - pose_of(before, 0).translation()).norm(), 0.5);
  EXPECT_LT((carried(frame, assembly(), 0, hinge.point) - carried(frame, assembly(), 1, hinge.point)).norm(),
            0.2);
}

TEST_F(StudioOfBodies, GoesBackToRestAndLetsGoOfWhatWasHeld) {
  client.ask({{"type", "mode"}, {"mode", "bullet"}});
  expect_state({{"type", "pause"}, {"on", true}}, "paused", true);
  expect_state({{"type", "speed"}, {"factor", 0.5}}, "speed", 0.5);
  EXPECT_THAT(refusal({{"type", "speed"}, {"factor", 2}}), HasSubstr("factor"));
  expect_state({{"type", "gravity"}, {"on", true}}, "gravity", true);
  for (const int body : {0, 1}) client.ask({{"type", "fix"}, {"body", body}, {"fixed", true}});
  const auto falls_by = [&](int steps) {
    Received frame = client.ask({{"type", "step"}});
    const double from = pose_of(frame, 1).translation().z();
    for (int k = 0; k < steps; ++k) frame = client.ask({{"type", "step"}});
    return from - pose_of(frame, 1).translation().z();
  };
  EXPECT_LT(falls_by(60), 0.5) << "held";
  client.ask({{"type", "reset"}});
  EXPECT_GT(falls_by(60), 1) << "free";
  const Received exact = client.ask({{"type", "mode"}, {"mode", "exact"}});
  EXPECT_EQ(exact.head(8), 0);
}

TEST_F(StudioOfALoop, KeepsOppositeBodiesOfAParallelogramParallel) {
  const Received frame = client.ask({{"type", "theta"}, {"deg", 17.5}});
  EXPECT_NEAR(std::abs(frame.head(3)), 17.5 * radians_per_degree, 1e-12);
  for (const int k : {0, 1})
    EXPECT_LT((pose_of(frame, k).linear() - pose_of(frame, k + 2).linear()).norm(), 1e-6);
  EXPECT_GT((pose_of(frame, 0).linear() - pose_of(frame, 1).linear()).norm(), 0.5);
}

TEST_F(StudioOfALoop, TurnsByAnotherHinge) {
  const int first = design["bodies"]["driven"], other = (first + 1) % 4;
  client.ask({{"type", "theta"}, {"deg", 17.5}});
  client.send(json{{"type", "driven"}, {"hinge", other}}.dump());
  const json changed = followed(client, other);
  EXPECT_EQ(changed["bodies"]["driven"], other);
  EXPECT_GT(changed["revision"], design["revision"]);
  EXPECT_EQ(changed["structure"], design["structure"]);
  EXPECT_EQ(changed["undo"], true);
  const Received frame = client.ask({{"type", "theta"}, {"deg", 20}});
  EXPECT_LT((pose_of(frame, 0).linear() - pose_of(frame, 2).linear()).norm(), 1e-6);
  client.send(R"({"type": "undo"})");
  EXPECT_EQ(followed(client, first)["bodies"]["driven"], first);
}

TEST(StudioOfBodiesOpened, KeepsWhatIsNotSaved) {
  const TemporaryFolder folder;
  const auto opened = [&] {
    app::studio::SessionInput out{pair_of_walls(), folder.path("design.yaml")};
    out.autosave = std::make_shared<app::studio::Autosave>(folder.path("state"), folder.path("design.yaml"));
    return out;
  };
  {
    OpenStudio killed(opened());
    Client client{killed.port()};
    ASSERT_TRUE(client.open(killed.token));
    client.ask({{"type", "hinge"}, {"index", 0}, {"turn", 7.25}});
  }
  OpenStudio studio(opened());
  Client client{studio.port()};
  ASSERT_TRUE(client.open(studio.token));
  EXPECT_EQ(client.text("meshes")["bodies"].size(), 2u);
  const json design = followed(client);
  EXPECT_EQ(design["structure"]["hinges"][0]["k"]["turn"], 7.25);
  EXPECT_EQ(design["restored"], true);
  client.send(R"({"type": "undo"})");
  EXPECT_EQ(changed(client, design)["unsaved"], false);
}

TEST(StudioOfBodiesOpened, IsAsFarTurnedAsItsDriveSays) {
  app::Design file = pair_of_walls();
  file.drive = model::HingeTurn{0, 40 * radians_per_degree};
  OpenStudio studio{file};
  Client client{studio.port()};
  ASSERT_TRUE(client.open(studio.token));
  const json design = followed(client);
  const Received frame = client.ask({{"type", "release"}});
  EXPECT_NEAR(frame.head(3) * design["bodies"]["turn_per_theta"].get<double>(), app::turn_of(file)->angle,
              1e-12);
}

TEST(StudioOfBodiesOpened, GoesTheWayThatItsBodiesArePulled) {
  app::Design file = parallelogram();
  const model::Linkage linkage = model::Linkage(file.structure);
  file.drive = model::BodyPull{
      .poses =
          solve_closure(linkage, rest_state(linkage), {model::HingeTurn{0, 30 * radians_per_degree}}).state};
  OpenStudio studio{file};
  Client client{studio.port()};
  ASSERT_TRUE(client.open(studio.token));
  const json design = followed(client);
  EXPECT_EQ(design["bodies"]["pulled"], true);
  EXPECT_EQ(design["drive"], "bodies that are pulled");
  client.send(R"({"type": "mode", "mode": "equilibrium"})");
  EXPECT_THAT(client.text("error")["message"].get<std::string>(), HasSubstr("turns one hinge"));
  const double least = design["theta_range_rad"][0], most = design["theta_range_rad"][1];
  const double end = least < 0 ? least : most;
  EXPECT_EQ(least * most, 0) << "one way from rest";
  EXPECT_NEAR(end * design["bodies"]["turn_per_theta"].get<double>(), 30 * radians_per_degree, 1e-3);
  for (const double share : {0.3, 0.77, 1.0}) {
    const Received frame = client.ask({{"type", "theta"}, {"deg", to_degrees(share * end)}});
    EXPECT_NEAR(frame.head(3), share * end, 1e-9);
    for (const model::AssemblyHinge& hinge : file.structure.assembly()->hinges)
      EXPECT_LT((carried(frame, *file.structure.assembly(), hinge.lower, hinge.point) -
                 carried(frame, *file.structure.assembly(), hinge.upper, hinge.point))
                    .norm(),
                1e-5);
    EXPECT_LT((pose_of(frame, 0).linear() - pose_of(frame, 2).linear()).norm(), 1e-5);
  }
  client.ask({{"type", "mode"}, {"mode", "bullet"}});
  client.send(R"({"type": "theta", "deg": 5})");
  EXPECT_THAT(client.text("error")["message"].get<std::string>(),
              HasSubstr("bodies of this design are pulled"));
}

TEST(StudioOfBodiesOpened, StopsWhereAHingeOpens) {
  app::Design file = parallelogram();
  model::Assembly bodies = *file.structure.assembly();
  model::AssemblyHinge& tilted = bodies.hinges[0];
  tilted.axis = Eigen::AngleAxisd(1 * radians_per_degree, tilted.along) * tilted.axis;
  file.structure = model::Lattice(bodies);
  file.drive = model::HingeTurn{1, 0};
  OpenStudio studio{file};
  Client client{studio.port()};
  ASSERT_TRUE(client.open(studio.token));
  const json design = followed(client);
  for (const double end : {-89.0, 89.0}) {
    const Received frame = client.ask({{"type", "theta"}, {"deg", end}});
    const double last = design["theta_range_rad"][end < 0 ? 0 : 1];
    EXPECT_NEAR(frame.head(3), last, 1e-12);
    EXPECT_LT(std::abs(last), 80 * radians_per_degree) << "four axes that are not parallel do not turn";
  }
  const json& opens = design["bodies"]["opens"];
  for (const json& hinge : opens) EXPECT_TRUE(hinge.is_number_integer()) << opens;
  EXPECT_THAT(design["why"].dump(), HasSubstr("opens first"));
}

TEST(StudioOfBodiesOpened, RefusesABrokenFileWithItsPlace) {
  const TemporaryFolder folder;
  const std::string file = folder.path("design.yaml");
  for (const app::NamedContent& content : design_files(pair_of_walls()))
    if (content.name == "design.yaml") app::write_file(file, content.content);
  try {
    app::view_command({}, {.source = file, .opens_browser = false});
    ADD_FAILURE() << "opened without its meshes";
  } catch (const InvalidInput& e) {
    EXPECT_THAT(e.what(), HasSubstr("parts/left.stl"));
  }
}

}  // namespace
}  // namespace kinetix::testing
