#include <algorithm>
#include <cmath>

#include "model/base/invalid_input.hpp"
#include "model/closure/closure.hpp"
#include "model/closure/mobility.hpp"
#include "model/elastic/newton.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "tests/support/hard/kit.hpp"
#include "tests/support/sodalite_arms.hpp"

namespace kinetix::testing {
namespace {

using model::SodaliteStructure;
using Arms = std::array<double, 6>;

constexpr model::CellSize block_size = {10, 0.4, 1};  // mm: walls so thin that none is in the way
// Each rotor follows from the one before along some ten bridges per cell, and each bridge adds its rounding.
constexpr double block_closure = 1e-12;                // cell edges, rad
constexpr double rotors_half_round = 90 * deg - 1e-6;  // rad of theta: rotors turn by twice that

// Cell edges, of the six directions: next to none, next to a whole edge, and both at once.
constexpr Arms no_arms = {1e-6, 2e-6, 5e-7, 1e-6, 3e-6, 1e-6},
               hardly_any_arms = {1e-4, 2e-4, 3e-4, 1e-4, 2e-4, 3e-4},
               long_arms = {0.98, 0.97, 0.99, 0.96, 0.98, 0.95},
               mixed_arms = {1e-6, 0.98, 0.5, 0.02, 0.9, 0.3};

double closure_of_block(const SodaliteStructure& block) {
  const model::ExactMotion exact = exact_motion(block);
  if (!exact) return INFINITY;
  double worst = 0;
  for (const double theta : {1e-9, 0.4, rotors_half_round, -rotors_half_round})
    worst = std::max(worst, closure_residual(block, exact.at(theta)).cwiseAbs().maxCoeff());
  return worst;
}

/// Returns the error of edges. Each edge's two hinges are parted by its gusset, and its middle, of arms a, shrinks by a
/// (1 - cos(2 theta)).
double edge_error(const SodaliteStructure& block, double theta) {
  const model::State state = exact_motion(block).at(theta);
  double worst = 0;
  for (std::size_t k = 0; k < block.gussets.size(); ++k) {
    const auto [a, b] = block.gussets[k];
    const Eigen::Vector3d rest = sodalite_place(block, b) - sodalite_place(block, a),
                          now = (state[b].p - state[a].p) / block.size.edge_mm;
    const double arm = block.hinges[2 * k].t / 2;
    worst = std::max(worst, (now - (1 - arm * (1 - std::cos(2 * theta))) * rest).norm());
  }
  return worst;
}

HardAnswer move_block(int n, const Arms& arms, int freedoms) {
  const SodaliteStructure block = block_with_arms({n, n, n}, arms, block_size);
  const double closure = closure_of_block(block), law = edge_error(block, 1.2);
  const int found = null_space(block, exact_motion(block).at(0.4)).dofs();
  HardAnswer a = closed_to(std::max(closure, law), block_closure, "closure and law of edges to");
  a.exact += text(", %d freedoms", found);
  if (found != freedoms) a.mark = HardAnswer::Mark::wrong;
  return a;
}

void add_arms(HardCases& cases) {
  struct Lengths {
    const char* name;
    Arms arms;
  };
  for (const auto& [name, arms] :
       {Lengths{"of 1e-6 of an edge", no_arms}, Lengths{"of 1e-4 of an edge", hardly_any_arms},
        Lengths{"next to half an edge", long_arms}, Lengths{"of 1e-6 to 0.49 edges", mixed_arms}})
    for (const int n : {1, 2, 3}) {
      // In 3^3 cells, rotors with such arms turn together with a gap of only 1e-8. A null space cannot separate that
      // from zero.
      if (arms == no_arms && n == 3) continue;
      HardCase c{text("block of %d^3 cells, six arms %s, to theta = 90 deg - 1e-6 rad", n, name),
                 "closure equations, and edges that keep their direction and shrink by a (1 - cos(2 theta)), "
                 "to 1e-12; "
                 "one freedom",
                 [n, arms = arms] { return move_block(n, arms, 1); }};
      c.in_tests = arms != no_arms || n == 1;  // telling nearly free directions apart takes seconds
      cases.push_back(c);
    }
}

HardAnswer refuse_block(const std::function<void(SodaliteStructure&)>& spoil, const std::string& words) {
  SodaliteStructure block = block_with_arms({1, 1, 1}, mixed_arms, block_size);
  spoil(block);
  const model::ExactMotion exact = exact_motion(block);
  const std::string said = exact ? exact.name + " although hinges disagree" : exact.why;
  return check_distinct(!exact && exact.why.find(words) != std::string::npos, said, "");
}

void add_spoilt(HardCases& cases) {
  for (const double off : {1e-2, 1e-5, 1e-8})
    cases.push_back({text("block of one cell, the arms of one edge off by %g", off),
                     "no closed form: rings do not close", [=] {
                       return refuse_block(
                           [=](SodaliteStructure& s) { s.hinges[0].t += off, s.hinges[1].t += off; },
                           "do not close");
                     }});
  for (const double beta : {1e-1, 1e-6})
    cases.push_back({text("block of one cell, one hinge leant by beta = %g rad", beta),
                     "no closed form: that hinge has not its rotor's axis", [=] {
                       return refuse_block([=](SodaliteStructure& s) { s.hinges[4].beta = beta; }, "axis");
                     }});
  cases.push_back({"block of one cell, one hinge leant by alpha = 0.1 rad",
                   "no closed form: that hinge has not its rotor's axis", [] {
                     return refuse_block([](SodaliteStructure& s) { s.hinges[4].alpha += 0.1; }, "axis");
                   }});
}

/// Runs Newton's method from the closed form. Returns how far its equilibrium is from there, cell edges; NaN if there
/// is none.
double settled_off(const SodaliteStructure& block, double theta, double ratio) {
  model::ElasticSystem system(block, of_ratio(ratio), hinge_drive(block, 0, model::turn_at_theta(1, theta)),
                              false, false);
  const model::State exact = exact_motion(block).at(theta);
  model::State state = exact;
  model::TangentStiffness tangent(system.dofs());
  if (!settle(system, theta, state, tangent)) return NAN;
  return aligned_distance(block, state, exact).rms;
}

/// The flat state has 36 first-order motions, and paths from it need not find the closed form. The search starts from
/// the closed form instead.
HardAnswer settle_block(double theta) {
  const SodaliteStructure block = block_with_arms({2, 2, 2}, {0.8, 0.7, 0.6, 0.5, 0.75, 0.65}, block_size);
  const double soft = settled_off(block, theta, 1e-8), stiff = settled_off(block, theta, 1e-9);
  HardAnswer a;
  if (std::abs(soft / stiff / 10 - 1) <= 0.01) a.mark = HardAnswer::Mark::right;
  a.equilibrium = text("rms %.2e from exact, %.5g times as far", soft, soft / stiff);
  return a;
}

HardAnswer strain_block(double off, double theta) {
  SodaliteStructure block = block_with_arms({1, 1, 1}, {0.8, 0.7, 0.6, 0.5, 0.75, 0.65}, block_size);
  block.hinges[0].t += off;
  block.hinges[1].t += off;
  const LinkageScene scene = {
      {block, hinge_drive(block, 0, model::turn_at_theta(1, theta)), exact_motion(block)}, of_ratio(1e-4)};
  HardAnswer a = follow_strained(scene, 1e-3);
  check_branching(scene, followed(scene), a);
  return a;
}

void add_elastic_blocks(HardCases& cases) {
  cases.push_back({"block of 2^3 cells, six arms, a hinge held at theta = 20 deg, stiffness ratio 1e8",
                   "stable equilibrium 10 times as far from the closed form as of ratio 1e9, to 1 %",
                   [] { return settle_block(20 * deg); }});
  // Flat, one cell has more ways to begin than it has to go on: what a single hinge begins need not be the closed form.
  for (const double off : {0.0, 0.1})
    cases.push_back({text("block of one cell, arms of one edge off by %g, a hinge to theta = 20 deg", off),
                     "work is energy to 1e-3; told where it leaves the closed form",
                     [=] { return strain_block(off, 20 * deg); }});
}

}  // namespace

HardCases block_cases() {
  HardCases cases;
  add_arms(cases);
  add_spoilt(cases);
  add_elastic_blocks(cases);
  return cases;
}

}  // namespace kinetix::testing
