#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numbers>

#include "model/lattice/square/structure.hpp"
#include "targets/curve/read_curve.hpp"
#include "targets/helmet/head.hpp"
#include "targets/mesh/mesh_file.hpp"
#include "targets/mesh/mesh_section.hpp"
#include "tests/support/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/targets/heads.hpp"
#include "tests/targets/meshes.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;
using testing::add_part;
using testing::ellipsoid;
using ::testing::HasSubstr;
using testing::head_axes;
using testing::head_with_ears;
using testing::scanned_head;

/// How far p is from the ellipsoid of the head, mm, to first order.
double off_ellipsoid(const Vector3d& p) {
  const Vector3d scaled = p.cwiseQuotient(head_axes), gradient = scaled.cwiseQuotient(head_axes);
  return (scaled.squaredNorm() - 1) / (2 * gradient.norm());
}

double off_ellipsoid(const Head& head, const SpaceCurve& curve, double reach) {
  double worst = 0;
  for (double l = -reach; l <= reach; l += 1)
    worst = std::max(worst, std::abs(off_ellipsoid(head.to_mesh * curve.at(l))));
  return worst;
}

/// Arc length of the ellipse (a cos u, b sin u) from its end on b over the angle u.
double arc_of_ellipse(double a, double b, double u) {
  double sum = 0;
  for (int k = 0; k < 100000; ++k) {
    const double v = u * (k + 0.5) / 100000;
    sum += std::hypot(a * std::cos(v), b * std::sin(v)) * u / 100000;
  }
  return sum;
}

TEST(Head, OfASphereHasCirclesForProfileAndSections) {
  const Head head = make_head(ellipsoid({100, 100, 100}, 360, 180), {});
  EXPECT_NEAR(head.closed_part, 0, 0);
  EXPECT_LE((head.to_mesh.translation() - Vector3d(0, 0, 100)).norm(), 1e-9);
  for (double s = -90; s <= 90; s += 15) {
    const Vector3d expected(0, 100 * std::sin(s / 100), 100 * std::cos(s / 100) - 100);
    EXPECT_LE((head.profile.at(s) - expected).norm(), 0.03) << s;
    const SpaceCurve across = cross_section(head, s, 10);
    for (double l = -90; l <= 90; l += 15) {
      const Vector3d outward = std::cos(l / 100) * Vector3d(0, std::sin(s / 100), std::cos(s / 100));
      EXPECT_LE((across.at(l) - Vector3d(100 * std::sin(l / 100), 0, -100) - 100 * outward).norm(), 0.1)
          << s << " " << l;
    }
  }
}

TEST(Head, ProfileAndCrownSectionOfAnEllipsoidHaveTheLengthOfTheEllipses) {
  const Head head = make_head(ellipsoid(head_axes, 360, 240), {});
  const auto at_angle = [&](int axis, double u) {
    Vector3d p(0, 0, 115 * std::cos(u));
    p[axis] = head_axes[axis] * std::sin(u);
    return Vector3d(head.to_mesh.inverse() * p);
  };
  const SpaceCurve across = cross_section(head, 0, 10);
  for (const double u : {0.2, 0.5, 0.8, 1.1, 1.4}) {
    EXPECT_NEAR(head.profile.nearest(at_angle(1, u)), arc_of_ellipse(98, 115, u), 0.1);
    EXPECT_NEAR(across.nearest(at_angle(0, u)), arc_of_ellipse(77, 115, u), 0.1);
  }
}

TEST(Head, MirroredSectionsAreMirrorImages) {
  const Head head = make_head(head_with_ears(), {});
  for (const double s : {-80.0, -30.0, 0.0, 55.0}) {
    const SpaceCurve across = cross_section(head, s, 10);
    for (double l = 5; l <= 80; l += 5) {
      const Vector3d left = across.at(-l), right = across.at(l);
      EXPECT_LE((left - Vector3d(-right.x(), right.y(), right.z())).norm(), 0.05) << s << " " << l;
    }
  }
}

TEST(Head, SectionsAboveTheEarsKnowNothingOfEarsAndNose) {
  const Head head = make_head(head_with_ears(), {});
  EXPECT_LE(off_ellipsoid(head, head.profile, 90), 0.15);
  for (const double s : {-90.0, -45.0, 0.0, 45.0, 90.0})
    EXPECT_LE(off_ellipsoid(head, cross_section(head, s, 10), 85), 0.15) << s;
}

TEST(Head, NoiseHolesFlapsAndInnerShellsMoveItsSectionsByLittleMoreThanTheNoise) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Head head = make_head(scanned_head(seed, 0.2, 12), {});
    EXPECT_GT(head.closed_part, 0) << seed;
    EXPECT_LE(off_ellipsoid(head, head.profile, 90), 1.2) << seed;
    for (const double s : {-90.0, -45.0, 0.0, 45.0, 90.0})
      EXPECT_LE(off_ellipsoid(head, cross_section(head, s, 10), 85), 1.2) << seed << " " << s;
  }
}

TEST(Head, ClosesAHoleNearlyAsTheHeadWas) {
  TriangleMesh mesh = ellipsoid(head_axes, 360, 240);
  for (const Vector3d& centre : {Vector3d(0, 0, 115), Vector3d(0, 85, 57), Vector3d(60, 20, 65)})
    std::erase_if(mesh.triangles,
                  [&](const Triangle& t) { return (mesh.vertices[t[0]] - centre).norm() < 15; });
  const Head head = make_head(mesh, {.crown = Vector3d(0, 0, 115)});
  EXPECT_GT(head.closed_part, 0.015);
  for (const Vector3d& p : head.dome.mesh().vertices)
    EXPECT_LE(std::abs(off_ellipsoid(head.to_mesh * p)), 0.6);
  EXPECT_LE(std::abs(off_ellipsoid(head.to_mesh * head.profile.at(0))), 0.6);
}

TEST(Head, DistancesAreThoseInTheAxesOfTheMesh) {
  const TriangleMesh mesh = head_with_ears();
  const Head head = make_head(mesh, {.crown = Vector3d(5, 10, 114)});
  const MeshDistance given(mesh, Vector3d(0, 0, 40));
  for (double y = -60; y < 70; y += 13) {
    const Vector3d p(0.3 * y, y, 118 - 0.005 * y * y);
    EXPECT_NEAR(head.scan.distance(head.to_mesh.inverse() * p), given.closest(p).distance, 1e-9);
    EXPECT_NEAR(head.dome.closest(head.to_mesh.inverse() * p).distance, given.closest(p).distance, 0.1);
  }
}

/// Every point of an ear that stands out lies under the dome, and no other part of it is lifted.
TEST(Head, KeepsThinEarsInItsDome) {
  const Head head = make_head(testing::head_with_thin_ears(), {});
  EXPECT_EQ(head.closed_part, 0);
  EXPECT_TRUE(head.openings.empty());
  for (const double side : {-1.0, 1.0})
    for (const double rise : {-12.0, 0.0, 12.0}) {
      const Vector3d in_ear(side * (testing::ear_centre.x() + 20), testing::ear_centre.y(), 40 + rise);
      EXPECT_LT(head.dome.closest(head.to_mesh.inverse() * in_ear).distance, 0);
      EXPECT_LT(head.scan.distance(head.to_mesh.inverse() * in_ear), 0);
    }
  EXPECT_LE(off_ellipsoid(head, head.profile, 90), 0.15);
}

TEST(Head, SaysHowWideTheHolesAreThatItsDomeCloses) {
  TriangleMesh mesh = ellipsoid(head_axes, 360, 240);
  const double radius = 15;
  for (const Vector3d& centre : {Vector3d(0, 85, 57), Vector3d(60, 20, 65), Vector3d(0, 98, -60)})
    std::erase_if(mesh.triangles,
                  [&](const Triangle& t) { return (mesh.vertices[t[0]] - centre).norm() < radius; });
  const Head head = make_head(mesh, {});
  ASSERT_EQ(head.openings.size(), 2u);  // the third is below the coverage
  for (const DomeOpening& opening : head.openings) {
    EXPECT_NEAR(opening.width_mm, 2 * radius, 5);
    EXPECT_GT(opening.top_z, -60);
    EXPECT_LT(opening.top_z, 0);
  }
}

TEST(Head, OfALampshadeHasAnInventedTop) {
  const Head head = make_head(testing::lampshade(45), {});
  ASSERT_EQ(head.openings.size(), 1u);
  EXPECT_NEAR(head.openings[0].width_mm, 90, 6);
  EXPECT_GT(head.closed_part, 0.02);
}

TEST(Head, IsTheSameInEveryPoseAndUnit) {
  const TriangleMesh mesh = head_with_ears(90, 60);
  const Head upright = make_head(mesh, {.front = Vector3d::UnitY()});
  struct Turned {
    HeadPose pose;
    std::function<Vector3d(const Vector3d&)> turn;
  };
  const std::vector<Turned> cases = {
      {{1000, Vector3d::UnitY(), -Vector3d::UnitZ(), {}, 90},
       [](const Vector3d& p) -> Vector3d { return Vector3d(p.x(), p.z(), -p.y()) / 1000; }},
      {{25.4, -Vector3d::UnitX(), Vector3d::UnitZ(), {}, 90},
       [](const Vector3d& p) -> Vector3d { return Vector3d(-p.z(), -p.x(), p.y()) / 25.4; }},
      {{10, Vector3d::UnitY(), Vector3d::UnitX(), {}, 90},
       [](const Vector3d& p) -> Vector3d { return Vector3d(p.y() + 300, p.z(), p.x()) / 10; }}};
  for (const auto& [pose, turn] : cases) {
    TriangleMesh turned = mesh;
    for (Vector3d& p : turned.vertices) p = turn(p);
    const Head head = make_head(turned, pose);
    EXPECT_NEAR(head.to_mesh.linear().determinant(), 1, 1e-12);
    for (const double s : {-80.0, 0.0, 70.0}) {
      EXPECT_LE((head.profile.at(s) - upright.profile.at(s)).norm(), 1e-6);
      EXPECT_LE((cross_section(head, s, 10).at(50) - cross_section(upright, s, 10).at(50)).norm(), 1e-6);
    }
  }
}

TEST(Head, IsTakenToBeLongerThanBroad) {
  TriangleMesh mesh = ellipsoid({98, 77, 115}, 90, 60);
  EXPECT_EQ(make_head(mesh, {}).to_mesh.linear().col(1), Vector3d::UnitX());
  EXPECT_EQ(make_head(mesh, {.front = -Vector3d::UnitY()}).to_mesh.linear().col(1), -Vector3d::UnitY());
}

std::string says(const TriangleMesh& mesh, const HeadPose& pose, const std::string& key) {
  try {
    make_head(mesh, pose);
  } catch (const InvalidHead& e) {
    EXPECT_EQ(e.key(), key) << e.what();
    return e.what();
  }
  return {};
}

TEST(Head, OfAnotherSizeIsRefusedWithTheUnitThatWouldDo) {
  const auto sized = [](double mm) { return ellipsoid(mm / 230 * head_axes, 24, 12); };
  EXPECT_THAT(says(sized(2), {}, "units"),
              HasSubstr("is 2 mm long, and a head or a bust is 100 to 1000 mm. Give `units: dm` for 200 mm"));
  EXPECT_THAT(says(sized(0.23), {}, "units"), HasSubstr("Give `units: m` for 230 mm"));
  EXPECT_THAT(says(sized(23), {}, "units"), HasSubstr("Give `units: cm` for 230 mm"));
  EXPECT_THAT(says(sized(9), {}, "units"), HasSubstr("Give `units: in` for 228.6 mm"));
  EXPECT_THAT(says(sized(230), {.unit_mm = 1000}, "units"), HasSubstr("Give `units: mm` for 230 mm"));
  EXPECT_THAT(says(sized(2e6), {}, "units"),
              HasSubstr("is 2e+06 mm long, and a head or a bust is 100 to 1000 mm"));
}

TEST(Head, RefusesACrownAwayFromTheMesh) {
  const TriangleMesh mesh = head_with_ears(90, 60);
  EXPECT_THAT(says(mesh, {.crown = Vector3d(0, 0, 145)}, "crown"), HasSubstr("is 30 mm from the mesh"));
  EXPECT_THAT(says(mesh, {.crown = Vector3d(0, 0, 0)}, "crown"),
              HasSubstr("remove the key for the highest, [0, 0, 115]"));
  EXPECT_EQ(says(mesh, {.crown = Vector3d(0, 0, 125)}, "crown"), "");
}

TEST(Head, RefusesACoverageThatTheMeshDoesNotReach) {
  const TriangleMesh mesh = ellipsoid(head_axes, 90, 60);
  EXPECT_THAT(says(mesh, {.coverage_mm = 400}, "coverage_mm"),
              HasSubstr("to the back the head can be followed down to"));
  TriangleMesh cap = mesh;
  std::erase_if(cap.triangles, [&](const Triangle& t) { return mesh.vertices[t[0]].z() < 60; });
  EXPECT_THAT(says(cap, {.coverage_mm = 120}, "coverage_mm"), HasSubstr("goes beyond the mesh"));
  EXPECT_EQ(says(cap, {.coverage_mm = 45}, "coverage_mm"), "");
  TriangleMesh open = mesh;
  std::erase_if(open.triangles, [&](const Triangle& t) { return mesh.vertices[t[0]].x() > 40; });
  EXPECT_THAT(says(open, {}, "coverage_mm"), HasSubstr("to the right"));
  open = mesh;
  std::erase_if(open.triangles, [&](const Triangle& t) { return std::abs(mesh.vertices[t[0]].x()) < 30; });
  EXPECT_THAT(says(open, {.crown = Vector3d(-28, 0, 105)}, "mesh"), HasSubstr("no surface at the crown"));
}

TEST(Head, RefusesAFrontAlongUp) {
  EXPECT_THAT(says(head_with_ears(90, 60), {.front = -Vector3d::UnitZ()}, "front"),
              HasSubstr("perpendicular"));
}

/// 3 x 2 cells of 10 mm with walls 4 mm high, flat, round the origin.
struct Sheet {
  model::Structure structure = make_structure(model::rectangle(3, 2), {10, 1, 4});

  /// Its middle plane at height z.
  model::State at(double z) const {
    model::State state = rest_state(structure);
    Vector3d middle = Vector3d::Zero();
    for (const model::Pose& pose : state) middle += pose.p / static_cast<double>(state.size());
    for (model::Pose& pose : state) pose.p += Vector3d(0, 0, z) - middle;
    return state;
  }
};

TEST(WallsInside, OfASheetOnACubeAreAllOrNone) {
  const Sheet sheet;
  const MeshSolid block(testing::cube(50));
  const int corners = 2 * 8 * static_cast<int>(sheet.structure.hinges.size());
  struct Case {
    double z;
    bool is_inside;
    double share, depth;
  };
  for (const auto& [z, is_inside, share, depth] : {Case{60, false, 0, 0},
                                                   {52.1, false, 0, 0},
                                                   {51, true, 0.5, 1},
                                                   {48.5, true, 0.5, 3.5},
                                                   {40, true, 1, 12}}) {
    const WallsInside found = walls_inside(sheet.structure, sheet.at(z), block);
    EXPECT_EQ(found.hinges.size(), is_inside ? sheet.structure.hinges.size() : 0) << z;
    EXPECT_EQ(found.corners, share * corners) << z;
    EXPECT_NEAR(found.depth_mm, depth, 1e-9) << z;
  }
}

TEST(WallsInside, AreSeenBetweenTheirCorners) {
  const Sheet sheet;
  const model::State state = sheet.at(0);
  const Vector3d middle = state[sheet.structure.hinges[4].lower].p +
                          3 * model::edge_direction(sheet.structure.hinges[4].wall.axis);
  TriangleMesh needle;
  testing::add_part(needle, testing::ellipsoid({0.1, 0.1, 40}, 12, 12), middle);
  const WallsInside found = walls_inside(sheet.structure, state, MeshSolid(needle));
  EXPECT_EQ(found.hinges, std::vector<int>{4});
  EXPECT_EQ(found.corners, 0);
  EXPECT_EQ(found.depth_mm, 0);
}

using testing::BadInput;
using testing::expect_refused;
using testing::obj_text;
using testing::TemporaryFolder;

// The folder of the goal shapes that ship.
const std::string shapes = std::string(KINETIX_SOURCE) + "/targets/shapes/";

Head read(const std::string& target, const std::string& file) {
  std::vector<Key> keys = head_keys();
  keys.push_back(coverage_key());
  keys.push_back(goal_kind_key("helmet"));
  const KeyTable table(keys);
  return read_head({parse_document("target: " + target + "\n", file).required("target", ""), table});
}

TEST(ReadHead, TakesWhatTheSectionSays) {
  TemporaryFolder folder;
  TriangleMesh mesh = head_with_ears(90, 60);
  for (Vector3d& p : mesh.vertices) p = Vector3d(p.y(), p.z(), p.x()) / 10;  // x to the front, y up
  folder.write("head.obj", obj_text(mesh));
  const std::string file = folder.path("in.yaml");
  const Head plain = read("{kind: helmet, mesh: head.obj, up: y, units: cm}", file);
  EXPECT_EQ(plain.coverage_mm, 90);
  EXPECT_EQ(plain.to_mesh.linear().col(1), Vector3d::UnitX());
  EXPECT_EQ(plain.to_mesh.linear().col(2), Vector3d::UnitY());
  EXPECT_LE((plain.to_mesh.translation() - Vector3d(0, 115, 0)).norm(), 1e-4);
  const Head specified = read(
      "{kind: helmet, mesh: head.obj, up: +y, units: cm, front: -x, crown: [10, 114.5, 0], coverage_mm: 70}",
      file);
  EXPECT_EQ(specified.coverage_mm, 70);
  EXPECT_EQ(specified.to_mesh.linear().col(1), -Vector3d::UnitX());
  EXPECT_EQ(specified.to_mesh.translation(), Vector3d(10, 114.5, 0));
}

TEST(ReadHead, RefusesWhatIsNoHeadAtTheKeyAtFault) {
  TemporaryFolder folder;
  folder.write("head.obj", obj_text(head_with_ears(90, 60)));
  folder.write("nan.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n");
  folder.write("empty.obj", "v 0 0 0\n");
  TriangleMesh tiny = head_with_ears(90, 60);
  for (Vector3d& p : tiny.vertices) p *= 0.01;
  folder.write("tiny.obj", obj_text(tiny));
  const std::string file = folder.path("in.yaml");
  const std::vector<BadInput> cases = {
      {"{up: y}", 1, 9, "target", {"the key `mesh` is missing"}},
      {"{mesh: none.obj}", 1, 16, "target.mesh", {"none.obj: no such file"}},
      {"{mesh: nan.obj}", 1, 16, "target.mesh", {"nan.obj:2:5: `nan`"}},
      {"{mesh: empty.obj}", 1, 16, "target.mesh", {"empty.obj: has no triangles"}},
      {"{mesh: tiny.obj}", 1, 16, "target.mesh", {"the mesh is 2.18", "Give `units: dm` for 218", "head_mm"}},
      {"{mesh: head.obj, units: km}", 1, 33, "target.units", {"allowed: mm, cm, dm, m, in"}},
      {"{mesh: head.obj, units: m}", 1, 33, "target.units", {"Give `units: mm` for"}},
      {"{mesh: head.obj, up: w}", 1, 30, "target.up", {"`w` is not known", "-z"}},
      {"{mesh: head.obj, up: z, front: -z}", 1, 40, "target.front", {"perpendicular"}},
      {"{mesh: head.obj, crown: [0, 0]}", 1, 33, "target.crown", {"[x, y, z]"}},
      {"{mesh: head.obj, crown: [0, 0, .nan]}", 1, 40, "target.crown[2]", {"number"}},
      {"{mesh: head.obj, crown: [0, 0, 300]}", 1, 33, "target.crown", {"185 mm from the mesh"}},
      {"{mesh: head.obj, coverage_mm: 0}", 1, 39, "target.coverage_mm", {"above 0"}},
      {"{mesh: head.obj, coverage_mm: 900}", 1, 39, "target.coverage_mm", {"goes beyond the mesh"}},
  };
  for (const BadInput& bad : cases) expect_refused(bad, file, [&] { read(bad.text, file); });
}

/// Turns a mesh so that its z axis becomes `up`.
TriangleMesh turned_up(TriangleMesh mesh, const Vector3d& up) {
  const Eigen::Matrix3d R = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), up).toRotationMatrix();
  for (Vector3d& p : mesh.vertices) p = R * p;
  return mesh;
}

// Unit vectors along all axes of a file.
const std::array<Vector3d, 6> all_axes = {Vector3d(1, 0, 0),  Vector3d(-1, 0, 0), Vector3d(0, 1, 0),
                                          Vector3d(0, -1, 0), Vector3d(0, 0, 1),  Vector3d(0, 0, -1)};

/// A head with its neck and shoulders, which show which way it lies.
TriangleMesh bust() {
  TriangleMesh mesh = head_with_ears(90, 60);
  add_part(mesh, ellipsoid({55, 60, 90}, 40, 30), {0, -15, -130});
  add_part(mesh, ellipsoid({200, 100, 80}, 40, 30), {0, -20, -250});
  return mesh;
}

TEST(LikelyUp, FindsTheCrownWhicheverWayABustLies) {
  for (const Vector3d& up : all_axes)
    EXPECT_LE((likely_up(turned_up(bust(), up)) - up).norm(), 1e-9) << up.transpose();
}

TEST(LikelyUp, IsZIfTheShapeDoesNotShowIt) {
  for (const TriangleMesh& mesh : {ellipsoid(head_axes, 90, 60), read_mesh(shapes + "headform.obj")})
    for (const Vector3d& up : all_axes)
      EXPECT_EQ(likely_up(turned_up(mesh, up)), Vector3d::UnitZ()) << up.transpose();
}

TEST(ReadHead, StatesTheAxisThatItFoundByTheShape) {
  TemporaryFolder folder;
  folder.write("head.obj", obj_text(turned_up(bust(), Vector3d::UnitY())));
  const Head head = read("{mesh: head.obj}", folder.path("in.yaml"));
  EXPECT_EQ(head.to_mesh.linear().col(2), Vector3d::UnitY());
  ASSERT_EQ(head.notes.size(), 1u);
  EXPECT_THAT(head.notes[0],
              HasSubstr("the head points up along +y of the mesh. Give `up` if this is wrong"));
  EXPECT_TRUE(read("{mesh: head.obj, up: y}", folder.path("in.yaml")).notes.empty());
}

TEST(ReadHead, TakesTheLengthOfAHeadForItsUnit) {
  TemporaryFolder folder;
  TriangleMesh mesh = head_with_ears(90, 60);
  for (Vector3d& p : mesh.vertices) p *= 0.0137;
  folder.write("head.obj", obj_text(mesh));
  const std::string file = folder.path("in.yaml");
  const Head head = read("{mesh: head.obj, head_mm: 196}", file);
  EXPECT_NEAR(head.to_mesh.translation().z(), 115, 4) << "the head is 196 mm long where it is longest";
  EXPECT_NEAR(read("{mesh: head.obj, units: 73}", file).to_mesh.translation().z(), 115, 0.1);
  EXPECT_THAT(testing::refusal([&] { read("{mesh: head.obj}", file); }),
              HasSubstr("or the length of the head by `head_mm`"));
  EXPECT_THAT(testing::refusal([&] { read("{mesh: head.obj, head_mm: 196, units: cm}", file); }),
              HasSubstr("target.head_mm: cannot be combined with `units`"));
}

TEST(ReadHead, TakesThePartOfABodyNearItsCrown) {
  TemporaryFolder folder;
  TriangleMesh body = ellipsoid(head_axes, 60, 40);
  testing::add_part(body, ellipsoid({220, 120, 760}, 40, 40), Vector3d(0, 0, -860));
  folder.write("body.obj", obj_text(body));
  const Head head = read("{mesh: body.obj, up: z}", folder.path("in.yaml"));
  EXPECT_LE(bounds(head.dome.mesh()).sizes().maxCoeff(), 320);
}

TEST(ReadHead, RecognisesTheScanOfAFace) {
  TemporaryFolder folder;
  TriangleMesh face = head_with_ears(90, 60);
  std::erase_if(face.triangles, [&](const Triangle& t) { return face.vertices[t[0]].y() < 20; });
  folder.write("face.obj", obj_text(face));
  for (const std::string up : {"", ", up: z"})
    EXPECT_THAT(testing::refusal([&] { read("{mesh: face.obj" + up + "}", folder.path("in.yaml")); }),
                HasSubstr("target.mesh: the mesh shows one side of a head alone"))
        << up;
}

TEST(ReadHead, NamesTheCoverageThatFits) {
  TemporaryFolder folder;
  TriangleMesh cap = head_with_ears(90, 60);
  std::erase_if(cap.triangles, [&](const Triangle& t) { return cap.vertices[t[0]].z() < 40; });
  folder.write("cap.obj", obj_text(cap));
  EXPECT_THAT(testing::refusal([&] { read("{mesh: cap.obj}", folder.path("in.yaml")); }),
              HasSubstr("target.mesh: `coverage_mm: 90` goes beyond the mesh"));
}

TEST(Headform, HasThePublishedDimensions) {
  const TriangleMesh mesh = read_mesh(shapes + "headform.obj");
  EXPECT_EQ(mesh.triangles.size(), 5120u);
  const Vector3d size = bounds(mesh).sizes();
  EXPECT_NEAR(size.x(), 154.3, 1e-3);
  EXPECT_NEAR(size.y(), 199.5, 1e-3);
  EXPECT_NEAR(bounds(mesh).max().z(), 0.75 * 131.1, 1e-3);
  const auto longest = section(mesh, Plane(Vector3d::UnitZ(), Vector3d(0, 0, 1e-6)));
  ASSERT_EQ(longest.size(), 1u);
  std::vector<Vector3d> ring = longest[0].points;
  ring.push_back(ring.front());
  EXPECT_NEAR(SpaceCurve(ring).length(), 574.4, 0.6);
}

TEST(Headform, IsClosedAndWoundOutward) {
  const TriangleMesh mesh = read_mesh(shapes + "headform.obj");
  EXPECT_EQ(mesh.vertices.size() + mesh.triangles.size(), 3 * mesh.triangles.size() / 2 + 2);  // Euler
  double volume = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    EXPECT_GT(area_normal(mesh, t).dot(mesh.corner(t, 0)), 0);
    volume += area_normal(mesh, t).dot(mesh.corner(t, 0)) / 6;
  }
  EXPECT_GT(volume, 4 * std::numbers::pi / 3 * 154.3 / 2 * 199.5 / 2 * 98.3);  // fuller than its ellipsoid
}

TEST(Headform, HasTheHelmetRibForProfile) {
  const Head head = read("{mesh: headform.obj}", shapes + "in.yaml");
  const Curve rib = read_curve_csv(shapes + "helmet_rib.csv");
  for (double s = -100; s <= 100; s += 10) {
    const Vector3d p = head.to_mesh * head.profile.at(s);
    const Eigen::Vector2d expected = rib.at(rib.length() / 2 + s);
    EXPECT_LE((Eigen::Vector2d(p.y(), p.z()) - expected).norm(), 0.4) << s;
  }
}

}  // namespace
}  // namespace kinetix::targets
