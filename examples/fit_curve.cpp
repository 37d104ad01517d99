// Designs a strip of cells that folds into a half circle of 60 mm radius, and prints its parameters.
#include <kinetix/kinetix.hpp>

#include <cmath>
#include <cstdio>
#include <vector>

int main() {
  const double radius_mm = 60;
  std::vector<Eigen::Vector2d> points;  // (x, z), mm
  for (int k = 0; k <= 60; ++k) {
    const double angle = k * kinetix::pi / 60;
    points.emplace_back(-radius_mm * std::cos(angle), radius_mm * std::sin(angle));
  }
  const kinetix::Curve goal(points);

  kinetix::CurveVariables variables;
  variables.columns = 20;
  variables.cell_mm = 11;  // more than the curve's length over the columns: folding shortens the strip

  const kinetix::CurveDesign found = kinetix::fit_curve(goal, variables, {});

  std::printf("fold angle %.2f deg\n", kinetix::to_degrees(found.design.theta));
  std::printf("off the half circle by %.4f mm (rms)\n", found.error.rms * found.error.scale_mm);
  std::printf("tilt of the walls of each column, deg:");
  for (const double beta : found.design.beta) std::printf(" %.2f", kinetix::to_degrees(beta));
  std::printf("\n");
}
