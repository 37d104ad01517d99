#include "optim/curve/fit_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "model/base/invalid_input.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/lattice/square/family/classify.hpp"
#include "optim/curve/curve_starts.hpp"

namespace kinetix::optim {
namespace {

constexpr double as_good = 1.01;  // times the least |r|: up to here, the gentlest tilts decide
constexpr double exact = 1e-9;    // of the goal's diagonal, added: a goal met exactly leaves rounding alone
constexpr double gentler = 0.6;   // times the tilts before: few tries lead from 60 deg to gentle ones
constexpr double gentle_growth = 1.3;  // times the error: what gentle tilts may cost
constexpr int gentle_starts = 2;       // for each tighter limit: the smoothest layout and the even one
constexpr double steep_tilt = 15 * radians_per_degree;  // rad: designs that tilt less are left as they are
constexpr double narrowing = 0.8;    // times the limit at which walls collide, at the least, for the next
constexpr int most_narrowings = 10;  // searches: 0.8^10 is a tenth of the first tilts
constexpr double worst_growth = 10;  // times the error: beyond, the design is no longer of the goal's shape

void check_at_least(const char* field, int value, int least) {
  if (value < least) throw InvalidInput(fmt::format("{} is {}, must be at least {}", field, value, least));
}

/// Both limits excluded.
void check_range(const char* field, const AngleRange& range, double lowest, double highest) {
  if (lowest < range.lower && range.lower < range.upper && range.upper < highest) return;
  throw InvalidInput(
      fmt::format("{} is [{}, {}] rad, must be [lower, upper] with {:.4g} < lower < upper < {:.4g}", field,
                  range.lower, range.upper, lowest, highest));
}

int gentlest(const CurveFit& fit, const MultiStartResult& search) {
  const int tilts = fit.ties().variables();
  const auto effort = [&](int k) { return search.runs[k].x.head(tilts).cwiseAbs().maxCoeff(); };
  const double limit = as_good * search.best_run().residual_norm + exact;
  if (!std::isfinite(limit)) return search.best;
  int chosen = search.best;
  for (int k = 0; k < static_cast<int>(search.runs.size()); ++k)
    if (search.runs[k].residual_norm <= limit && effort(k) < effort(chosen)) chosen = k;
  return chosen;
}

/// Theta at which the walls of the design meet; the design's own theta or more where they do not.
model::ThetaLimit first_contact(const model::ExactDesign<double>& design, const model::CellSize& size) {
  const model::Structure structure = sheet_of(design, size);
  model::ThetaRangeOptions options;
  options.limit = design.theta;
  return theta_range(structure, exact_motion(structure), options).positive;
}

void keep_below_closing(CurveVariables& v, const model::CellSize& size, std::vector<std::string>& notes) {
  const double closing = closing_theta(size) - model::closing_margin;
  if (!(v.theta.upper > closing)) return;
  if (!(v.theta.lower < closing))
    throw InvalidInput(
        fmt::format("walls of {} mm in cells of {} mm close at theta {:.1f} deg, below the range asked for",
                    size.thickness_mm, size.edge_mm, to_degrees(closing)));
  v.theta.upper = closing;
  notes.push_back(fmt::format("theta kept below {:.2f} deg, where walls of {:.3g} mm close the cells",
                              to_degrees(closing), size.thickness_mm));
}

AngleRange narrowed(const AngleRange& range, double limit) {
  return {std::max(range.lower, -limit), std::min(range.upper, limit)};
}

double largest_tilt(const model::ExactDesign<double>& design) {
  double largest = 0;
  for (const double beta : design.beta) largest = std::max(largest, std::abs(beta));
  return largest;
}

/// Small tilts print better. Where the goal's coarseness makes the search tilt steeply for a little less
/// error, tries tighter limits and keeps the tightest that costs next to nothing.
void make_gentle(const targets::Curve& goal, const CurveVariables& v, MultiStartOptions options,
                 CurveDesign& design) {
  const double acceptable = gentle_growth * design.error.rms;
  options.starts = std::min(options.starts, gentle_starts);
  for (double limit = gentler * largest_tilt(design.design); limit > steep_tilt * gentler; limit *= gentler) {
    CurveVariables tighter = v;
    tighter.beta = narrowed(v.beta, limit);
    if (!(tighter.beta.lower < tighter.beta.upper)) return;
    CurveDesign candidate = fit_curve(goal, tighter, options);
    if (!(candidate.error.rms <= acceptable)) return;
    design = std::move(candidate);
  }
}

/// The next tilt limit to try: below the least that still collides, above the largest that costs too much
/// error.
double next_limit(double collides, double costs_too_much) {
  return std::max(narrowing * collides, (collides + costs_too_much) / 2);
}

/// Narrows the tilts until the walls are free. @return false where no limit tried did it
bool free_the_walls(const targets::Curve& goal, CurveVariables v, const model::CellSize& size,
                    const MultiStartOptions& options, FreeCurveDesign& result) {
  const double acceptable = worst_growth * result.design.error.rms + exact;
  double collides = largest_tilt(result.design.design), costs_too_much = 0;
  for (int k = 0; k < most_narrowings; ++k) {
    const double limit = next_limit(collides, costs_too_much);
    CurveVariables tighter = v;
    tighter.beta = narrowed(v.beta, limit);
    if (!(tighter.beta.lower < tighter.beta.upper)) return false;
    CurveDesign candidate = fit_curve(goal, tighter, options);
    if (!(candidate.error.rms <= acceptable)) {
      costs_too_much = limit;
    } else if (first_contact(candidate.design, size).touches) {
      collides = limit;
    } else {
      result.notes.push_back(fmt::format(
          "tilts kept within {:.1f} deg: with steeper ones walls run into each other", to_degrees(limit)));
      result.design = std::move(candidate);
      return true;
    }
  }
  return false;
}

}  // namespace

void CurveVariables::validate() const {
  check_at_least("columns", columns, 2);
  check_at_least("rows", rows, 1);
  if (!(cell_mm > 0) || !std::isfinite(cell_mm))
    throw InvalidInput(fmt::format("cell_mm is {}, must be positive and finite", cell_mm));
  check_range("beta", beta, -pi / 2, pi / 2);
  check_range("theta", theta, 0, pi / 2);
}

CurveDesign fit_curve(const targets::Curve& goal, const CurveVariables& v, const MultiStartOptions& options) {
  v.validate();
  const CurveFit fit(goal, make_bend_ties(v.columns, v.per, v.symmetry, v.beta), v.cell_mm, v.theta);
  CurveDesign result;
  result.reach = analyse_reach(fit);
  result.search = multi_start(
      fit, [&](int k, std::uint64_t seed) { return curve_start(fit, k, seed); }, options);
  result.chosen = gentlest(fit, result.search);
  const SolveResult& run = result.search.runs[result.chosen];
  if (run.x.size() == 0) throw std::runtime_error("every start of the search failed: " + run.why);
  result.design = fit.design(run.x, v.rows);
  model::State lattice;
  fold(result.design, v.cell_mm, lattice);
  result.midline_mm = midline(lattice, v.rows);
  result.error = curve_error(result.midline_mm, goal);
  return result;
}

FreeCurveDesign fit_free_curve(const targets::Curve& goal, const CurveVariables& variables,
                               const model::CellSize& size, const MultiStartOptions& options) {
  FreeCurveDesign result;
  CurveVariables v = variables;
  keep_below_closing(v, size, result.notes);
  result.design = fit_curve(goal, v, options);
  make_gentle(goal, v, options, result.design);
  const model::ThetaLimit contact = first_contact(result.design.design, size);
  result.walls_are_free = !contact.touches || free_the_walls(goal, v, size, options, result);
  if (!result.walls_are_free)
    result.notes.push_back(
        fmt::format("walls run into each other at theta {:.2f} deg, before the {:.2f} deg of the goal",
                    to_degrees(contact.theta), to_degrees(result.design.design.theta)));
  return result;
}

}  // namespace kinetix::optim
