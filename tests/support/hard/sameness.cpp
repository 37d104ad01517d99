#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "tests/support/hard/kit.hpp"
#include "tests/support/paper_scenes.hpp"
#include "tests/support/random_elastic.hpp"

namespace kinetix::testing {
namespace {

using Eigen::Vector3d;
using Mark = HardAnswer::Mark;

model::State turned_over(const model::State& state) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(1.1, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  model::State all = state;
  for (model::Pose& pose : all) pose = {R * pose.R, R * pose.p + Vector3d(3, -40, 17)};
  return all;
}

model::Structure with_hinges_shuffled(const model::Structure& s, std::mt19937& random) {
  std::vector<int> place(s.hinges.size());
  for (std::size_t h = 0; h < place.size(); ++h) place[h] = static_cast<int>(h);
  std::shuffle(place.begin(), place.end(), random);
  model::Structure all = s;
  for (std::size_t h = 0; h < place.size(); ++h) all.hinges[place[h]] = s.hinges[h];
  for (model::CellHinges& cell : all.cell_members)
    for (int& h : cell.hinges) h = place[h];
  return all;
}

// Cells by which a sheet is built elsewhere on the lattice: even together, so that each vertex keeps its
// class.
constexpr int right = 6, up = 4;

model::Wall elsewhere(const model::Wall& wall) {
  return {{wall.from.i + right, wall.from.j + up}, wall.axis};
}

model::Structure built_elsewhere(const model::Structure& s, std::mt19937& random) {
  auto cells = s.cells;
  for (model::Cell& cell : cells) cell = {cell.i + right, cell.j + up};
  std::shuffle(cells.begin(), cells.end(), random);
  model::Structure all = make_structure(cells, s.size);
  for (const model::Hinge& h : s.hinges)
    all.hinges[*all.hinge_at(elsewhere(h.wall))].parameters = h.parameters;
  return all;
}

model::State elsewhere(const model::Structure& s, const model::State& state, const model::Structure& other) {
  model::State all(state.size());
  for (std::size_t b = 0; b < state.size(); ++b)
    all[*other.body_at({s.bodies[b].i + right, s.bodies[b].j + up})] = {
        state[b].R, state[b].p + s.size.edge_mm * Vector3d(right, up, 0)};
  return all;
}

HardAnswer compared(double energy, const std::vector<double>& others) {
  double worst = 0;
  for (const double other : others) worst = std::max(worst, std::abs(other / energy - 1));
  return {worst <= 1e-12 ? Mark::right : Mark::wrong,
          "the same",
          text("E %.6g N mm, at most %.1e apart", energy, worst),
          {}};
}

HardAnswer compare_state_energies() {
  std::mt19937 random(8);
  const model::Structure s = random_panel(4, 3, random);
  const model::State state = shaken(s, rest_state(s), 0.2, random);
  const auto energy = [](const model::Structure& other, const model::State& there) {
    return energy_of({other, hinge_drive(other, other.hinges.front().wall, 0.1), {}, true}, there);
  };
  const model::Structure shuffled = with_hinges_shuffled(s, random), far = built_elsewhere(s, random);
  return compared(energy(s, state), {energy(s, turned_over(state)), energy(shuffled, state),
                                     energy(far, elsewhere(s, state, far))});
}

/// @param drive_of the drive of a sheet that is built where it was, or elsewhere
HardAnswer energies_of_equilibria(
    const model::Structure& s,
    const std::function<model::Drive(const model::Structure&, bool is_elsewhere)>& drive_of) {
  std::mt19937 random(9);
  const auto energy = [&](const model::Structure& other, bool is_elsewhere) {
    return followed({other, drive_of(other, is_elsewhere), {}, true}).steps.back().energy;
  };
  return compared(energy(s, false),
                  {energy(with_hinges_shuffled(s, random), false), energy(built_elsewhere(s, random), true)});
}

model::Drive between_flat_plates(const model::Structure&, bool) {
  return plates_drive(model::Axis::y, 30 * deg);
}

model::Drive at_one_hinge(const model::Structure& s, bool is_elsewhere) {
  const model::Wall wall{{1, 1}, model::Axis::y};
  return hinge_drive(s, is_elsewhere ? elsewhere(wall) : wall, 0.15);
}

}  // namespace

HardCases sameness_cases() {
  const char* asked = "same energy to 1e-12";
  return {
      {"shaken panel turned, shifted, its cells and hinges in another order", asked, compare_state_energies},
      {"equilibrium of the bending strip, cells elsewhere and hinges in another order", asked,
       [] { return energies_of_equilibria(bending_strip(), between_flat_plates); }},
      {"equilibrium of a panel with random hinges, cells elsewhere and hinges in another order", asked, [] {
         std::mt19937 random(10);
         return energies_of_equilibria(random_panel(3, 3, random), at_one_hinge);
       }}};
}

}  // namespace kinetix::testing
