#include <kinetix/optim/fit_curve.hpp>
#include <kinetix/sim/compression_run.hpp>

#include <cstdio>

int main() {
  const kinetix::Curve goal({{0, 0}, {30, 12}, {60, 12}, {90, 0}});
  kinetix::CurveVariables variables;
  variables.columns = 12;
  variables.cell_mm = 9;
  const kinetix::CurveDesign found = kinetix::fit_curve(goal, variables, {});
  std::printf("shape_rms %.3g\n", found.error.rms);

  kinetix::Structure sheet = kinetix::make_structure(kinetix::rectangle(1, 1), {});
  const auto physics = kinetix::run_compression(sheet, kinetix::drive_to(sheet, 0.3));
  std::printf("%s\n", kinetix::to_string(physics.status).c_str());
  const bool fine = found.error.rms < 0.05 && physics.status == kinetix::PhysicsResult::Status::settled;
  return fine ? 0 : 1;
}
