#include "optim/curve/curve_starts.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "model/hinge/crease_law.hpp"
#include "model/lattice/square/numbering.hpp"

namespace kinetix::optim {
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

}  // namespace kinetix::optim
