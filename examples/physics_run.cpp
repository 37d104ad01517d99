// Folds a sheet in the rigid-body engine, which does not use the closed form, and compares the two.
#include <kinetix/kinetix.hpp>

#include <cstdio>

int main() {
  const kinetix::Structure sheet = kinetix::make_structure(kinetix::rectangle(3, 2), {.edge_mm = 10});
  const double theta = 25 * kinetix::radians_per_degree;

  const kinetix::PhysicsResult run =
      kinetix::run_compression(sheet, kinetix::drive_on(sheet, kinetix::drive_to(sheet, theta)));
  std::printf("physics run: %s after %.2f s of simulated time\n", to_string(run.status).c_str(),
              run.simulated_s);

  const kinetix::State exact = fold(kinetix::classify(sheet), sheet, theta);
  const auto distance = kinetix::aligned_distance(sheet, run.state, exact);
  std::printf("distance from the closed form: %.2e mm (rms), hinges open by %.2e mm\n",
              distance.rms * sheet.size.edge_mm, run.gaps.max * sheet.size.edge_mm);
}
