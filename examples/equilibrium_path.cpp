// Compresses a sheet of 4 x 4 cells with elastic hinges between two plates, and prints the force along the
// path.
#include <kinetix/kinetix.hpp>

#include <cmath>
#include <cstdio>

int main() {
  const kinetix::Structure sheet = kinetix::make_structure(kinetix::rectangle(4, 4), {.edge_mm = 10});
  kinetix::Elasticity hinges;
  hinges.k_point = 1000;  // N/mm: resistance of a hinge to being pulled apart
  hinges.k_turn = 0.1;    // N mm/rad: its resistance to turning
  kinetix::Plates plates;
  plates.axis = kinetix::Axis::y;
  plates.compression = 0.1;  // of the 40 mm between the plates

  const kinetix::EquilibriumPath path = kinetix::trace_equilibrium(kinetix::driven(sheet, plates), hinges);

  std::printf("compression   force N   energy N mm\n");
  for (const kinetix::EquilibriumStep& step : path.steps)
    std::printf("%11.4f %9.4f %13.4f\n", step.drive, step.load, step.energy);
  for (const kinetix::PathEvent& event : path.events)
    std::printf("at %.4f: %s\n", event.at.drive, event.what.c_str());

  // This sheet is an exact mechanism: all 40 hinges turn by 2 theta and none stretches, which has a closed
  // form.
  const double theta = std::acos(1 - plates.compression);
  const double energy = 40 * hinges.k_turn * std::pow(2 * theta, 2) / 2;         // N mm
  const double force = 40 * hinges.k_turn * 4 * theta / (40 * std::sin(theta));  // N: d energy / d plate
  std::printf("end of the path: force %.5f N, energy %.5f N mm\n", path.steps.back().load,
              path.steps.back().energy);
  std::printf("closed form: force %.5f N, energy %.5f N mm\n", force, energy);
}
