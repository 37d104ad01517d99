#include <fmt/format.h>
#include <random>

#include "benchmarks/figure.hpp"
#include "benchmarks/stopwatch.hpp"
#include "model/assembly/tiles.hpp"
#include "model/base/geometry.hpp"
#include "sim/physics_run.hpp"
#include "sim/shapes/convex_cuts.hpp"
#include "sim/shapes/cut_quality.hpp"
#include "tests/support/rotating_squares.hpp"
#include "tests/support/strip_solids.hpp"

namespace kinetix::bench {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using model::Polyhedron;
using testing::box_solid;
using testing::moved;
using testing::ring;
using testing::strip_solid;
using testing::tube;

std::vector<double> evenly(double half, int count) {
  std::vector<double> out;
  for (int k = 0; k <= count; ++k) out.push_back(-half + 2 * half * k / count);
  return out;
}

struct SoftShape {
  Polyhedron solid;
  double half;  ///< of its length, mm
};

std::vector<SoftShape> soft_shapes() {
  const auto fillet = [](double m) {
    return std::abs(m) < 0.6 ? 0.4 : 1.4 - std::sqrt(1 - std::pow(std::abs(m) - 0.6, 2));
  };
  return {{box_solid(-0.5, 0.5, 0.8, 6), 0.5},
          {strip_solid(
               evenly(1.2, 24), [](double m) { return std::sqrt(2.25 - m * m); }, 8),
           1.2},
          {strip_solid(
               evenly(1, 20), [](double m) { return 0.3 + 0.4 * m * m; }, 5),
           1},
          {strip_solid(evenly(1.2, 24), fillet, 6), 1.2}};
}

/// Returns the error of the axis of a soft part between two walls, all of it moved, degrees.
double axis_off(const SoftShape& shape, const Isometry3d& motion) {
  const model::Assembly found =
      model::make_assembly({{"left", false, moved(box_solid(-shape.half - 6, -shape.half, 3, 9), motion)},
                            {"right", false, moved(box_solid(shape.half, shape.half + 6, 3, 9), motion)},
                            {"soft", true, moved(shape.solid, motion)}});
  const Vector3d meant = motion.linear() * Vector3d::UnitZ(), axis = found.hinges[0].axis;
  return to_degrees(std::atan2(meant.cross(axis).norm(), std::abs(meant.dot(axis))));
}

Figure hinge_axes() {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  double worst = 0;
  int count = 0;
  for (const SoftShape& shape : soft_shapes())
    for (int degrees = 0; degrees <= 60; degrees += 5, ++count) {
      const Vector3d about(normal(random), normal(random), normal(random));
      worst = std::max(
          worst,
          axis_off(shape, Isometry3d(Eigen::AngleAxisd(degrees * radians_per_degree, about.normalized()))));
    }
  return {
      fmt::format(
          "Import: axes of boxes, cylinders, hourglasses and fillets, leaning by 0 to 60 degrees, {} models",
          count),
      "within 1 degree", fmt::format("{:.1e} degrees", worst), worst <= 1};
}

/// Returns tubes of a thousand triangles, each with walls of another thickness.
std::vector<Polyhedron> hundred_parts() {
  std::vector<Polyhedron> out;
  for (int k = 0; k < 100; ++k)
    out.push_back(tube(ring(5, 125, true), ring(2 + 0.028 * k, 125, true), 0, 12));
  return out;
}

std::vector<Figure> pieces() {
  const std::vector<Polyhedron> parts = hundred_parts();
  std::vector<std::vector<sim::CutPiece>> found(parts.size());
  const double took = seconds([&] {
    for (std::size_t k = 0; k < parts.size(); ++k) found[k] = sim::convex_cuts(parts[k]);
  });
  double covered = 1, out = 0;
  std::size_t most = 0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const sim::CutQuality quality = measured(found[k], parts[k], 2000);
    covered = std::min(covered, quality.coverage);
    out = std::max(out, quality.sticks_out_mm);
    most = std::max(most, found[k].size());
  }
  return {{"Convex pieces of 100 tubes of 1000 triangles, one core", "<= 10 s", fmt::format("{:.1f} s", took),
           took <= 10},
          {"... how well they cover them, by 2000 points each", ">= 99.9 %, out by <= 0.12 mm, <= 32 a part",
           fmt::format("{:.2f} %, out by {:.3f} mm, {} at most", 100 * covered, out, most),
           covered >= 0.999 && out <= 0.12 && most <= 32}};
}

/// Turns squares until they are furthest apart: by closed states all along, and by the physics run with contact.
std::vector<Figure> squares(int side) {
  const model::TileMake make{.scale_mm = 20, .thickness_mm = 1, .kerf_mm = 0.6};
  const model::TileSheet sheet = testing::rotating_squares(side, side, pi / 4);
  const model::Assembly assembly = assembly_of_tiles(sheet, make);
  const model::Linkage linkage = linkage_of(assembly);
  const model::Pull pull = aligned_pull(linkage, {target_of_tiles(sheet, assembly, make.scale_mm).poses});
  model::Deployment way;
  const double took = seconds([&] { way = deploy(linkage, pull); });
  sim::ContactParts parts;
  for (const model::AssemblyBody& body : assembly.bodies) {
    parts.of_body.emplace_back(1, body.solid.points);
    for (Vector3d& c : parts.of_body.back().front()) c -= body.position;
  }
  sim::PhysicsOptions options;
  options.step_s = 0.01;
  options.joint_stiffness = 1e8;
  options.planar = true;
  const sim::PhysicsResult physics = run_pull(linkage, pull, options, parts);
  const double apart = aligned_distance(linkage, physics.state, way.states.back()).max;
  const bool settled = physics.status == sim::PhysicsResult::Status::settled;
  const std::string what = fmt::format("{} squares turned by 45 degrees", side * side);
  return {{what + ", closed states", "off the closed form by <= 1e-3; 400: 85 s by PyKirigami",
           fmt::format("{} states in {:.2f} s, off by {:.1e}, hinges within {:.1e} edges", way.states.size(),
                       took, way.off_max, way.gap),
           way.reached && way.off_max <= 1e-3 && took <= 85},
          {what + ", physics run with contact", "the same",
           fmt::format("{:.2f} s, off by {:.1e}, hinges within {:.1e} edges", physics.seconds, apart,
                       physics.gaps.max),
           settled && apart <= 1e-3 && physics.seconds <= 85}};
}

}  // namespace

std::vector<Figure> import_figures() {
  std::vector<Figure> all{hinge_axes()};
  for (Figure& figure : pieces()) all.push_back(std::move(figure));
  for (const int side : {10, 20, 40})
    for (Figure& figure : squares(side)) all.push_back(std::move(figure));
  return all;
}

}  // namespace kinetix::bench
