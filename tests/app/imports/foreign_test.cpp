#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "model/base/geometry.hpp"
#include "sim/shapes/convex_cuts.hpp"
#include "sim/shapes/cut_quality.hpp"
#include "targets/mesh/mesh_file.hpp"
#include "tests/app/program.hpp"

namespace kinetix::testing {
namespace {

using Eigen::Vector3d;

/// Returns the rotation of OpenSCAD: about x, then y, then z.
Eigen::Matrix3d turned() {
  const auto about = [](double degrees, const Vector3d& axis) {
    return Eigen::AngleAxisd(degrees * radians_per_degree, axis);
  };
  return (about(50, Vector3d::UnitZ()) * about(35, Vector3d::UnitY()) * about(20, Vector3d::UnitX()))
      .toRotationMatrix();
}

/// Draws the scene of foreign.scad in two files.
void draw(const Scratch& scratch) {
  for (const std::string part : {"hard", "soft"})
    ASSERT_EQ(
        std::system(("openscad -q -D 'part=\"" + part + "\"' -o " + (scratch / (part + ".stl")).string() +
                     " " KINETIX_SOURCE "/tests/app/imports/foreign.scad 2>/dev/null")
                        .c_str()),
        0)
        << "openscad draws these models; apt install openscad";
}

TEST(ForeignModel, HasItsHingesHoweverItLiesAndInInches) {
  const Scratch scratch;
  draw(scratch);
  const Outcome run =
      kinetix_opt("import --hard " + (scratch / "hard.stl").string() + " --soft " +
                  (scratch / "soft.stl").string() + " --unit in --json -o " + (scratch / "out").string());
  ASSERT_EQ(run.code, 0) << run.err;
  const auto found = nlohmann::json::parse(run.out);
  EXPECT_EQ(found["bodies"], 4);
  struct Meant {
    const char* kind;
    Vector3d axis, point;  // as drawn, mm
  };
  // The block of the window, the rubber sheet at the fixed end of the hollow cylinder, and the clip on the rod.
  const std::vector<Meant> all = {
      {"block", {0, 0, 1}, {0, 0, 0}}, {"block", {0, 1, 0}, {27.5, 0, 0}}, {"pin", {0, 0, 1}, {-36, 0, 0}}};
  ASSERT_EQ(found["hinges"].size(), all.size());
  for (const Meant& meant : all) {
    double least = INFINITY;
    for (const auto& h : found["hinges"]) {
      const Vector3d axis(h["axis"][0].get<double>(), h["axis"][1].get<double>(), h["axis"][2].get<double>());
      const Vector3d point(h["point_mm"][0].get<double>(), h["point_mm"][1].get<double>(),
                           h["point_mm"][2].get<double>());
      if (h["kind"] == meant.kind && axis.cross(turned() * meant.axis).norm() < 1e-3)
        least = std::min(least, (point - turned() * meant.point).norm());
    }
    EXPECT_LT(least, 0.02) << meant.kind << " at " << meant.point.transpose();
  }
}

TEST(ForeignModel, IsCutIntoConvexPiecesThatCoverIt) {
  const Scratch scratch;
  draw(scratch);
  ASSERT_EQ(kinetix_opt("import --hard " + (scratch / "hard.stl").string() + " --soft " +
                        (scratch / "soft.stl").string() + " --unit in -o " + (scratch / "out").string())
                .code,
            0);
  for (int k = 1; k <= 4; ++k) {
    const targets::TriangleMesh mesh =
        targets::read_mesh((scratch / ("out/parts/body_" + std::to_string(k) + ".stl")).string());
    const model::Polyhedron solid{mesh.vertices, mesh.triangles};
    const auto pieces = sim::convex_cuts(solid);
    const sim::CutQuality quality = measured(pieces, solid, 20000);
    EXPECT_GE(quality.coverage, 0.999) << k;
    EXPECT_LE(quality.sticks_out_mm, std::max(0.1, 0.01 * targets::bounds(mesh).sizes().maxCoeff())) << k;
    EXPECT_LE(pieces.size(), 32u) << k;
  }
}

}  // namespace
}  // namespace kinetix::testing
