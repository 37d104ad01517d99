#include <fmt/format.h>

#include "benchmarks/figure.hpp"
#include "benchmarks/stopwatch.hpp"
#include "tests/support/elastic_balance.hpp"

namespace kinetix::bench {
namespace {

Figure adjoint_error() {
  double worst = 0;
  const auto cases = testing::balance_cases(5);
  for (const auto& c : cases) {
    const testing::Balance b = testing::random_balance(c);
    const testing::Differenced differences = testing::differenced_jacobian(b);
    const bool as_meant = b.found && differences.same_contacts && b.contacts.empty() != c.touching;
    const double error = testing::relative_difference_by_groups(
        testing::adjoint_jacobian(b), differences.jacobian, testing::parameter_groups(b));
    worst = std::max(worst, as_meant ? error : INFINITY);
  }
  return {fmt::format("adjoint of the equilibrium against central differences, {} random panels, planar and spatial, "
                      "plates and driven hinge, half of them in contact",
                      cases.size()),
          "<= 1e-6 relative", fmt::format("{:.1e}", worst), worst <= 1e-6};
}

/// A T of cells that scale (k = 0.1) in a panel of basic ones, at 16 % compression.
testing::Balance letter_panel(int cells) {
  Structure s = make_structure(rectangle(cells, cells), {});
  for (Hinge& hinge : s.hinges) {
    const auto [i, j] = hinge.wall.from;
    const int column = 10 * i / cells, row = 10 * j / cells;
    const bool bar = row >= 7 && row <= 8 && column >= 2 && column <= 7, stem = row >= 1 && row < 7 && column >= 4 && column <= 5;
    if (bar || stem) hinge.parameters.t = hinge.wall.from.is_class_a() ? 0.1 : 0.9;
  }
  Drive drive;
  drive.compression = 0.16;
  return testing::balance(s, {}, drive, true);
}

/// Seconds, medians.
struct AdjointTimes {
  double gradient = 0, newton_step = 0;
};

AdjointTimes adjoint_times(const testing::Balance& b, int repeats) {
  ElasticSystem system(b.structure, b.elasticity, b.drive, b.planar, true);
  system.set_multiplier(b.multiplier);
  Tangent tangent(system.freedoms());
  const BalanceGradient gradient{Eigen::VectorXd::Random(system.freedoms().coordinates()), 0, 0};
  double sum = 0;
  const auto newton_step = [&] {
    const Eigen::VectorXd force = system.freedoms().restrict(system.linearise(b.state, b.theta, tangent));
    if (tangent.factorise(0)) sum += tangent.solve(force)[0];
  };
  newton_step();
  const auto adjoint = [&] {
    sum += sensitivity(system, b.elasticity, b.state, b.theta, tangent, gradient).theta;
  };
  return {median_seconds(repeats, 5, adjoint), median_seconds(repeats, 5, newton_step)};
}

Figure adjoint_cost(int cells) {
  const testing::Balance b = letter_panel(cells);
  const AdjointTimes times = adjoint_times(b, 21);
  const double ratio = times.gradient / times.newton_step;
  return {fmt::format("gradient of a letter T in {0} x {0} cells by {1} parameters, over one Newton step", cells,
                      testing::parameter_count(b)),
          "<= 0.25", fmt::format("{:.3f} ({:.2f} ms against {:.2f} ms)", ratio, 1e3 * times.gradient, 1e3 * times.newton_step),
          b.found && ratio <= 0.25};
}

}  // namespace

std::vector<Figure> elastic_figures() { return {adjoint_error(), adjoint_cost(10), adjoint_cost(32)}; }

}  // namespace kinetix::bench
