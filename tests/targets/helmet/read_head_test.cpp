#include "targets/helmet/read_head.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "targets/curve/read_curve.hpp"
#include "targets/mesh/mesh_file.hpp"
#include "targets/mesh/mesh_section.hpp"
#include "tests/support/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/targets/heads.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;
using testing::BadInput;
using testing::expect_refused;
using testing::head_with_ears;
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
  const Head told = read(
      "{kind: helmet, mesh: head.obj, up: +y, units: cm, front: -x, crown: [10, 114.5, 0], coverage_mm: 70}",
      file);
  EXPECT_EQ(told.coverage_mm, 70);
  EXPECT_EQ(told.to_mesh.linear().col(1), -Vector3d::UnitX());
  EXPECT_EQ(told.to_mesh.translation(), Vector3d(10, 114.5, 0));
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
      {"{mesh: tiny.obj}",
       1,
       16,
       "target.mesh",
       {"in mm the mesh is 2.18", "none of the units mm, cm, m, in would do"}},
      {"{mesh: head.obj, units: km}", 1, 33, "target.units", {"allowed: mm, cm, m, in"}},
      {"{mesh: head.obj, units: m}", 1, 33, "target.units", {"`units: mm` would make it"}},
      {"{mesh: head.obj, up: w}", 1, 30, "target.up", {"`w` is not known", "-z"}},
      {"{mesh: head.obj, up: z, front: -z}", 1, 40, "target.front", {"across"}},
      {"{mesh: head.obj, crown: [0, 0]}", 1, 33, "target.crown", {"[x, y, z]"}},
      {"{mesh: head.obj, crown: [0, 0, .nan]}", 1, 40, "target.crown[2]", {"number"}},
      {"{mesh: head.obj, crown: [0, 0, 300]}", 1, 33, "target.crown", {"185 mm from the mesh"}},
      {"{mesh: head.obj, coverage_mm: 0}", 1, 39, "target.coverage_mm", {"above 0"}},
      {"{mesh: head.obj, coverage_mm: 900}", 1, 39, "target.coverage_mm", {"goes beyond the mesh"}},
  };
  for (const BadInput& bad : cases) expect_refused(bad, file, [&] { read(bad.text, file); });
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
