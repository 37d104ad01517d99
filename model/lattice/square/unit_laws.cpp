#include "model/lattice/square/unit_laws.hpp"

#include "model/base/invalid_input.hpp"
#include "model/hinge/crease_law.hpp"

namespace kinetix::model {
namespace {

// Tolerance of t (fraction) and angles (rad): allows the rounding of degrees, but no real difference.
constexpr double agreement = 1e-9;

bool agree(const HingeParameters& a, const HingeParameters& b) {
  return std::abs(a.t - b.t) <= agreement && std::abs(a.alpha - b.alpha) <= agreement &&
         std::abs(a.beta - b.beta) <= agreement;
}

HingeParameters mean(const HingeParameters& a, const HingeParameters& b) {
  return {.t = (a.t + b.t) / 2, .alpha = (a.alpha + b.alpha) / 2, .beta = (a.beta + b.beta) / 2};
}

InvalidInput conflict(const Structure& s, int first, int second) {
  return InvalidInput("cells " + to_string(s.cells[first]) + " and " + to_string(s.cells[second]) +
                      " disagree about the wall between them. Give equal values, or `shared: average`");
}

}  // namespace

HingeParameters CellTuple::wall(int k) const {
  const bool reversed = k >= 2;
  if (reversed) return {.t = 1 - P[k], .alpha = pi - A_in[k], .beta = -A_out[k]};
  return {.t = P[k], .alpha = A_in[k], .beta = A_out[k]};
}

void apply_pattern(Structure& s, const CellTuple& even, const CellTuple& odd, SharedWalls shared) {
  std::vector<int> giver(s.hinges.size(), -1);
  for (int c = 0; c < static_cast<int>(s.cells.size()); ++c) {
    const CellTuple& tuple = ((s.cells[c].i + s.cells[c].j) & 1) == 0 ? even : odd;
    for (int k = 0; k < 4; ++k) {
      const int h = s.cell_members[c].hinges[k];
      const HingeParameters wanted = tuple.wall(k);
      HingeParameters& current = s.hinges[h].parameters;
      if (giver[h] < 0) {
        current = wanted;
        giver[h] = c;
      } else if (!agree(current, wanted)) {
        if (shared == SharedWalls::must_agree) throw conflict(s, giver[h], c);
        current = mean(current, wanted);
      }
    }
  }
}

namespace {

void require_law(bool holds, const std::string& rule) {
  if (!holds) throw InvalidInput(rule);
}

void require_tilt(double beta) {
  require_law(beta > -pi / 2 && beta < pi / 2, "a tilt must lie between -90 and 90 deg, both excluded");
}

void require_theta(double theta) {
  require_law(theta >= -pi / 2 && theta <= pi / 2, "the fold angle must lie in [-90, 90] deg");
}

}  // namespace

double area_ratio(double k, double phi) {
  require_law(k >= 0 && k <= 1, "the hinge fraction must lie in [0, 1]");
  require_law(std::isfinite(phi), "the bar angle must be finite");
  return k * k + (1 - k) * (1 - k) + 2 * k * (1 - k) * std::cos(phi);
}

double final_area_ratio(double k) {
  require_law(k >= 0 && k <= 1 && k != 0.5, "the hinge fraction must lie in [0, 1] and not be 1/2");
  const double a = 2 + std::sqrt(2.0);
  return a * k * k - a * k + 1;
}

double shear_angle(double k) {
  require_law(k > 0 && k <= 1 && k != 0.5, "the hinge fraction must lie in (0, 1] and not be 1/2");
  return std::atan2(1 - k, k);
}

double twist_angle(double alpha) {
  require_law(alpha > 0 && alpha < pi, "the in-plane angle must lie between 0 and 180 deg, both excluded");
  return 2 * std::atan2(std::sin(alpha), std::cos(alpha) * std::sin(pi / 4));
}

CellTuple bend_unit(BendUnit variant, double beta_m, double beta_n) {
  require_tilt(beta_m);
  require_tilt(beta_n);
  const double n = variant == BendUnit::B ? -beta_n : beta_n;
  CellTuple unit;
  unit.A_out = {beta_m, n, beta_m, n};
  return unit;
}

double mirrored_unit_tilt(double beta_m, double beta_n, double u) {
  require_tilt(beta_m);
  require_tilt(beta_n);
  const double product = std::cos(beta_m) * std::cos(beta_n);
  require_law(std::cos(u) >= product, "cos(u) must be at least cos(beta_m) cos(beta_n)");
  return std::acos(product / std::cos(u));
}

double crease_fold(double beta, double theta) {
  require_tilt(beta);
  require_theta(theta);
  return crease_turn(beta, theta);
}

double crease_tilt(double fold, double theta) {
  require_law(fold > -pi && fold < pi, "a fold must lie between -180 and 180 deg, both excluded");
  require_theta(theta);
  require_law(theta != 0, "a flat sheet has no fold: the fold angle must not be 0");
  return tilt_of_turn(fold, theta);
}

}  // namespace kinetix::model
