#include "optim/curve/fit_curve.hpp"

#include <fmt/format.h>
#include <random>

#include "model/hinge/crease_law.hpp"
#include "model/lattice/square/family/classification.hpp"

namespace kinetix::optim {
namespace {

// Longest strip over the curve's length. A strip that is longer even when fully pressed has to wind about the
// curve.
constexpr double max_slack = 1.02;

void note_length(const CurveFit& fit, CurveReach& reach) {
  const double length = fit.goal().length();
  const int columns = fit.ties().columns();
  const AngleRange theta{fit.lower()[fit.ties().variables()], fit.upper()[fit.ties().variables()]};
  const double straight = columns * fit.cell_mm();
  reach.shortest_mm = straight * std::cos(theta.upper);
  reach.longest_mm = straight * std::cos(theta.lower);
  const bool too_short = reach.longest_mm < length;
  if (!too_short && !(reach.shortest_mm > max_slack * length)) return;
  reach.obstacles.push_back(
      fmt::format("the curve is {0:.1f} mm long, and {1} cells of {2:.3g} mm span {4:.1f} to {3:.1f} mm "
                  "(fold angle {5:.1f} to {6:.1f} deg)",
                  length, columns, fit.cell_mm(), reach.longest_mm, reach.shortest_mm,
                  to_degrees(theta.lower), to_degrees(theta.upper)));
  reach.fitting_columns =
      static_cast<int>(std::lround(length / (fit.cell_mm() * std::cos((theta.lower + theta.upper) / 2))));
}

void note_turn(const CurveFit& fit, CurveReach& reach) {
  const auto worst =
      std::max_element(reach.turns.begin(), reach.turns.end(),
                       [](const ColumnTurn& a, const ColumnTurn& b) { return a.excess < b.excess; });
  if (!(worst->excess > 0)) return;
  const auto count =
      std::count_if(reach.turns.begin(), reach.turns.end(), [](auto& t) { return t.excess > 0; });
  const Eigen::Vector2d at = fit.goal().at(worst->arc_mm);
  const double turn = std::abs(worst->needed);
  const bool too_little = turn > worst->allowed;
  const std::string others = count > 1 ? fmt::format(" ({} columns are out of bounds)", count) : "";
  const std::string bounds =
      too_little ? fmt::format("the bounds allow {:.1f} deg at fold angle {:.1f} deg{}",
                               to_degrees(worst->allowed), to_degrees(reach.theta), others)
                 : fmt::format("the bounds require at least {:.1f} deg more at fold angle {:.1f} deg{}",
                               to_degrees(worst->excess), to_degrees(reach.theta), others);
  reach.obstacles.push_back(fmt::format(
      "{:.1f} mm along the curve (x {:.1f}, z {:.1f}) column {} needs to turn {:.1f} deg to the {}, and {}",
      worst->arc_mm, at.x(), at.y(), worst->column, to_degrees(turn), worst->needed < 0 ? "right" : "left",
      bounds));
}

}  // namespace

double needed_turn(const targets::Curve& goal, int column, int columns) {
  const double step = goal.length() / columns, arc = (column + 0.5) * step;
  const Eigen::Vector2d before = goal.at(arc) - goal.at(arc - step),
                        after = goal.at(arc + step) - goal.at(arc);
  return std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
}

CurveReach analyse_reach(const CurveFit& fit) {
  const BendTies& ties = fit.ties();
  const int theta_at = ties.variables();
  const double length = fit.goal().length(), step = length / ties.columns();
  CurveReach reach;
  reach.theta = std::clamp(std::acos(std::min(step / fit.cell_mm(), 1.0)), fit.lower()[theta_at],
                           fit.upper()[theta_at]);
  for (int c = 0; c < ties.columns(); ++c) {
    const AngleRange range = ties.range[ties.variable[c]];
    const double lowest = model::crease_turn(range.lower, reach.theta),
                 highest = model::crease_turn(range.upper, reach.theta);
    const double arc = (c + 0.5) * step, needed = needed_turn(fit.goal(), c, ties.columns());
    reach.turns.push_back({c, arc, needed, std::max(0.0, needed < 0 ? -lowest : highest),
                           std::max({0.0, needed - highest, lowest - needed})});
  }
  note_length(fit, reach);
  note_turn(fit, reach);
  return reach;
}

namespace {

// Rounds of placing the chord ends and recomputing the half turns. A start need not be exact.
constexpr int placement_rounds = 8;
constexpr double zigzag_step = 0.05;  // rad per pair of starts: those by rule reach 0.35, random ones 0.4
constexpr int even_start = 1;         // equal turns in all columns, if the bounds cut the layout
constexpr double steepest_psi = 1.2;  // rad: a chord still has a third of its length; at pi/2 its length is 0

/// Returns the half turns that give the chords their headings: the smoothest ones plus the zigzag.
std::vector<double> half_turns(const std::vector<double>& headings, double zigzag) {
  const int n = static_cast<int>(headings.size());
  std::vector<double> psi(n);
  double tau = headings[0], alternating = 0;
  for (int c = 0; c < n; ++c) {
    psi[c] = headings[c] - tau;
    tau += 2 * psi[c];
    alternating += model::column_sign(c) * psi[c];
  }
  const double shift = zigzag - alternating / n;
  for (int c = 0; c < n; ++c) psi[c] += model::column_sign(c) * shift;
  return psi;
}

/// Returns the headings of the chords between places on the goal, unwrapped.
std::vector<double> chord_headings(const targets::Curve& goal, const std::vector<double>& arc) {
  std::vector<double> headings;
  for (std::size_t c = 0; c + 1 < arc.size(); ++c) {
    const Eigen::Vector2d chord = goal.at(arc[c + 1]) - goal.at(arc[c]);
    const double heading = std::atan2(chord.y(), chord.x());
    const double near = headings.empty() ? goal.heading(0) : headings.back();
    headings.push_back(near + std::remainder(heading - near, 2 * pi));
  }
  return headings;
}

void place_ends(const std::vector<double>& psi, double length, std::vector<double>& arc) {
  for (std::size_t c = 0; c < psi.size(); ++c)
    arc[c + 1] = arc[c] + std::cos(std::clamp(psi[c], -steepest_psi, steepest_psi));
  const double scale = length / arc.back();
  for (double& s : arc) s *= scale;
}

double carried_edge(const targets::Curve& goal, const ChordLayout& layout) {
  double chords = 0, cosines = 0;
  for (std::size_t c = 0; c < layout.psi.size(); ++c) {
    const double cosine = std::cos(std::clamp(layout.psi[c], -steepest_psi, steepest_psi));
    chords += cosine * (goal.at(layout.arc[c + 1]) - goal.at(layout.arc[c])).norm();
    cosines += cosine * cosine;
  }
  return chords / cosines;
}

void spread_evenly(std::vector<double>& psi) {
  double sum = 0;
  for (const double p : psi) sum += p;
  std::fill(psi.begin(), psi.end(), sum / static_cast<double>(psi.size()));
}

double theta_of(const CurveFit& fit, const ChordLayout& layout) {
  const int at = fit.ties().variables();
  const double cosine = std::clamp(layout.carried_edge_mm / fit.cell_mm(), -1.0, 1.0);
  return std::clamp(std::acos(cosine), fit.lower()[at], fit.upper()[at]);
}

std::vector<double> bends_of(const ChordLayout& layout, double theta) {
  std::vector<double> bends;
  for (const double psi : layout.psi)
    bends.push_back(model::tilt_of_turn(2 * std::clamp(psi, -steepest_psi, steepest_psi), theta));
  return bends;
}

/// Returns whether the bounds cut the smoothest layout.
bool is_cut(const CurveFit& fit) {
  const ChordLayout layout = lay_chords(fit.goal(), fit.ties().columns(), 0);
  const BendTies& ties = fit.ties();
  const std::vector<double> bends = bends_of(layout, theta_of(fit, layout));
  for (int c = 0; c < ties.columns(); ++c) {
    const AngleRange& range = ties.range[ties.variable[c]];
    if (!(range.lower <= bends[c] && bends[c] <= range.upper)) return true;
  }
  return false;
}

}  // namespace

ChordLayout lay_chords(const targets::Curve& goal, int columns, double zigzag) {
  ChordLayout layout;
  layout.arc.assign(columns + 1, 0.0);
  layout.psi.assign(columns, 0.0);
  for (int round = 0; round < placement_rounds; ++round) {
    place_ends(layout.psi, goal.length(), layout.arc);
    layout.psi = half_turns(chord_headings(goal, layout.arc), zigzag);
  }
  layout.carried_edge_mm = carried_edge(goal, layout);
  return layout;
}

Eigen::VectorXd curve_start(const CurveFit& fit, int k, std::uint64_t seed) {
  double zigzag = (k % 2 == 0 ? 1 : -1) * zigzag_step * (k / 2);
  if (k == even_start) zigzag = zigzag_step / 2;
  const bool evenly = k == even_start && is_cut(fit);
  std::seed_seq mix{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                    static_cast<std::uint32_t>(k)};
  std::mt19937_64 random(mix);
  const auto unit = [&] { return std::generate_canonical<double, 53>(random); };
  if (k >= zigzag_starts) zigzag = zigzag_step * zigzag_starts * (unit() - 0.5);

  ChordLayout layout = lay_chords(fit.goal(), fit.ties().columns(), evenly ? 0.0 : zigzag);
  if (evenly) spread_evenly(layout.psi);
  const double theta = theta_of(fit, layout);
  std::vector<double> bends = bends_of(layout, theta);
  if (k >= zigzag_starts)
    for (double& bend : bends) bend += 0.1 * (unit() - 0.5);
  return fit.pack(bends, theta);
}

namespace {

constexpr double as_good = 1.01;  // times the least |r|: within this, the smallest tilts decide
constexpr double exact = 1e-9;    // of the goal's diagonal, added: only rounding is left if the goal is met
                                  // exactly
constexpr double gentler = 0.6;   // times the last tilt limit: few tries lead from 60 deg to small ones
constexpr double gentle_growth = 1.3;  // times the error: largest increase accepted for smaller tilts
constexpr int gentle_starts = 2;       // per tighter limit: the smoothest layout and the even one
constexpr double steep_tilt = 15 * radians_per_degree;  // rad: designs that tilt less are left unchanged
constexpr double narrowing = 0.8;    // times the limit at which walls collide: the lowest next limit
constexpr int max_narrowings = 10;   // searches: 0.8^10 is a tenth of the first tilts
constexpr double worst_growth = 10;  // times the error: beyond, the design no longer has the goal's shape
// Designs of the whole range of tilts that are tried if gentle ones miss the goal. Two or three find all
// there is.
constexpr int max_thetas = 4;
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
  const auto tilt_size = [&](int k) { return search.runs[k].x.head(tilts).cwiseAbs().maxCoeff(); };
  const double limit = as_good * search.best_run().residual_norm + exact;
  if (!std::isfinite(limit)) return search.best;
  int chosen = search.best;
  for (int k = 0; k < static_cast<int>(search.runs.size()); ++k)
    if (search.runs[k].residual_norm <= limit && tilt_size(k) < tilt_size(chosen)) chosen = k;
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
    throw InvalidInput(
        fmt::format("walls of {:.3g} mm in cells of {:.3g} mm close at {:.3g} deg, below the range of the "
                    "fold angle. Give thinner walls or smaller angles",
                    size.thickness_mm, size.edge_mm, to_degrees(closing)));
  v.theta.upper = closing;
  notes.push_back(fmt::format("fold angle limited to {:.3g} deg, where walls of {:.3g} mm close the cells",
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
  for (int k = 0; k < max_narrowings; ++k) {
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
  for (int k = 0; k < max_thetas && !options.solver.stop.stop_requested(); ++k) {
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
      narrowed = fmt::format("fold angle limited to {:.3g} deg: above it, walls with such tilts collide",
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
