#include <algorithm>
#include <cmath>

#include "model/base/invalid_input.hpp"
#include "model/closure/closure.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/closure/mobility.hpp"
#include "model/lattice/planar/planar_motion.hpp"
#include "tests/support/hard/kit.hpp"
#include "tests/support/planar_graphs.hpp"

namespace kinetix::testing {
namespace {

using model::PlanarStructure;
using Stop = model::EquilibriumPath::Stop;

// Tolerance of sums over some tens of walls of length one: a hundred times the rounding of each.
constexpr double planar_closure = 1e-12;             // cell edges
constexpr double next_to_closing = 90 * deg - 1e-6;  // rad

struct NamedPanel {
  const char* name;
  PlanarStructure structure;
};

/// Returns panels with one degree of freedom. Underconstrained lattices have closed boundaries.
std::vector<NamedPanel> stiff_panels() {
  const auto closed = [](const model::PlanarLattice& lattice) {
    return model::make_planar_structure({&lattice, model::lattice_cells(3, 3), 0, true}, {});
  };
  return {{"honeycomb", closed(model::honeycomb_lattice)},
          {"bricks", closed(model::brick_lattice)},
          {"octagons", closed(model::octagon_lattice)},
          {"rhombi of 60 deg",
           model::make_planar_structure(lattice_graph(model::rhombus_lattice, 4, 3, 60 * deg), {})},
          {"random quads", model::make_planar_structure(random_quads(3, 4), {})}};
}

double worst_closure(const model::Linkage& linkage, const model::ExactMotion& exact,
                     const std::vector<double>& thetas) {
  double worst = exact ? 0 : INFINITY;
  if (!exact) return worst;
  for (const double theta : thetas)
    worst = std::max(worst, closure_residual(linkage, exact.at(theta)).cwiseAbs().maxCoeff());
  return worst;
}

/// @param allowed cell edges, rad
HardAnswer close_at(const PlanarStructure& s, const std::vector<double>& thetas, double allowed) {
  HardAnswer a = closed_to(worst_closure(s, exact_motion(s), thetas), allowed, "closure equations to");
  if (!exact_motion(s)) a.exact = exact_motion(s).why;
  return a;
}

PlanarStructure with_hinges_anywhere(PlanarStructure s, unsigned seed) {
  place_hinges(random_redrawing(s, 0.5, seed), s);
  return s;
}

void add_closing(HardCases& cases) {
  for (const NamedPanel& panel : stiff_panels())
    cases.push_back(
        {text("%s, hinges anywhere, theta = 90 deg - 1e-6 rad", panel.name), "closure equations to 1e-12",
         [s = panel.structure] {
           return close_at(with_hinges_anywhere(s, 11), {next_to_closing, -next_to_closing}, planar_closure);
         }});
}

// Walls of growing_squares(7, 8) are 1 to 8^6 long; a face of the longest ones rounds by 1e-16 of their length.
constexpr double longest_wall = 262144;  // cell edges

HardAnswer close_growing() {
  PlanarStructure s = model::make_planar_structure(growing_squares(7, 8), {});
  for (std::size_t h = 0; h < s.hinges.size(); ++h) {
    const auto [from, to] = s.graph.edges[h];
    const Eigen::Vector2d at = s.graph.vertices[from];
    const bool along_x = s.graph.vertices[to].y() == at.y();
    const double s_of_line =
        0.9 * std::sin(1 + std::log(1 + 7 * (along_x ? at.x() : at.y())) + (along_x ? 0 : 2));
    s.hinges[h].t = (1 + s.senses[from] * s_of_line) / 2;
  }
  return close_at(s, {1e-6, 0.7, next_to_closing}, planar_closure * longest_wall);
}

HardAnswer close_near_wall_ends(double t) {
  PlanarStructure s = model::make_planar_structure(lattice_graph(model::rhombus_lattice, 5, 4, 70 * deg), {});
  for (std::size_t h = 0; h < s.hinges.size(); ++h)
    s.hinges[h].t = s.senses[s.graph.edges[h].from] > 0 ? t : 1 - t;
  return close_at(s, {1e-6, 0.7, next_to_closing}, planar_closure);
}

HardAnswer close_one_row(const model::PlanarLattice& lattice) {
  const PlanarStructure s = model::make_planar_structure(lattice_graph(lattice, 40, 1, 50 * deg), {});
  // A row of 40 cells adds up the rounding of 80 walls.
  return close_at(with_hinges_anywhere(s, 12), {1e-6, 0.7, next_to_closing}, 10 * planar_closure);
}

void add_distorted(HardCases& cases) {
  cases.push_back({"squares with walls of 1 to 2.6e5 cell edges, all t different",
                   "closure equations to 1e-12 of the longest wall", close_growing});
  for (const double angle : {0.5, 179.5})
    cases.push_back(
        {text("rhombi of %g deg, hinges anywhere", angle), "closure equations to 1e-12", [=] {
           const PlanarStructure s =
               model::make_planar_structure(lattice_graph(model::rhombus_lattice, 4, 3, angle * deg), {});
           return close_at(with_hinges_anywhere(s, 13), {1e-6, 0.7, next_to_closing}, planar_closure);
         }});
  for (const double t : {1e-9, 1 - 1e-9})
    cases.push_back({text("rhombi of 70 deg, hinges at t = %.10g", t), "closure equations to 1e-12",
                     [=] { return close_near_wall_ends(t); }});
  for (const auto& [name, lattice] :
       {std::pair("honeycombs", &model::honeycomb_lattice), {"octagons", &model::octagon_lattice}})
    cases.push_back({text("one row of 40 %s, hinges anywhere", name), "closure equations to 1e-11",
                     [lattice = lattice] { return close_one_row(*lattice); }});
}

/// Checks that a panel that does not close at one hinge has neither a closed form nor mobility.
HardAnswer nearly_closed(double off, double unit) {
  model::PlanarGraph graph = random_quads(3, 5);
  for (Eigen::Vector2d& p : graph.vertices) p *= unit;
  PlanarStructure s = model::make_planar_structure(graph, {10 / unit, 0.8, 6});
  const model::Mobility whole = mobility(s, exact_motion(s));
  const bool whole_moves =
      exact_motion(s) && whole.verdict == model::Verdict::mobile && whole.dofs_along == 1;
  s.hinges[7].t += off;
  const model::ExactMotion exact = exact_motion(s);
  const model::Mobility m = mobility(s, exact);
  return check_distinct(whole_moves && !exact && m.verdict == model::Verdict::not_mobile, exact.why,
                        text("closed panel: %s, this one: %s, %s", to_string(whole.verdict).c_str(),
                             to_string(m.verdict).c_str(), m.why.c_str()));
}

void add_mobility(HardCases& cases) {
  const char* asked = "a closed form and one freedom without that error, neither with it";
  for (const double off : {1e-2, 1e-5, 1e-7})
    cases.push_back(
        {text("3x3 random quads, one t off by %g", off), asked, [=] { return nearly_closed(off, 1); }});
  for (const double unit : {1e-3, 1e3})
    cases.push_back({text("3x3 random quads drawn in walls of %g cell edges, one t off by 1e-5", unit), asked,
                     [=] { return nearly_closed(1e-5, unit); }});
}

LinkageScene driven_to(const PlanarStructure& s, const model::LinkageDrive& drive, double ratio) {
  return {{s, drive, exact_motion(s)}, of_ratio(ratio)};
}

double from_exact(const LinkageScene& scene, const model::EquilibriumPath& path, double theta) {
  return aligned_distance(scene.driven.linkage, path.state, scene.driven.exact.at(theta)).rms;
}

/// Returns the axis along which plates find two lines to grip.
model::Axis plates_axis(const PlanarStructure& s) {
  const auto rows = [&](model::Axis axis) { return boundary_rows(s, axis); };
  try {
    rows(model::Axis::y);
    return model::Axis::y;
  } catch (const InvalidInput&) {
    return model::Axis::x;
  }
}

model::LinkageDrive between_boundary_rows(const PlanarStructure& s, double theta) {
  return plate_drive(s, plates_axis(s), 1 - std::cos(theta), theta < 0 ? -1 : 1);
}

/// Returns the drive of the first wall.
model::LinkageDrive first_wall(const PlanarStructure& s, double theta) {
  return hinge_drive(s, 0, model::turn_at_theta(s.senses[s.graph.edges[0].from], theta));
}

/// Returns whether a closed boundary leaves a lattice one degree of freedom. Such panels are stiff enough between
/// plates, but not at every single wall.
bool has_closed_boundary(const NamedPanel& panel) {
  return panel.structure.drawn.lattice && panel.structure.drawn.closed_boundary;
}

/// Returns how nearly a second motion begins along the closed form: the smallest singular value except that of the
/// motion itself.
double least_other(const PlanarStructure& s, const model::ExactMotion& exact, double theta) {
  double least = INFINITY;
  for (double at = deg; at <= theta; at += deg)
    least = std::min(least, null_space(s, exact.at(at)).smallest_other);
  return least;
}

/// Follows a panel driven at one wall. If a second motion begins during the motion, the panel may leave its closed
/// form. It then has less energy, and the path reports the departure.
HardAnswer follow_one_wall(const PlanarStructure& s, double theta) {
  const LinkageScene scene = driven_to(s, first_wall(s, theta), 1e-6);
  HardAnswer a = follow_strained(scene, 1e-3);
  const model::EquilibriumPath path = followed(scene);
  const double whole = turning_energy(scene, scene.driven.exact.at(theta));
  a.exact = text("E %.4g N mm, a second motion within %.0e of free on the way", whole,
                 least_other(s, scene.driven.exact, theta));
  const model::PathEvent* left = first_event(path, model::PathEvent::Kind::departure);
  const model::EquilibriumStep& judged = left ? left->at : path.steps.back();
  if (!(judged.energy <= turning_energy(scene, scene.driven.exact.at(judged.theta)) * (1 + 1e-9)))
    a.mark = HardAnswer::Mark::wrong;
  if (path.stop != Stop::reached && !path.why.empty()) a.mark = HardAnswer::Mark::diagnosed;
  check_branching(scene, path, a);
  return a;
}

void add_soft_hinges(HardCases& cases) {
  for (const NamedPanel& panel : stiff_panels()) {
    const bool plates = has_closed_boundary(panel);
    cases.push_back(
        {text("%s, %s to theta = 30 deg, stiffness ratio 1e8", panel.name, plates ? "plates" : "hinge"),
         expected_first_order, [s = panel.structure, plates] {
           const auto drive = plates ? between_boundary_rows(s, 30 * deg) : first_wall(s, 30 * deg);
           return follow_softly([&](double ratio) { return driven_to(s, drive, ratio); }, 30 * deg);
         }});
    if (plates)
      cases.push_back(
          {text("%s, hinge to theta = 30 deg, stiffness ratio 1e6", panel.name),
           "work is energy to 1e-3; told where it leaves the closed form, with less energy than that, or "
           "ended with a reason",
           [s = panel.structure] { return follow_one_wall(s, 30 * deg); }});
  }
}

/// Work of plates on a panel that shrinks by cos(theta): N springs of k (2 theta)^2 / 2 over the height H.
double force_of_plates(const LinkageScene& scene, double height_mm, double theta) {
  const double hinges = static_cast<double>(scene.driven.linkage.hinges.size());
  return 4 * hinges * scene.elasticity.k_turn * theta / (height_mm * std::sin(theta));
}

HardAnswer buckle_either_way(const PlanarStructure& s, double theta) {
  const double ratio = 1e-8;
  const LinkageScene one = driven_to(s, between_boundary_rows(s, theta), ratio),
                     other = driven_to(s, between_boundary_rows(s, -theta), ratio);
  const auto& rows = one.driven.drive.gripped;
  const int along = component(one.driven.drive.axis);
  const double height = one.driven.linkage.rest_position(rows[1][0])[along] -
                        one.driven.linkage.rest_position(rows[0][0])[along];
  const double expected = force_of_plates(one, height, theta);
  const model::EquilibriumPath up = followed(one), down = followed(other);
  const double off = std::max(from_exact(one, up, theta), from_exact(other, down, -theta)),
               force = std::max(std::abs(up.steps.back().load / expected - 1),
                                std::abs(down.steps.back().load / expected - 1));
  HardAnswer a = answer(up,
                        up.stop == Stop::reached && down.stop == Stop::reached && down.steps.back().stable &&
                            off <= 1e-4 && force <= 1e-2,
                        text("rms %.1e from exact on both sides, force by %.1e", off, force));
  a.exact = text("force %.4g N", expected);
  return a;
}

HardAnswer stay_in_place(const PlanarStructure& s, double compression) {
  const LinkageScene scene = driven_to(s, plate_drive(s, plates_axis(s), compression, 1), 1e-4);
  const model::EquilibriumPath path = followed(scene);
  const double moved = std::abs(mean_theta(scene.driven.linkage, path.state));
  return answer(path, path.stop == Stop::reached && moved <= 1e-9 && path.gaps.max <= compression + 1e-12,
                text("turned by %.1e rad", moved));
}

void add_plates(HardCases& cases) {
  for (const NamedPanel& panel : stiff_panels()) {
    if (std::string(panel.name) == "random quads") continue;
    const PlanarStructure& s = panel.structure;
    cases.push_back(
        {text("%s between plates, buckled to theta = 3 deg to either side, stiffness ratio 1e8", panel.name),
         "closed form of each side, rms <= 1e-4; force of the closed form to 1 %",
         [=] { return buckle_either_way(s, 3 * deg); }});
  }
  const PlanarStructure honeycomb = stiff_panels()[0].structure;
  for (const double compression : {0.0, 1e-9})
    cases.push_back({text("honeycomb, plates to a compression of %g, stiffness ratio 1e4", compression),
                     "far below buckling: no hinge turns by 1e-9 rad",
                     [=] { return stay_in_place(honeycomb, compression); }});
}

HardAnswer turn_far(const PlanarStructure& s, double theta) {
  const LinkageScene scene = driven_to(s, first_wall(s, theta), 1e-8);
  const model::EquilibriumPath path = followed(scene);
  const double off = from_exact(scene, path, theta);
  HardAnswer a = answer(path, path.stop == Stop::reached && off <= 1e-4, text("rms %.1e from exact", off));
  a.exact = text("E %.4g N mm", turning_energy(scene, scene.driven.exact.at(theta)));
  return a;
}

/// Checks that energy over k_point L^2 does not depend on size.
HardAnswer resize(double edge_mm) {
  const auto part = [](double edge) {
    PlanarStructure s = with_hinges_anywhere(stiff_panels()[0].structure, 14);
    s.size = {edge, 0.08 * edge, 0.6 * edge};
    model::Elasticity e{1000, 1e-6 * 1000 * edge * edge, 0.18 * edge, 1e4};
    const model::EquilibriumPath path =
        followed(LinkageScene{{s, hinge_drive(s, 0, 0.8), exact_motion(s)}, e});
    return std::pair(path, path.steps.back().energy / (1000 * edge * edge));
  };
  const auto [path, energy] = part(edge_mm);
  const double off = std::abs(energy / part(10).second - 1);
  return answer(path, path.stop == Stop::reached && off <= 1e-9, text("energy differs by %.1e", off));
}

void add_far_and_sizes(HardCases& cases) {
  for (const NamedPanel& panel : stiff_panels())
    if (!has_closed_boundary(panel))
      cases.push_back({text("%s, hinge to theta = 80 deg, stiffness ratio 1e8", panel.name),
                       "closed form, rms <= 1e-4", [s = panel.structure] { return turn_far(s, 80 * deg); }});
  for (const double edge : {1e-3, 1e6})
    cases.push_back({text("honeycomb with hinges anywhere, cells of %g mm", edge),
                     "energy over k_point L^2 of cells of 10 mm, to 1e-9", [=] { return resize(edge); }});
}

}  // namespace

HardCases planar_lattice_cases() {
  HardCases cases;
  add_closing(cases);
  add_distorted(cases);
  add_mobility(cases);
  add_soft_hinges(cases);
  add_plates(cases);
  add_far_and_sizes(cases);
  return cases;
}

}  // namespace kinetix::testing
