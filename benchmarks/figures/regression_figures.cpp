#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "benchmarks/figure.hpp"
#include "benchmarks/stopwatch.hpp"
#include "tests/regression/prototypes.hpp"

namespace kinetix::bench {
namespace {

/// Runs the reference for the times of prototypes: work of about half a second that no change of the project touches.
/// It computes Cholesky factors of a dense matrix of 700 rows.
double reference_workload() {
  constexpr int rows = 700, repeats = 40;
  const Eigen::MatrixXd half = Eigen::MatrixXd::NullaryExpr(
      rows, rows, [](Eigen::Index i, Eigen::Index j) { return std::sin(static_cast<double>(i * rows + j)); });
  const Eigen::MatrixXd matrix = half * half.transpose() + Eigen::MatrixXd::Identity(rows, rows);
  double sum = 0;
  for (int k = 0; k < repeats; ++k)
    sum += Eigen::LLT<Eigen::MatrixXd>(matrix + k * Eigen::MatrixXd::Identity(rows, rows))
               .matrixL()(rows - 1, 0);
  return sum;
}

/// Returns the median time over three runs, each over the workload just before and after it.
double time_ratio(const testing::Prototype& prototype) {
  const testing::Scratch scratch;
  const std::string arguments =
      KINETIX_SOURCE "/targets/shapes/" + prototype.target + " --quiet -o " + (scratch / "out").string();
  volatile double kept = 0;
  const auto workload = [&] { return seconds([&] { kept = kept + reference_workload(); }); };
  std::vector<double> ratios;
  double before = workload();
  for (int run = 0; run < 3; ++run) {
    const double time = seconds([&] { testing::kinetix_opt(arguments); });
    const double after = workload();
    ratios.push_back(2 * time / (before + after));
    before = after;
  }
  return median(std::move(ratios));
}

}  // namespace

std::vector<Figure> regression_figures() {
  std::vector<Figure> figures;
  for (const testing::Prototype& prototype : testing::read_prototypes(KINETIX_SOURCE)) {
    const double ratio = time_ratio(prototype);
    figures.push_back({prototype.name + ": whole run of `kinetix-opt`, over a fixed dense workload",
                       fmt::format("<= {:.3g} (was {:.3g})", prototype.slowest_ratio, prototype.time_ratio),
                       fmt::format("{:.3g}", ratio), ratio <= prototype.slowest_ratio});
  }
  return figures;
}

}  // namespace kinetix::bench
