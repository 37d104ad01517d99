#include "tests/support/hard_cases.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "model/closure_drive.hpp"
#include "model/elastic/elastic_system.hpp"
#include "model/invalid_input.hpp"
#include "model/mobility.hpp"
#include "model/wall_contact.hpp"
#include "tests/support/elastic_runs.hpp"
#include "tests/support/paper_scenes.hpp"
#include "tests/support/random_elastic.hpp"

namespace kinetix::testing {
namespace {

using Eigen::Vector3d;
using Kind = PathEvent::Kind;
using Stop = LoadPath::Stop;

constexpr double degree = radians_per_degree;

template <class... Numbers>
std::string text(const char* format, Numbers... numbers) {
  char out[200];
  std::snprintf(out, sizeof out, format, numbers...);
  return out;
}

/// Stiffness ratio k_turn / (k_point L^2) for the default cell of 10 mm.
Elasticity ratio(double value) {
  Elasticity elasticity;
  elasticity.k_turn = value * elasticity.k_point * 100;
  return elasticity;
}

LoadPathOptions fine_steps(bool contact) {
  LoadPathOptions options;
  options.contact = contact;
  options.longest_step = options.first_step = 0.005;
  return options;
}

/// Follows the closed form at a stiffness ratio, and is right within `allowed`.
HardAnswer follow_exact(const Structure& s, const Drive& drive, double stiffness_ratio, double allowed) {
  const LoadPath path = follow_load(s, ratio(stiffness_ratio), drive, without_contact());
  const double error = from_closed_form(s, path);
  return {to_string(path.stop), text("rms %.1e, gap %.1e", error, path.gaps.max),
          path.stop == Stop::reached && error <= allowed,
          ExactRun{s, drive, fold(classify(s), s, drive.theta()), false, path.planar}};
}

HardCase exact_case(std::string name, Structure s, Drive drive, double stiffness_ratio, double allowed,
                    bool fast = true) {
  return {std::move(name), text("closed form, rms <= %.0e at ratio %.0e", allowed, stiffness_ratio),
          [=] { return follow_exact(s, drive, stiffness_ratio, allowed); }, fast};
}

HardCase exact_case(std::string name, const Structure& s, double theta, double stiffness_ratio, double allowed,
                    bool fast = true) {
  return exact_case(std::move(name), s, drive_to(s, theta), stiffness_ratio, allowed, fast);
}

/// Work of the drive on its way, N mm: a path of true balances without jumps stores it all.
double work(const Structure& s, const Drive& drive, const LoadPath& path) {
  double unit = 1;
  if (drive.kind == Drive::Kind::plates) {
    const auto row = [&](Vertex v) { return drive.axis == Axis::x ? v.i : v.j; };
    int low = row(s.bodies.front()), high = low;
    for (const Vertex v : s.bodies) {
      low = std::min(low, row(v));
      high = std::max(high, row(v));
    }
    unit = (high - low) * s.size.edge_mm;
  }
  double sum = 0;
  for (std::size_t k = 1; k < path.steps.size(); ++k)
    sum += (path.steps[k].load + path.steps[k - 1].load) / 2 * (path.steps[k].drive - path.steps[k - 1].drive);
  return sum * unit;
}

HardAnswer balances(const Structure& s, const Drive& drive, const Elasticity& elasticity, double allowed,
                    bool contact = false) {
  const LoadPath path = follow_load(s, elasticity, drive, fine_steps(contact));
  const double energy = path.steps.back().energy, off = std::abs(work(s, drive, path) / energy - 1);
  return {text("%s, gap %.1e, E %.3g N mm", to_string(path.stop).c_str(), path.gaps.max, energy),
          text("work - E: %.1e E", off), path.stop == Stop::reached && off <= allowed, {}};
}

// ---- bifurcations ----

void add_bifurcations(std::vector<HardCase>& cases) {
  for (const double k : {0.49, 0.51, 0.4999, 0.5001, 0.499999, 0.500001, 0.5})
    for (const double phi : {89.9, 90.0})
      cases.push_back(exact_case(text("3x5 grid, k = %.6g, phi = %.4g deg", k, phi), crossable_grid(k),
                                 hinge_drive({{0, 0}, Axis::y}, phi / 2 * degree), 1e-12,
                                 phi == 90.0 ? 5e-3 : 1e-4));
}

// ---- ends of the ranges ----

void add_ends_of_ranges(std::vector<HardCase>& cases) {
  for (const double t : {1e-3, 1 - 1e-3})
    cases.push_back(
        exact_case(text("3x3 grid, t = %g, theta = 30 deg", t), crossable_grid(t, 3, 3), 30 * degree, 1e-8, 1e-4));
  for (const double beta : {89.0, -89.0}) {
    const Structure strip = alternating(6, 1, {.beta = beta * degree}, basic_unit);
    cases.push_back(exact_case(text("strip, beta = %g deg, theta = 10 deg", beta), strip, 10 * degree, 1e-8, 1e-4));
  }
  for (const double alpha : {1.0, 179.0})
    for (const double theta : {0.1, -0.1})
      cases.push_back({text("cell with alpha = %g deg, hinge to theta = %g rad", alpha, theta),
                       "strained; work is energy to 1e-3; as its mirror image to 1e-6", [=] {
                         const auto energy = [](double a, double turn) {
                           const Structure s = alternating(1, 1, {.alpha = a * degree}, basic_unit);
                           return follow_load(s, {}, hinge_drive({{0, 0}, Axis::y}, turn), fine_steps(false));
                         };
                         const Structure s = alternating(1, 1, {.alpha = alpha * degree}, basic_unit);
                         HardAnswer a = balances(s, hinge_drive({{0, 0}, Axis::y}, theta), {}, 1e-3);
                         const double e = energy(alpha, theta).steps.back().energy,
                                      mirrored = energy(180 - alpha, -theta).steps.back().energy;
                         a.diagnosis += text(", mirror image %.1e", std::abs(mirrored / e - 1));
                         a.right = a.right && std::abs(mirrored / e - 1) <= 1e-6;
                         return a;
                       }});
  for (const double r : {1e-4, 1e-6, 1e-8, 1e-10})
    cases.push_back(exact_case(text("bending strip, stiffness ratio %.0e", r), bending_strip(), 30 * degree, r,
                               100 * r));
  for (const double r : {1.0, 1e-2})
    cases.push_back({text("bending strip, stiffness ratio %.0e", r), "strained; work is energy to 1e-3",
                     [=] { return balances(bending_strip(), drive_to(bending_strip(), 30 * degree), ratio(r), 1e-3); }});
}

// ---- near flat ----

/// Until the squeezed walls of a column press as hard as the turning springs resist, 4 N k / (n L), flat stays.
HardAnswer buckling(double over_critical) {
  const int n = 3;
  const Structure s = make_structure(rectangle(n, n), {});
  const Elasticity e;
  const double L = s.size.edge_mm, fold_force = 4.0 * static_cast<double>(s.hinges.size()) * e.k_turn / (n * L);
  const double critical = fold_force / (2 * e.k_point * L * (n + 1));
  Drive drive;
  drive.compression = over_critical * critical;
  const LoadPath path = follow_load(s, e, drive);
  const double turn = std::abs(hinge_turn(s, path.state, *s.hinge_at({{1, 1}, Axis::x})));
  const double free = 2 * std::sqrt(2 * critical * std::max(0.0, over_critical - 1));
  return {text("%s, hinges turn by %.3g rad", to_string(path.stop).c_str(), turn),
          text("expected %.3g", free), path.stop == Stop::reached && std::abs(turn - free) <= 0.05 * free + 1e-9, {}};
}

void add_near_flat(std::vector<HardCase>& cases) {
  for (const Structure& s : {crossable_grid(), bending_strip()})
    cases.push_back({s.cells.size() == 15 ? "3x5 grid, hinge to theta = 1e-6" : "bending strip, hinge to theta = 1e-6",
                     "closed form, rms <= 1e-9", [=] {
                       return follow_exact(s, hinge_drive({{0, 0}, Axis::y}, 1e-6), 1e-6, 1e-9);
                     }});
  cases.push_back({"3x3 panel, plates to theta = 1e-6", "stays flat: far below buckling", [] {
                     const Structure s = make_structure(rectangle(3, 3), {});
                     const LoadPath path = follow_load(s, {}, plates_drive(Axis::y, 1e-6));
                     const double moved = aligned_distance(s, path.state, rest_state(s)).max;
                     return HardAnswer{to_string(path.stop), text("moved %.1e", moved),
                                       path.stop == Stop::reached && moved <= 1e-9, {}};
                   }});
  for (const double over : {0.9, 1.1, 2.0})
    cases.push_back({text("3x3 panel, plates at %g of the buckling compression", over),
                     over < 1 ? "stays flat" : "buckles to the turn of a weakly nonlinear column, 5 %",
                     [=] { return buckling(over); }});
  cases.push_back({"3x3 panel, two exactly opposite imperfections t = 1/2 +- 1e-3",
                   "as the perfect panel to 2e-3; swapped, the same energy to 1e-9", [] {
                     const auto run = [](double d) {
                       Structure s = make_structure(rectangle(3, 3), {});
                       s.hinges[*s.hinge_at({{0, 1}, Axis::x})].parameters.t += d;
                       s.hinges[*s.hinge_at({{2, 2}, Axis::x})].parameters.t -= d;
                       return follow_load(s, {}, plates_drive(Axis::y, 30 * degree));
                     };
                     const Structure perfect = make_structure(rectangle(3, 3), {});
                     const LoadPath one = run(1e-3), other = run(-1e-3);
                     const double rms = from_closed_form(perfect, one),
                                  energy = std::abs(one.steps.back().energy / other.steps.back().energy - 1);
                     return HardAnswer{to_string(one.stop), text("rms %.1e, energies %.1e apart", rms, energy),
                                       one.stop == Stop::reached && rms <= 2e-3 && energy <= 1e-9, {}};
                   }});
}

// ---- large ----

void add_large(std::vector<HardCase>& cases) {
  const Structure basic = make_structure(rectangle(1000, 1), {});
  Structure curl = alternating(1000, 1, {.beta = 0.5 * degree}, basic_unit);
  cases.push_back(exact_case("strip of 1000 basic cells", basic, 30 * degree, 1e-6, 1e-2, false));
  cases.push_back(exact_case("strip of 1000 cells, bending by 0.5 deg and basic", curl, 30 * degree, 1e-6, 1e-2, false));
  cases.push_back(exact_case("panel of 100 x 100 basic cells", make_structure(rectangle(100, 100), {}), 30 * degree,
                             1e-6, 1e-3, false));
}

// ---- mobility other than one ----

Structure two_cells_at_a_corner() { return make_structure({{0, 0}, {1, 1}}, {}); }

/// The driven cell folds as its closed form; the other one goes along as it is.
HardAnswer drive_one_of_two() {
  const Structure s = two_cells_at_a_corner();
  const LoadPath path = follow_load(s, {}, hinge_drive({{0, 0}, Axis::y}, 30 * degree));
  const Mobility m = mobility(s);
  double worst = 0;
  for (std::size_t h = 0; h < s.hinges.size(); ++h) {
    const bool driven_cell = s.hinges[h].wall.from <= Vertex{1, 0} && s.hinges[h].wall.to() <= Vertex{1, 1};
    const double turn = std::abs(hinge_turn(s, path.state, static_cast<int>(h)));
    worst = std::max(worst, std::abs(turn - (driven_cell ? 60 * degree : 0)));
  }
  return {text("%s, %d freedoms", to_string(path.stop).c_str(), m.freedoms_along), text("turns to %.1e rad", worst),
          path.stop == Stop::reached && m.freedoms_along == 2 && worst <= 1e-5, {}};
}

HardAnswer drive_immobile() {
  std::mt19937 random(7);
  const Structure s = random_panel(3, 3, random);
  const Mobility m = mobility(s);
  HardAnswer a = balances(s, hinge_drive({{1, 1}, Axis::y}, 10 * degree), {}, 1e-2);
  a.answer = to_string(m.verdict) + "; " + a.answer;
  a.right = a.right && m.verdict == Verdict::not_mobile;
  return a;
}

void add_mobilities(std::vector<HardCase>& cases) {
  cases.push_back({"cells that do not hang together", "refused", [] {
                     try {
                       make_structure({{0, 0}, {5, 5}}, {});
                     } catch (const InvalidInput& e) {
                       return HardAnswer{"InvalidInput", e.what(), true, {}};
                     }
                     return HardAnswer{"accepted", "", false, {}};
                   }});
  cases.push_back(exact_case("two cells that touch in one corner, plates", two_cells_at_a_corner(),
                             plates_drive(Axis::y, 30 * degree), 1e-6, 1e-4));
  cases.push_back({"two cells that touch in one corner, one driven (M = 2)",
                   "two freedoms; driven cell folds, the other stays flat, 1e-5 rad", drive_one_of_two});
  cases.push_back({"3x3 panel with random hinges (M = 0)", "said to be immobile, strained; work is energy to 1e-2",
                   drive_immobile});
}

// ---- contact ----

HardAnswer overdriven(double theta) {
  const Structure s = make_structure(rectangle(4, 4), {});
  const double limit = closing_theta(s.size);
  const LoadPath path = follow_load(s, {}, plates_drive(Axis::y, theta));
  const PathEvent *contact = first_event(path, Kind::contact), *lock = first_event(path, Kind::lock);
  if (!contact || !lock) return {to_string(path.stop), "no contact or lock reported", false, {}};
  const bool brackets = contact->since <= limit + 2e-3 && contact->at.theta >= limit - 2e-3;
  return {text("%s: %s", to_string(path.stop).c_str(), path.why.c_str()),
          text("contact %.2f to %.2f deg (closed form %.2f), lock at %.2f deg, %.3g N", to_degrees(contact->since),
               to_degrees(contact->at.theta), to_degrees(limit), to_degrees(lock->at.theta), lock->at.load),
          brackets && lock->at.theta <= limit + 10 * degree, {}};
}

void add_contact(std::vector<HardCase>& cases) {
  for (const double theta : {50.0, 80.0})
    cases.push_back({text("4x4 panel, plates to theta = %g deg: past its lock", theta),
                     "contact where the closed form closes; lock, with its load", [=] { return overdriven(theta * degree); }});
  cases.push_back({"3x5 uncrossable grid, hinge to phi = 135 deg", "lock near 87 deg, with its load", [] {
                     const Structure s = uncrossable_grid();
                     const LoadPath path = follow_load(s, {}, drive_to(s, -67.5 * degree));
                     const PathEvent* lock = first_event(path, Kind::lock);
                     return HardAnswer{to_string(path.stop) + ": " + path.why,
                                       lock ? text("lock at phi = %.1f deg, %.3g N mm", 2 * to_degrees(lock->at.theta),
                                                   lock->at.load)
                                            : "no lock",
                                       lock && std::abs(lock->at.theta) <= 46 * degree, {}};
                   }, false});
}

// ---- invariance ----

double energy_of(const Structure& s, const State& state) {
  return ElasticSystem(s, {}, hinge_drive(s.hinges.front().wall, 0.1), false, true).elastic_energy(state);
}

HardAnswer invariance() {
  std::mt19937 random(8);
  const Structure s = random_panel(4, 3, random);
  const State state = shaken(s, rest_state(s), 0.2, random);
  const double energy = energy_of(s, state);

  State turned = state;
  const Eigen::Matrix3d R = Eigen::AngleAxisd(1.1, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  for (Pose& pose : turned) pose = {R * pose.R, R * pose.p + Vector3d(3, -40, 17)};

  Structure shuffled = s;
  std::shuffle(shuffled.hinges.begin(), shuffled.hinges.end(), random);

  auto cells = s.cells;
  for (Cell& cell : cells) cell = {cell.i + 6, cell.j + 3};
  std::shuffle(cells.begin(), cells.end(), random);
  Structure shifted = make_structure(cells, s.size);
  State moved(state.size());
  for (const Hinge& h : s.hinges) {
    const Wall there{{h.wall.from.i + 6, h.wall.from.j + 3}, h.wall.axis};
    shifted.hinges[*shifted.hinge_at(there)].parameters = h.parameters;
  }
  for (std::size_t b = 0; b < state.size(); ++b) {
    const Vertex v{s.bodies[b].i + 6, s.bodies[b].j + 3};
    moved[*shifted.body_at(v)] = {state[b].R, state[b].p + s.size.edge_mm * Vector3d(6, 3, 0)};
  }
  double worst = 0;
  for (const double other : {energy_of(s, turned), energy_of(shuffled, state), energy_of(shifted, moved)})
    worst = std::max(worst, std::abs(other / energy - 1));
  return {text("E %.6g", energy), text("at most %.1e apart", worst), worst <= 1e-12, {}};
}

}  // namespace

std::vector<HardCase> hard_cases() {
  std::vector<HardCase> cases;
  add_bifurcations(cases);
  add_ends_of_ranges(cases);
  add_near_flat(cases);
  add_large(cases);
  add_mobilities(cases);
  add_contact(cases);
  cases.push_back({"panel turned, shifted, its cells and hinges in another order", "same energy to 1e-12", invariance});
  return cases;
}

}  // namespace kinetix::testing
