#include <fmt/format.h>

#include "benchmarks/figure.hpp"
#include "benchmarks/stopwatch.hpp"
#include "tests/support/elastic_equilibrium.hpp"
#include "tests/support/paper_scenes.hpp"

namespace kinetix::bench {
namespace {

Figure adjoint_error() {
  double worst = 0;
  const auto cases = testing::equilibrium_cases(5);
  for (const auto& c : cases) {
    const testing::Equilibrium b = testing::random_equilibrium(c);
    const testing::Differenced differences = testing::differenced_jacobian(b);
    const bool as_meant = b.found && differences.same_contacts && b.contacts.empty() != c.touching;
    const double error = testing::relative_difference_by_groups(
        testing::adjoint_jacobian(b), differences.jacobian, testing::parameter_groups(b));
    worst = std::max(worst, as_meant ? error : INFINITY);
  }
  return {fmt::format(
              "adjoint of the equilibrium against central differences, {} random panels, planar and spatial, "
              "plates and driven hinge, half of them in contact",
              cases.size()),
          "<= 1e-6 relative", fmt::format("{:.1e}", worst), worst <= 1e-6};
}

/// Returns the equilibrium of the paper's display of a letter T, k = 0.1, at 16 % compression.
testing::Equilibrium pressed_letter(int cells) {
  return testing::equilibrium(testing::letter_panel(0.1, cells), {}, model::Plates{.compression = 0.16},
                              true);
}

/// Median times, s.
struct AdjointTimes {
  double gradient = 0, newton_step = 0;
};

AdjointTimes adjoint_times(const testing::Equilibrium& b, int repeats) {
  model::ElasticSystem system(b.structure, b.elasticity, drive_on(b.structure, b.drive), b.planar, true);
  system.set_multiplier(b.multiplier);
  model::TangentStiffness tangent(system.dofs());
  const model::EquilibriumGradient gradient{Eigen::VectorXd::Random(system.dofs().coordinates()), 0, 0};
  double sum = 0;
  const auto newton_step = [&] {
    const Eigen::VectorXd force = system.dofs().restrict(system.linearise(b.state, b.theta, tangent));
    if (tangent.factorise(0)) sum += tangent.solve(force)[0];
  };
  newton_step();
  const auto adjoint = [&] {
    sum += sensitivity(system, b.elasticity, b.state, b.theta, tangent, gradient).theta;
  };
  return {median_seconds(repeats, 5, adjoint), median_seconds(repeats, 5, newton_step)};
}

Figure adjoint_cost(int cells) {
  const testing::Equilibrium b = pressed_letter(cells);
  const AdjointTimes times = adjoint_times(b, 21);
  const double ratio = times.gradient / times.newton_step;
  return {fmt::format("gradient of a letter T in {0} x {0} cells by {1} parameters, over one Newton step",
                      cells, testing::parameter_count(b)),
          "<= 0.25",
          fmt::format("{:.3f} ({:.2f} ms against {:.2f} ms)", ratio, 1e3 * times.gradient,
                      1e3 * times.newton_step),
          b.found && ratio <= 0.25};
}

}  // namespace

std::vector<Figure> elastic_figures() { return {adjoint_error(), adjoint_cost(10), adjoint_cost(32)}; }

}  // namespace kinetix::bench
