#include <algorithm>
#include <cmath>

#include "model/closure/closure.hpp"
#include "model/hinge/clearance_energy.hpp"
#include "model/lattice/planar/planar_motion.hpp"
#include "model/material/manufactured_hinge.hpp"
#include "tests/support/creased.hpp"
#include "tests/support/hard/kit.hpp"
#include "tests/support/planar_graphs.hpp"
#include "tests/support/played_twist_unit.hpp"

namespace kinetix::testing {
namespace {

using model::PlanarStructure;
using Stop = model::EquilibriumPath::Stop;

model::ManufacturedHinge block_of(const char* material, double gap_mm) {
  return {.kind = model::HingeKind::block,
          .material = *model::find_material(material),
          .gap_mm = gap_mm,
          .thickness_mm = 0.8,
          .height_mm = 6};
}

/// Two half walls and the hinge between them.
PlanarStructure single_wall() { return model::make_planar_structure({{{0, 0}, {1, 0}}, {{0, 1}}}, {}); }

LinkageScene in_space(const PlanarStructure& s, const model::LinkageDrive& drive,
                      const model::Elasticity& e) {
  LinkageScene scene{{s, drive, {}}, e};
  scene.options.planar = false;
  return scene;
}

// Newton's method leaves a turn to 1e-12 rad; the energy is its square.
constexpr double of_one_hinge = 1e-9;

/// E = k turn^2 / 2 and M = k turn, with no gap.
HardAnswer turn_one_hinge(const model::Elasticity& e, double turn) {
  const LinkageScene scene = in_space(single_wall(), hinge_drive(single_wall(), 0, turn), e);
  const model::EquilibriumPath path = followed(scene);
  const double energy = e.k_turn * turn * turn / 2,
               off = std::max(std::abs(path.steps.back().energy / energy - 1),
                              std::abs(path.steps.back().load / (e.k_turn * turn) - 1));
  HardAnswer a = answer(path, path.stop == Stop::reached && off <= of_one_hinge && path.gaps.max <= 1e-9,
                        text("energy and moment by %.1e", off));
  a.exact = text("E %.6g N mm", energy);
  return a;
}

void add_single_hinges(HardCases& cases) {
  for (const double turn : {179.0, 179.9999, -179.9999})
    cases.push_back({text("one wall, hinge of rubber with a frame of its own, turned by %.7g deg", turn),
                     "E = k turn^2 / 2, M = k turn to 1e-9, no gap",
                     [=] { return turn_one_hinge(elasticity_of(block_of("tango", 1)), turn * deg); }});
  cases.push_back(
      {"one wall, film of a nylon with k_turn a million times below its points, turned by 170 deg",
       "E = k turn^2 / 2, M = k turn to 1e-9, no gap", [] {
         model::ManufacturedHinge film = block_of("pa12", 3);
         film.kind = model::HingeKind::film;
         film.thickness_mm = 0.01;
         return turn_one_hinge(elasticity_of(film), 170 * deg);
       }});
}

/// A block turned by all that its material bears is strained by just that.
HardAnswer strain_to_the_edge(const char* material, double part) {
  const model::ManufacturedHinge made = block_of(material, 1);
  const double turn = part * largest_turn(made);
  const LinkageScene scene =
      in_space(single_wall(), hinge_drive(single_wall(), 0, turn), elasticity_of(made));
  const model::EquilibriumPath path = followed(scene);
  const double strained = hinge_strain(made, scene.driven.linkage, path.state, 0),
               off = std::abs(strained / (part * made.material.strain_max) - 1);
  HardAnswer a = answer(path, path.stop == Stop::reached && off <= of_one_hinge,
                        text("strain %.10g, off by %.1e", strained, off));
  a.exact = text("strain %.10g", part * made.material.strain_max);
  return a;
}

void add_strains(HardCases& cases) {
  for (const char* material : {"tango", "pa12"})
    for (const double part : {1 - 1e-6, 1 + 1e-6})
      cases.push_back({text("block of %s turned to %.7g of what it bears", material, part),
                       "strain of an evenly bent fibre, to 1e-9",
                       [=] { return strain_to_the_edge(material, part); }});
}

model::LinkageDrive first_hinge_to(const PlanarStructure& s, double theta) {
  return hinge_drive(s, 0, model::turn_at_theta(s.senses[s.graph.edges[0].from], theta));
}

PlanarStructure quads_with_offsets(int cells, unsigned seed) {
  PlanarStructure s = model::make_planar_structure(random_quads(cells, seed), {});
  place_hinges(random_redrawing(s, 0.5, seed), s);
  return s;
}

// Ratio of the stiffest spring below to the unit of energies, 1000 N/mm (10 mm)^2.
constexpr double stiffest_ratio = 1e-5;

/// Returns springs from 1e-6 to 1 N mm/rad, and points from 1 to 1e6 N/mm. A sheet with an exact motion keeps it with
/// all of them.
model::Elasticity hinges_of_all_stiffnesses(std::size_t count) {
  model::Elasticity all;
  for (std::size_t h = 0; h < count; ++h) {
    model::Elasticity one;
    one.k_point = std::pow(10.0, static_cast<double>((5 * h) % 7));
    one.k_turn = 1e-6 * std::pow(10.0, static_cast<double>((3 * h) % 7));
    all.each.push_back(one);
  }
  return all;
}

HardAnswer fold_in_all_stiffnesses() {
  const PlanarStructure s = quads_with_offsets(3, 6);
  const model::LinkageDrive drive = first_hinge_to(s, 30 * deg);
  return follow_softly(
      [&](double ratio) {
        LinkageScene scene{{s, drive, exact_motion(s)}, hinges_of_all_stiffnesses(s.hinges.size())};
        for (model::Elasticity& e : scene.elasticity.each) e.k_turn *= ratio / stiffest_ratio;
        return scene;
      },
      30 * deg);
}

HardAnswer strain_in_all_stiffnesses() {
  PlanarStructure s = quads_with_offsets(3, 6);
  s.hinges[5].t += 0.1;
  s.hinges[9].t -= 0.1;
  return follow_strained({{s, first_hinge_to(s, 20 * deg), {}}, hinges_of_all_stiffnesses(s.hinges.size())},
                         1e-3);
}

void add_mixed(HardCases& cases) {
  cases.push_back({"3x3 random quads, points of 1 to 1e6 N/mm, springs of 1e-9 to 1e-3 N mm/rad",
                   expected_first_order, fold_in_all_stiffnesses});
  cases.push_back(
      {"3x3 random quads that do not close, points of 1 to 1e6 N/mm, springs of 1e-6 to 1 N mm/rad",
       "work is energy to 1e-3", strain_in_all_stiffnesses});
}

/// Checks springs that rest in the design's folded state: its exact state is an equilibrium without energy.
HardAnswer rest_at_design(const PlanarStructure& s, double theta) {
  const model::ExactMotion exact = exact_motion(s);
  LinkageScene scene{{s, first_hinge_to(s, theta), exact}, {}};
  const model::State design = exact.at(theta);
  for (int h = 0; h < static_cast<int>(s.hinges.size()); ++h) {
    model::Elasticity one = elasticity_of(block_of("tango", 1));
    one.law = std::make_shared<model::SetHinge>(hinge_turn(scene.driven.linkage, design, h));
    scene.elasticity.each.push_back(one);
  }
  const model::EquilibriumPath path = followed(scene);
  const double off = aligned_distance(s, path.state, design).rms,
               left = std::abs(path.steps.back().energy / path.steps.front().energy);
  return answer(path, path.stop == Stop::reached && off <= 1e-8 && left <= 1e-12,
                text("rms %.1e from the design, %.1e of the energy left", off, left));
}

void add_rests(HardCases& cases) {
  const char* asked = "the exact state to 1e-8, no energy left to 1e-12";
  cases.push_back({"3x3 random quads in rubber that rests folded, a hinge to theta = 40 deg", asked,
                   [] { return rest_at_design(quads_with_offsets(3, 7), 40 * deg); }});
  cases.push_back({"3x3 random quads with a crease in rubber that rests folded, a hinge to theta = 40 deg",
                   asked, [] { return rest_at_design(creased_quads(3, 2), 40 * deg); }});
}

/// Returns a twist unit with alpha = 75 deg whose hinge is turned to where it must strain.
LinkageScene half_twisted(double play_mm) {
  const model::Structure unit = paper_twist_unit(75 * deg);
  const model::DrivenLinkage flip = flipping(unit, 12 * deg);
  model::Elasticity pins = played_pins(unit, 0.05);
  pins.play_mm = play_mm;
  return {flip, pins, flip_options()};
}

/// Returns the first-order change of energy by a clearance, N mm. It is the force on the gaps of both points of all
/// hinges, times the clearance that they lose.
double lost_to_play(const LinkageScene& scene, const model::EquilibriumPath& path, double play_mm) {
  const model::Linkage& l = scene.driven.linkage;
  const double edge = l.size.edge_mm;
  double sum = 0;
  for (const model::RestHinge& h : l.hinges)
    for (const double side : {-1.0, 1.0})
      for (const auto& d : resisting_distances(h, relative(scene.elasticity, edge), path.state[h.lower],
                                               path.state[h.upper], edge, side))
        sum += d.weight * d.distance * edge * scene.elasticity.k_point;
  return sum * play_mm;
}

HardAnswer hardly_any_play(double play_mm) {
  const LinkageScene with = half_twisted(play_mm), without = half_twisted(0);
  const model::EquilibriumPath path = followed(with), tight = followed(without);
  const double energy = tight.steps.back().energy, lost = lost_to_play(without, tight, play_mm),
               off = std::abs(path.steps.back().energy - (energy - lost)) / energy;
  // The small stiffness within the clearance adds 1e-5 of the energy.
  const double allowed = 2 * model::loose_stiffness + 4 * std::pow(lost / energy, 2);
  HardAnswer a = answer(path, path.stop == Stop::reached && tight.stop == Stop::reached && off <= allowed,
                        text("energy %.8g N mm, by %.1e", path.steps.back().energy, off));
  a.exact = text("E %.8g N mm without play, less %.2e", energy, lost);
  return a;
}

/// Within their clearance, pins resist only with their small remaining stiffness. It adds at most 1e-5 of the energy
/// over all of the clearance.
HardAnswer flip_freely(double alpha, double play_mm) {
  const model::Structure unit = paper_twist_unit(alpha);
  const model::Elasticity pins = played_pins(unit, play_mm);
  const double needed = flip_play(alpha).upper;
  const double loose = 4 * 2 * 2 * 0.5 * model::loose_stiffness * pins.k_point * play_mm * play_mm,
               turning = 4 * 0.5 * twist_unit_turn * std::pow(pi / 2, 2),
               barrier = flip_barrier(alpha, play_mm);
  HardAnswer a{barrier <= loose + turning ? HardAnswer::Mark::right : HardAnswer::Mark::wrong,
               text("flips freely from a play of %.4g mm", needed),
               text("barrier %.3g N mm, at most %.3g", barrier, loose + turning),
               {}};
  if (needed > play_mm) a.mark = HardAnswer::Mark::wrong;
  return a;
}

void add_clearance_cases(HardCases& cases) {
  for (const double play : {1e-3, 1e-6, 1e-9})
    cases.push_back({text("twist unit of 75 deg, hinge to theta = 12 deg, pins with a play of %g mm", play),
                     "energy without play less force times play, to what is left of stiffness within it",
                     [=] { return hardly_any_play(play); }});
  HardCase free{"twist unit of 70 deg, pins with a play of 0.22 mm, more than its flip needs",
                "flips with no more energy than is left within the play",
                [] { return flip_freely(70 * deg, 0.22); }};
  free.in_tests = false;  // geometry takes seconds
  cases.push_back(free);
  cases.push_back({"twist unit of 75 deg, pins with a play of 0.05 mm, hinge to theta = 12 deg",
                   "work is energy to 1e-3", [] { return follow_strained(half_twisted(0.05), 1e-3); }});
}

HardAnswer strain_blocks_far(double theta) {
  PlanarStructure s = quads_with_offsets(2, 9);
  s.hinges[3].t += 0.05;
  LinkageScene scene{{s, first_hinge_to(s, theta), {}}, elasticity_of(block_of("tango", 1))};
  scene.options.planar = false;
  return follow_strained(scene, 1e-3);
}

}  // namespace

HardCases made_hinge_cases() {
  HardCases cases;
  add_single_hinges(cases);
  add_strains(cases);
  add_mixed(cases);
  add_rests(cases);
  add_clearance_cases(cases);
  for (const double theta : {30.0, 60.0})
    cases.push_back({text("2x2 random quads that do not close in rubber blocks beside their walls, a hinge "
                          "to theta = %g deg",
                          theta),
                     "work is energy to 1e-3", [=] { return strain_blocks_far(theta * deg); }});
  return cases;
}

}  // namespace kinetix::testing
