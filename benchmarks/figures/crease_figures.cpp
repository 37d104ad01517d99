#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "benchmarks/figure.hpp"
#include "benchmarks/stopwatch.hpp"
#include "model/closure/mobility.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/lattice/origami/origami_sheet.hpp"
#include "model/lattice/planar/planar_motion.hpp"
#include "optim/fold/fit_fold.hpp"
#include "sim/physics_run.hpp"
#include "tests/support/creased.hpp"
#include "tests/support/miura.hpp"
#include "tests/support/planar_graphs.hpp"
#include "tests/support/random_mesh.hpp"

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
constexpr double spread = 0.05;  // of lengths and angles: random meshes of 12 x 12 facets still exist
constexpr unsigned seed = 1;     // any: another gives the same orders of magnitude

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

/// Checks a solid found by the search and folded by the closed form and by the physics run.
std::vector<Figure> solid(int index) {
  const std::string& name = targets::solid_names()[index];
  optim::SolidDesign design;
  const double search = seconds([&] { design = optim::fit_solid(targets::named_solid(index), 2, 0, {}); });
  const auto miss = [&](const targets::FoldError& error) {
    double most = 0;
    for (std::size_t c = 0; c < design.net.creases.size(); ++c)
      most = std::max(most, std::abs(to_degrees(error.fold[c] - design.net.creases[c].angle)));
    return most;
  };
  const model::PlanarStructure& s = design.net.structure;
  const bool is_free = !theta_range(s, exact_motion(s), {.limit = design.theta}).positive.touches;
  sim::PhysicsOptions options;
  options.joint_stiffness = 1e8;
  const sim::PhysicsResult run = run_compression(s, drive_to(s, design.theta), options);
  const double in_model = miss(design.error), in_run = miss(solid_error(design.net, run.state, design.theta));
  return {{fmt::format("{} from a flat net: angles of its faces, no wall in the way", name), "<= 1e-6 deg",
           fmt::format("{:.1e} deg, theta {:.0f} deg, {} a crease, walls {}, {:.1f} s", in_model,
                       to_degrees(design.theta), design.net.columns, is_free ? "never meet" : "meet", search),
           design.folds && is_free && in_model <= 1e-6},
          {fmt::format("{} from a flat net: in the physics run, walls in contact", name), "<= 0.1 deg",
           fmt::format("{:.1e} deg ({})", in_run, to_string(run.status)), in_run <= 0.1}};
}

/// Checks a random pattern by the facets and creases that are found again in its sheet.
Figure patterns(int columns, int rows) {
  std::mt19937 random(seed);
  model::QuadMesh mesh = testing::random_mesh(columns, rows, spread, random).mesh;
  const PlanarStructure s = origami_sheet(mesh, {}).structure;
  const double gap = largest_gap(s);
  const int dimension = null_space(s, exact_motion(s).at(theta)).dofs();
  return {fmt::format("random flat-foldable pattern of {} x {} facets as a creased sheet", columns, rows),
          "<= 1e-11 cell edges, 1 way to move",
          fmt::format("{:.1e}, {} ({} bodies)", gap, dimension, s.senses.size()),
          gap <= 1e-11 && dimension == 1};
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
  const int dimension = null_space(miura, exact_motion(miura).at(theta)).dofs();
  figures.push_back(
      {"Miura on 20 x 20 hexagons: ways to move", "1", fmt::format("{}", dimension), dimension == 1});
  figures.push_back(physics(miura));
  for (const int facets : {4, 8, 12}) figures.push_back(patterns(facets, facets));
  for (int k = 0; k < static_cast<int>(targets::solid_names().size()); ++k)
    for (Figure& figure : solid(k)) figures.push_back(std::move(figure));
  return figures;
}

}  // namespace kinetix::bench
