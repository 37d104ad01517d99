#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "benchmarks/figure.hpp"
#include "benchmarks/stopwatch.hpp"
#include "model/closure/null_space.hpp"
#include "model/lattice/planar/planar_drive.hpp"
#include "sim/compression_run.hpp"
#include "tests/support/creased.hpp"
#include "tests/support/miura.hpp"
#include "tests/support/planar_graphs.hpp"

namespace kinetix::bench {
namespace {

using model::PlanarStructure;

/// Largest of hinge points and axes, cell edges and rad.
double largest_gap(const PlanarStructure& s) {
  const model::ExactMotion motion = exact_motion(s);
  if (!motion) return INFINITY;
  double gap = 0;
  for (const double theta : {-1.2, -0.5, 0.05, 0.4, 0.9, 1.4}) {
    const model::HingeGaps gaps = hinge_gaps(s, motion.at(theta));
    gap = std::max({gap, gaps.max, gaps.axis_max});
  }
  return gap;
}

Figure closure(const char* name, const PlanarStructure& s, double most) {
  const double gap = largest_gap(s);
  return {fmt::format("creases on {}: hinges closed at any theta", name),
          fmt::format("<= {:.0e} cell edges", most),
          fmt::format("{:.1e} ({} bodies, {} hinges)", gap, s.senses.size(), s.hinges.size()), gap <= most};
}

constexpr double multiplier =
    0.9;                       // of the zigzags: plates of 60 deg stay apart from each other beyond theta 0.5
constexpr double theta = 0.5;  // rad, of the physics run

Figure physics(const PlanarStructure& s) {
  sim::PhysicsOptions options;
  options.joint_stiffness = 1e8;  // as verification takes it for sheets that never strain
  options.contact = false;
  sim::PhysicsResult run;
  const double time = seconds([&] { run = run_compression(s, drive_to(s, theta), options); });
  const double rms = aligned_distance(s, run.state, exact_motion(s).at(theta)).rms;
  return {"Miura on 20 x 20 hexagons: physics run against the closed form, theta 0.5", "<= 1e-2 cell edges",
          fmt::format("{:.1e} ({}, {:.0f} s)", rms, to_string(run.status), time), rms <= 1e-2};
}

}  // namespace

std::vector<Figure> crease_figures() {
  constexpr double exact = 1e-12;  // cell edges
  const PlanarStructure miura = testing::miura_of_hexagons(20, 20, pi / 3, multiplier);
  std::vector<Figure> figures = {
      closure("20 x 20 hexagons",
              testing::creased(model::lattice_graph(model::honeycomb_lattice, 20, 20)).structure, exact),
      closure("20 x 20 bricks",
              testing::creased(model::lattice_graph(model::brick_lattice, 20, 20)).structure, exact),
      closure("20 x 20 rhombi of 70 deg", testing::creased_rhombi(20, 20, 70 * radians_per_degree), exact),
      closure("20 x 20 random quads with mirrored walls", testing::creased_quads(20, 1), exact),
      closure("20 x 20 hexagons in Miura's pattern", miura, 1e-11)};
  const int freedoms = null_space(miura, exact_motion(miura).at(theta)).dofs();
  figures.push_back(
      {"Miura on 20 x 20 hexagons: ways to move", "1", fmt::format("{}", freedoms), freedoms == 1});
  figures.push_back(physics(miura));
  return figures;
}

}  // namespace kinetix::bench
