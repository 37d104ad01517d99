#include <gmock/gmock.h>

#include "app/models/model_file.hpp"
#include "targets/mesh/triangle_mesh.hpp"
#include "tests/app/program.hpp"

namespace kinetix::testing {
namespace {

using ::testing::HasSubstr;

const std::string corpus = KINETIX_SOURCE "/tests/fuzz/corpus/";

TEST(MeshFiles, OfModelsGiveOneMeshAndTheirUnit) {
  const targets::FileMesh glb = app::read_mesh_file(corpus + "glb/box.glb");
  EXPECT_GE(glb.mesh.triangles.size(), 12u);
  EXPECT_EQ(glb.unit_mm, 1000);
  const targets::FileMesh threemf = app::read_mesh_file(corpus + "threemf/package.3mf");
  EXPECT_GE(threemf.mesh.triangles.size(), 4u);
  EXPECT_TRUE(threemf.unit_mm.has_value());
  EXPECT_EQ(app::read_mesh_file(corpus + "obj/walls.obj").unit_mm, std::nullopt);
}

TEST(MeshFiles, OfStepAreSurfacesForRibs) {
  const Scratch scratch;
  const std::string design = scratch.write(
      "one.yaml",
      "kinetix: 1\nstructure: {cells: [2, 1], cell_mm: 20}\n"
      "hinge: {kind: block, material: tango, gap_mm: 2, thickness_mm: 1}\ndesign: {theta_deg: 10}\n");
  const Outcome out = kinetix_opt("export " + design + " --format step -o " + (scratch / "step").string());
  ASSERT_EQ(out.code, 0) << out.err;
  const targets::FileMesh mesh = app::read_mesh_file((scratch / "step/one.step").string());
  EXPECT_EQ(mesh.unit_mm, 1);
  EXPECT_GT(mesh.mesh.triangles.size(), 50u);
  EXPECT_NEAR(bounds(mesh.mesh).sizes().maxCoeff(), 42, 4);
}

TEST(MeshFiles, WithTrianglesWoundEitherWayAreSurfaces) {
  const Scratch scratch;
  std::string off = "OFF\n169 144 0\n";
  for (int y = 0; y < 13; ++y)
    for (int x = 0; x < 13; ++x)
      off += std::to_string(10 * x) + " " + std::to_string(10 * y) + " " +
             std::to_string(30 - 0.4 * ((x - 6) * (x - 6) + (y - 6) * (y - 6))) + "\n";
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 12; ++x) {
      const int a = 13 * y + x;
      const std::array<int, 4> corners = {a, a + 1, a + 14, a + 13};
      const bool is_flipped = (x + 3 * y) % 5 == 0;
      off += "4";
      for (int k = 0; k < 4; ++k) off += " " + std::to_string(corners[is_flipped ? 3 - k : k]);
      off += "\n";
    }
  scratch.write("cap.off", off);
  const Outcome run = kinetix_opt(
      "check " + scratch.write("cap.yaml", "kinetix: 1\ntarget: {kind: surface, mesh: cap.off}\n"));
  EXPECT_EQ(run.code, 0) << run.err;
}

}  // namespace
}  // namespace kinetix::testing
