#include "optim/fit_curve.hpp"

#include "optim/curve_starts.hpp"

namespace kinetix {
namespace {

constexpr double as_good = 1.01;
constexpr double exact = 1e-9;

int gentlest(const CurveFit& fit, const MultiStartResult& search) {
  const int tilts = fit.ties().variables();
  const auto effort = [&](int k) { return search.runs[k].x.head(tilts).cwiseAbs().maxCoeff(); };
  const double limit = as_good * search.best_run().residual_norm + exact;
  int chosen = search.best;
  for (int k = 0; k < static_cast<int>(search.runs.size()); ++k)
    if (search.runs[k].residual_norm <= limit && effort(k) < effort(chosen)) chosen = k;
  return chosen;
}

}  // namespace

CurveDesign fit_curve(const Curve& goal, const CurveVariables& v, const MultiStartOptions& options) {
  const CurveFit fit(goal, make_bend_ties(v.columns, v.per, v.symmetry, v.beta), v.cell_mm, v.theta);
  CurveDesign result;
  result.reach = analyse_reach(fit);
  result.search = multi_start(
      fit, [&](int k, std::uint64_t seed) { return curve_start(fit, k, seed); }, options);
  result.chosen = gentlest(fit, result.search);
  const SolveResult& run = result.search.runs[result.chosen];
  result.design = fit.design(run.x, v.rows);
  State lattice;
  fold(result.design, v.cell_mm, lattice);
  result.midline_mm = midline(lattice, v.rows);
  result.error = curve_error(result.midline_mm, goal);
  return result;
}

}  // namespace kinetix
