#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "model/elastic/elastic_system.hpp"
#include "model/lattice/planar/planar_motion.hpp"
#include "model/material/manufactured_hinge.hpp"
#include "tests/support/hard/kit.hpp"
#include "tests/support/miura.hpp"
#include "tests/support/planar_graphs.hpp"
#include "tests/support/random_elastic.hpp"
#include "tests/support/sodalite_arms.hpp"

namespace kinetix::testing {
namespace {

using model::Linkage;

/// Structure with individual hinges under a driven hinge, and a state of it.
struct SameScene {
  Linkage linkage;
  model::LinkageDrive drive;
  model::Elasticity elasticity;
  model::State state;
};

std::vector<int> shuffled_places(std::size_t count, std::mt19937& random) {
  std::vector<int> place(count);
  std::iota(place.begin(), place.end(), 0);
  std::shuffle(place.begin(), place.end(), random);
  return place;
}

/// Returns the scene with bodies and hinges in random order, which must not change the results.
SameScene renumbered(const SameScene& scene, std::mt19937& random) {
  const Linkage& l = scene.linkage;
  const std::vector<int> body = shuffled_places(l.bodies.size(), random),
                         hinge = shuffled_places(l.hinges.size(), random);
  SameScene out = scene;
  for (std::size_t b = 0; b < body.size(); ++b) {
    out.linkage.bodies[body[b]] = l.bodies[b];
    out.state[body[b]] = scene.state[b];
  }
  for (std::size_t h = 0; h < hinge.size(); ++h) {
    model::RestHinge& to = out.linkage.hinges[hinge[h]];
    to = l.hinges[h];
    to.lower = body[to.lower];
    to.upper = body[to.upper];
    if (!scene.elasticity.each.empty()) out.elasticity.each[hinge[h]] = scene.elasticity.each[h];
    for (int k = 0; k < 2; ++k) {
      model::Plate& plate = out.linkage.plates[2 * hinge[h] + k];
      plate = l.plates[2 * h + k];
      plate.body = body[plate.body];
      plate.hinge = hinge[h];
    }
  }
  for (model::LinkageCell& cell : out.linkage.cells) {
    for (int& b : cell.bodies) b = body[b];
    for (int& h : cell.hinges) h = hinge[h];
  }
  out.drive.hinge = hinge[scene.drive.hinge];
  return out;
}

/// Returns the scene turned in space as a whole, at rest and in its state.
SameScene turned_in_space(const SameScene& scene) {
  const Eigen::Matrix3d Q =
      Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const auto turn = [&](Eigen::Vector3d& v) { v = Q * v; };
  SameScene out = scene;
  for (model::LinkageBody& body : out.linkage.bodies) {
    body.spin = Q * body.first_turn();
    turn(body.position);
  }
  for (model::RestHinge& h : out.linkage.hinges)
    for (Eigen::Vector3d* v :
         {&h.edge, &h.across, &h.lower_arm, &h.upper_arm, &h.axis, &h.axis_alpha, &h.axis_beta})
      turn(*v);
  for (model::Plate& plate : out.linkage.plates)
    for (Eigen::Vector3d* v : {&plate.edge, &plate.up, &plate.up_beta}) turn(*v);
  for (model::Pose& pose : out.state) pose = {Q * pose.R * Q.transpose(), Q * pose.p};
  return out;
}

double state_energy(const SameScene& s) {
  const model::ElasticSystem system(s.linkage, s.elasticity, s.drive, false, false);
  return system.elastic_energy(s.state) * energy_unit(s.elasticity, s.linkage.size.edge_mm);
}

double equilibrium_energy(const SameScene& s) {
  LinkageScene scene{{s.linkage, s.drive, {}}, s.elasticity};
  scene.options.planar = false;
  const model::EquilibriumPath path = followed(scene);
  return path.stop == model::EquilibriumPath::Stop::reached ? path.steps.back().energy : NAN;
}

HardAnswer same_energies(const SameScene& scene, const std::function<double(const SameScene&)>& energy) {
  std::mt19937 random(21);
  const double first = energy(scene), other = energy(renumbered(scene, random)),
               turned = energy(turned_in_space(scene));
  const double worst = std::max(std::abs(other / first - 1), std::abs(turned / first - 1));
  return {worst <= 1e-12 ? HardAnswer::Mark::right : HardAnswer::Mark::wrong,
          "the same",
          text("E %.6g N mm, %.1e apart where renumbered, %.1e where turned", first,
               std::abs(other / first - 1), std::abs(turned / first - 1)),
          {}};
}

model::ManufacturedHinge rubber_block() {
  return {.kind = model::HingeKind::block,
          .material = *model::find_material("tango"),
          .gap_mm = 1,
          .thickness_mm = 0.8,
          .height_mm = 6};
}

model::ManufacturedHinge loose_pin() {
  return {.kind = model::HingeKind::pin,
          .material = *model::find_material("pa12"),
          .height_mm = 6,
          .diameter_mm = 1,
          .clearance_mm = 0.1,
          .with_play = true};
}

/// Returns rubber blocks, loose pins and isotropic hinges, in turn.
model::Elasticity hinges_of_three_kinds(std::size_t count) {
  model::Elasticity all;
  const model::Elasticity kinds[] = {elasticity_of(rubber_block()), elasticity_of(loose_pin()), {}};
  for (std::size_t h = 0; h < count; ++h) all.each.push_back(kinds[h % 3]);
  return all;
}

SameScene quads_scene() {
  model::PlanarStructure s = model::make_planar_structure(random_quads(3, 8), {});
  place_hinges(random_redrawing(s, 0.4, 8), s);
  s.hinges[5].t += 0.1;
  return {s, hinge_drive(s, 3, 0.5), hinges_of_three_kinds(s.hinges.size()), rest_state(s)};
}

SameScene miura_scene() {
  const model::PlanarStructure s = miura_of_hexagons(3, 3, 60 * deg, 0.9);
  return {s, hinge_drive(s, 0, 0.6), elasticity_of(rubber_block()), rest_state(s)};
}

SameScene block_scene() {
  const model::SodaliteStructure s =
      block_with_arms({1, 1, 1}, {0.8, 0.7, 0.6, 0.5, 0.75, 0.65}, {10, 0.4, 1});
  return {s, hinge_drive(s, 0, 0.5), {}, rest_state(s)};
}

SameScene shaken_scene(SameScene scene) {
  std::mt19937 random(22);
  scene.state = shaken(scene.linkage, scene.state, 0.3, random);
  return scene;
}

}  // namespace

HardCases linkage_sameness_cases() {
  const char* asked = "same energy to 1e-12";
  HardCases cases;
  struct Named {
    const char* name;
    SameScene (*make)();
  };
  for (const auto& [name, make] :
       {Named{"random quads with blocks, loose pins and stiff hinges", quads_scene},
        Named{"Miura's pattern on hexagons in rubber blocks", miura_scene},
        Named{"block of one cell in space", block_scene}}) {
    cases.push_back({text("%s, shaken, bodies and hinges renumbered, the whole turned in space", name), asked,
                     [make = make] { return same_energies(shaken_scene(make()), state_energy); }});
    cases.push_back({text("equilibrium of %s, renumbered, the whole turned in space", name), asked,
                     [make = make] { return same_energies(make(), equilibrium_energy); }});
  }
  return cases;
}

}  // namespace kinetix::testing
