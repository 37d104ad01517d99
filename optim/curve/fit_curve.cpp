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

constexpr double as_good = 1.01;  // times the least |r|: within this, the smallest tilts decide
constexpr double exact = 1e-9;    // of the goal's diagonal, added: only rounding is left if the goal is met
                                  // exactly
constexpr double gentler = 0.6;   // times the last tilt limit: few tries lead from 60 deg to small ones
constexpr double gentle_growth = 1.3;  // times the error: largest increase accepted for smaller tilts
constexpr int gentle_starts = 2;       // per tighter limit: the smoothest layout and the even one
constexpr double steep_tilt = 15 * radians_per_degree;  // rad: designs that tilt less are left unchanged
constexpr double narrowing = 0.8;    // times the limit at which walls collide: the lowest next limit
constexpr int most_narrowings = 10;  // searches: 0.8^10 is a tenth of the first tilts
constexpr double worst_growth = 10;  // times the error: beyond, the design no longer has the goal's shape
// Designs of the whole range of tilts that are tried if gentle ones miss the goal. Two or three find all
// there is.
constexpr int most_thetas = 4;
constexpr double less_theta = 0.9;  // times theta, to leave the valley in which the search has ended

void check_at_least(const char* field, int value, int least) {
  if (value < least) throw InvalidInput(fmt::format("{} is {}, must be at least {}", field, value, least));
}

/// Throws unless lowest < range.lower < range.upper < highest.
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

/// Returns the theta at which the walls of the design first meet, or at least the design's theta if none
/// meet.
model::ContactLimit first_contact(const model::ExactDesign<double>& design, const model::CellSize& size) {
  const model::Structure structure = sheet_of(design, size);
  return theta_range(structure, exact_motion(structure), {.limit = design.theta}).positive;
}

void keep_below_closing(CurveVariables& v, const model::CellSize& size, std::vector<std::string>& notes) {
  const double closing = closing_theta(size) - model::closing_margin;
  if (!(v.theta.upper > closing)) return;
  if (!(v.theta.lower < closing))
    throw InvalidInput(fmt::format(
        "walls of {:.3g} mm in cells of {:.3g} mm close at theta {:.1f} deg, below the range asked for",
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

/// Reduces the tilts, since small tilts print better. A coarse goal can make the search tilt steeply for a
/// little less error. Tries tighter limits and keeps the tightest that costs little error. A design that
/// meets the goal still meets it afterwards.
void make_gentle(const targets::Curve& goal, const CurveVariables& v, MultiStartOptions options,
                 double enough, CurveDesign& design) {
  double acceptable = gentle_growth * design.error.rms;
  if (design.error.rms <= enough) acceptable = std::min(acceptable, enough);
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

std::string kept_within(double tilt) {
  return fmt::format("tilts kept within {:.1f} deg: with steeper ones walls run into each other",
                     to_degrees(tilt));
}

/// Returns the next tilt limit to try. It is between the least limit that collides and the largest that costs
/// too much error.
double next_limit(double collides, double costs_too_much) {
  return std::max(narrowing * collides, (collides + costs_too_much) / 2);
}

/// Narrows the tilts until the walls are free. @return whether a tried limit succeeded
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
      result.narrowed = kept_within(limit);
      result.design = std::move(candidate);
      return true;
    }
  }
  return false;
}

/// Returns the upper bound of theta for the next search: just below the first contact, or below the design's
/// theta if walls are free.
double next_theta(const CurveDesign& design, const model::ContactLimit& contact) {
  return contact.touches ? contact.theta - model::closing_margin : less_theta * design.design.theta;
}

/// Searches the whole range of tilts at smaller and smaller theta. Keeps a result with free walls if it is
/// nearer to the goal than the present design. If the present walls collide, a near enough result replaces it
/// too.
/// @param wide design found in the whole range of `v`
void try_all_tilts(const targets::Curve& goal, CurveVariables v, const model::CellSize& size,
                   const MultiStartOptions& options, double enough, CurveDesign wide,
                   FreeCurveDesign& result) {
  const double rms = result.design.error.rms;
  double below = result.contact.touches ? std::max(rms, std::min(enough, worst_growth * rms)) + exact : rms;
  std::string narrowed;
  for (int k = 0; k < most_thetas && !options.solver.stop.stop_requested(); ++k) {
    const model::ContactLimit contact = first_contact(wide.design, size);
    if (wide.error.rms < below && !contact.touches) {
      below = wide.error.rms;
      result.design = wide;
      result.contact = contact;
      result.narrowed = narrowed;
      if (below <= enough) return;
    } else if (wide.error.rms < below && !result.contact.touches && result.narrowed.empty()) {
      result.narrowed = kept_within(largest_tilt(result.design.design));
    }
    v.theta.upper = next_theta(wide, contact);
    if (!(v.theta.lower < v.theta.upper)) return;
    if (contact.touches)
      narrowed = fmt::format("theta kept below {:.1f} deg: beyond, walls of such tilts run into each other",
                             to_degrees(v.theta.upper));
    wide = fit_curve(goal, v, options);
  }
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
  fold_unchecked(result.design, v.cell_mm, lattice);
  result.midline_mm = midline(lattice, v.rows);
  result.error = curve_error(result.midline_mm, goal);
  return result;
}

FreeCurveDesign fit_free_curve(const targets::Curve& goal, const CurveVariables& variables,
                               const model::CellSize& size, const MultiStartOptions& options, double enough) {
  FreeCurveDesign result;
  CurveVariables v = variables;
  keep_below_closing(v, size, result.notes);
  result.design = fit_curve(goal, v, options);
  const CurveDesign wide = result.design;
  make_gentle(goal, v, options, enough, result.design);
  result.contact = first_contact(result.design.design, size);
  if (result.contact.touches && free_the_walls(goal, v, size, options, result)) result.contact = {};
  if (result.contact.touches || !(result.design.error.rms <= enough))
    try_all_tilts(goal, v, size, options, enough, wide, result);
  result.design.reach = wide.reach;
  if (!result.narrowed.empty()) result.notes.push_back(result.narrowed);
  return result;
}

}  // namespace kinetix::optim
