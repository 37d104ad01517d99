#include "targets/mesh/mesh_file.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <random>

#include "tests/support/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/targets/meshes.hpp"

namespace kinetix::targets {
namespace {

using testing::ellipsoid;
using ::testing::HasSubstr;
using testing::obj_text;
using testing::off_text;
using testing::ply_binary;
using testing::ply_text;
using testing::refusal;
using testing::stl_binary;
using testing::stl_text;
using testing::TemporaryFolder;
using testing::tetrahedron;

struct NamedBytes {
  std::string name, bytes;
};

std::vector<NamedBytes> every_format(const TriangleMesh& mesh) {
  return {{"a.obj", obj_text(mesh)}, {"b.stl", stl_text(mesh)},   {"c.STL", stl_binary(mesh)},
          {"d.ply", ply_text(mesh)}, {"e.ply", ply_binary(mesh)}, {"f.ply", ply_binary(mesh, true)},
          {"g.off", off_text(mesh)}};
}

void expect_same_triangles(const TriangleMesh& mesh, const TriangleMesh& expected) {
  EXPECT_EQ(mesh.vertices.size(), expected.vertices.size());
  ASSERT_EQ(mesh.triangles.size(), expected.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) EXPECT_LE((mesh.corner(t, k) - expected.corner(t, k)).norm(), 2e-5);
}

std::string says(const TemporaryFolder& folder, const std::string& name, const std::string& bytes) {
  return refusal([&] { read_mesh(folder.write(name, bytes)); });
}

TEST(MeshFile, GivesTheSameTrianglesFromEveryFormat) {
  TemporaryFolder folder;
  const TriangleMesh head = ellipsoid({77, 100, 110}, 12, 8);
  for (const auto& [name, bytes] : every_format(head)) {
    SCOPED_TRACE(name);
    expect_same_triangles(read_mesh(folder.write(name, bytes)), head);
  }
}

TEST(MeshFile, ReadsWhatExportersWriteIntoObj) {
  TemporaryFolder folder;
  const std::string text =
      "# head\nmtllib /etc/passwd\no head\nvn 0 0 1\nvt 0 0\nv 0 0 0 0.5 0.5 0.5\r\nv +100 0 0 # right\nv "
      "1e2 100. 0\n"
      "v 0 .1e3 0\ng top\nusemtl skin\ns off\nf 1/1/1 2//1 \\\n 3 4/1\nl 1 2\nf 1 2\nv 0 0 100\nf -1 -2 1\n";
  const TriangleMesh mesh = read_mesh(folder.write("a.obj", text));
  EXPECT_EQ(mesh.vertices.size(), 5u);
  EXPECT_EQ(mesh.triangles.size(), 3u);
}

TEST(MeshFile, ReadsWhatExportersWriteIntoOff) {
  TemporaryFolder folder;
  const TriangleMesh square = read_mesh(folder.write(
      "a.off", "# c\n\nCOFF 4 2 0\n0 0 0 1 1 1 1\n9 0 0\n\n9 9 0 # c\n0 9 0\n4 0 1 2 3 9 9\n2 0 1\n"));
  EXPECT_EQ(square.vertices.size(), 4u);
  EXPECT_EQ(square.triangles.size(), 2u);
  EXPECT_THAT(says(folder, "a.off", "4 1 0\n0 0 0\n"), HasSubstr("a.off:1:1: is not an OFF file"));
  EXPECT_THAT(says(folder, "a.off", "OFF BINARY\n"), HasSubstr("Export it as text"));
  EXPECT_THAT(says(folder, "a.off", "4OFF\n1 0 0\n"), HasSubstr("other than three dimensions"));
  EXPECT_THAT(says(folder, "a.off", "OFF\n2 1 0\n0 0 0\n1 0 0\n3 0 1 2\n"),
              HasSubstr("a.off:5:7: the corner `2`"));
  EXPECT_THAT(says(folder, "a.off", "OFF\n2 1 0\n0 0 0\n"), HasSubstr("ends where a vertex is expected"));
  EXPECT_THAT(says(folder, "a.off", "OFF\n1 1 0\n0 0 0\n-1 0\n"), HasSubstr("a face of -1 corners"));
}

TEST(MeshFile, CutsTriangleStripsOfPly) {
  TemporaryFolder folder;
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
  const std::string vertices = "0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n";
  const TriangleMesh mesh =
      read_mesh(folder.write("a.ply", head + vertices + "11 0 2 1 3 -1 2 4 3 5 5 -1\n"));
  ASSERT_EQ(mesh.triangles.size(), 4u);
  for (std::size_t t = 0; t < 4; ++t) EXPECT_EQ(area_normal(mesh, t), Eigen::Vector3d(0, 0, 1)) << t;
  EXPECT_THAT(says(folder, "a.ply", head + vertices + "3 0 1 6\n"), HasSubstr("there are only 6"));
  EXPECT_THAT(says(folder, "a.ply", head + vertices + "3 0 1 -2\n"), HasSubstr("-2 is not an index"));
}

TEST(TriangleMesh, IsWoundAlikeAsMostOfItsAreaWas) {
  TriangleMesh mesh = ellipsoid({77, 100, 110}, 12, 8);
  const TriangleMesh whole = joined(mesh);
  std::mt19937 random(3);
  TriangleMesh mixed = whole;
  for (Triangle& t : mixed.triangles)
    if (random() % 3 == 0) std::swap(t[0], t[1]);
  const TriangleMesh mended = wound_alike(mixed);
  ASSERT_EQ(mended.triangles.size(), whole.triangles.size());
  for (std::size_t t = 0; t < whole.triangles.size(); ++t)
    EXPECT_GT(area_normal(mended, t).dot(area_normal(whole, t)), 0) << t;
}

TEST(MeshFile, CutsAConcavePolygonInsideItsOutline) {
  TemporaryFolder folder;
  const std::string arrow = "v 0 0 0\nv 100 100 0\nv 0 20 0\nv -100 100 0\nf 1 2 3 4\n";
  const TriangleMesh mesh = read_mesh(folder.write("a.obj", arrow));
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += area_normal(mesh, t).norm() / 2;
  EXPECT_NEAR(area, 2000, 1e-6);
}

TEST(MeshFile, KeepsHolesShellsAndTrianglesThatAreDoubledDegenerateOrNonManifold) {
  TemporaryFolder folder;
  TriangleMesh mesh = tetrahedron();
  mesh.triangles.pop_back();
  mesh.triangles.push_back(mesh.triangles[0]);
  mesh.triangles.push_back({0, 1, 1});
  mesh.vertices.emplace_back(50, 50, 80);
  mesh.triangles.push_back({1, 2, 4});
  mesh.vertices.insert(mesh.vertices.end(), {{9, 0, 0}, {9, 8, 0}, {9, 8, 7}});
  mesh.triangles.push_back({5, 6, 7});
  for (const auto& [name, bytes] : every_format(mesh)) {
    SCOPED_TRACE(name);
    expect_same_triangles(read_mesh(folder.write(name, bytes)), joined(mesh));
  }
}

TEST(MeshFile, RefusesAVertexThatIsNotFinite) {
  TemporaryFolder folder;
  EXPECT_THAT(says(folder, "a.obj", "v 0 0 0\nv nan 1 0\nv 0 1 0\nf 1 2 3\n"),
              HasSubstr("a.obj:2:3: `nan` is not a coordinate of a vertex"));
  TriangleMesh mesh = tetrahedron();
  mesh.vertices[2].y() = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [name, bytes] : every_format(mesh))
    EXPECT_THAT(says(folder, name, bytes), HasSubstr("finite number")) << name;
  mesh.vertices[2].y() = std::numeric_limits<double>::infinity();
  for (const auto& [name, bytes] : every_format(mesh))
    EXPECT_THAT(says(folder, name, bytes), HasSubstr("finite number")) << name;
}

TEST(MeshFile, RefusesWhatIsNoMesh) {
  TemporaryFolder folder;
  EXPECT_THAT(refusal([&] { read_mesh(folder.path("none.obj")); }), HasSubstr("none.obj: no such file"));
  EXPECT_THAT(refusal([&] { read_mesh(folder.path("head.fbx")); }),
              HasSubstr("Give a file of triangles or polygons: 3MF, GLB, OBJ, OFF, PLY, STEP or STL"));
  for (const auto& [name, bytes] : every_format({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}}))
    EXPECT_THAT(says(folder, name, bytes), HasSubstr("has no triangles")) << name;
  for (const char* name : {"a.obj", "a.stl", "a.ply", "a.off"}) {
    EXPECT_NE(says(folder, name, ""), "") << name;
    EXPECT_NE(says(folder, name, "hello\n"), "") << name;
    EXPECT_NE(says(folder, name, std::string(1000, '\0')), "") << name;
  }
  std::filesystem::resize_file(folder.write("big.stl", "solid"), max_mesh_bytes + 1);
  EXPECT_THAT(refusal([&] { read_mesh(folder.path("big.stl")); }), HasSubstr("at most 256 MiB"));
}

TEST(MeshFile, RefusesCornersThatNameNoVertex) {
  TemporaryFolder folder;
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_THAT(says(folder, "a.obj", vertices + "f 1 2 4\nf 1 2 3\n"), HasSubstr("a.obj:4:7: the corner `4`"));
  EXPECT_THAT(says(folder, "a.obj", vertices + "f 1 2 -4\n"), HasSubstr("a.obj:4:7: the corner `-4`"));
  EXPECT_THAT(says(folder, "a.obj", vertices + "f 1 2 0\n"), HasSubstr("Give vertex indices"));
  EXPECT_THAT(says(folder, "a.obj", vertices + "f 1 2 99999999999999999999\n"),
              HasSubstr("Give vertex indices"));
  TriangleMesh mesh = tetrahedron();
  mesh.triangles[1][2] = 4;
  EXPECT_THAT(says(folder, "a.ply", ply_binary(mesh)), HasSubstr("there are only 4"));
  mesh.triangles[1][2] = -1;
  EXPECT_THAT(says(folder, "a.ply", ply_text(mesh)), HasSubstr("-1 is not an index"));
}

TEST(MeshFile, RefusesCountsThatTheFileCannotHold) {
  TemporaryFolder folder;
  for (const std::string& bytes : {ply_text(tetrahedron()), ply_binary(tetrahedron())})
    for (const std::string element : {"vertex", "face"})
      for (const std::string count :
           {"400", "4000000000", "18446744073709551615", "-4", "99999999999999999999"}) {
        std::string damaged = bytes;
        damaged.replace(damaged.find(element + " 4"), element.size() + 2, element + " " + count);
        EXPECT_NE(says(folder, "a.ply", damaged), "") << element << " " << count;
      }
  std::string stl = stl_binary(tetrahedron());
  stl.replace(80, 4, "\xff\xff\xff\xff");
  EXPECT_THAT(says(folder, "a.stl", stl), HasSubstr("is cut short: 284 bytes for 4294967295 triangles"));
}

TEST(MeshFile, RefusesAFileThatIsCutShortUnlessNothingShowsIt) {
  TemporaryFolder folder;
  const TriangleMesh mesh = ellipsoid({77, 100, 110}, 4, 3);
  for (const auto& [name, bytes] : every_format(mesh)) {
    SCOPED_TRACE(name);
    const bool ends_in_data = name != "a.obj";
    for (std::size_t length = 0; length + 2 < bytes.size(); length += 1 + length / 20) {
      const std::string file = folder.write(name, bytes.substr(0, length));
      const bool accepted = refusal([&] { read_mesh(file); }).empty();
      EXPECT_FALSE(accepted && ends_in_data && length + 20 < bytes.size()) << length;
    }
  }
}

TEST(MeshFile, SurvivesRandomDamage) {
  TemporaryFolder folder;
  std::mt19937 random(5);
  const auto files = every_format(ellipsoid({77, 100, 110}, 6, 4));
  int accepted = 0;
  for (int round = 0; round < 600; ++round) {
    auto [name, bytes] = files[round % files.size()];
    const bool is_text = bytes.find('\0') == std::string::npos;
    for (std::size_t n = 1 + random() % 4; n > 0; --n)
      bytes[random() % bytes.size()] = is_text ? "0123 9\n-/.ef"[random() % 12] : static_cast<char>(random());
    try {
      const TriangleMesh mesh = read_mesh(folder.write(name, bytes));
      for (const auto& p : mesh.vertices) EXPECT_TRUE(p.allFinite());
      ++accepted;
    } catch (const InvalidInput&) {
    }
  }
  EXPECT_GT(accepted, 40);
}

}  // namespace
}  // namespace kinetix::targets
