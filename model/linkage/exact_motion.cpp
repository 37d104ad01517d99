#include "model/linkage/exact_motion.hpp"

#include <cmath>

namespace kinetix::model {
namespace {

// Ratio: far above the rounding of these formulas, far below any relevant change
constexpr double outward = 1e-12;

/// f = m + r cos(2 theta - phi), least = m - r.
struct Wave {
  double m, r, phi, least;

  explicit Wave(const TurnLaw& law) {
    const double p = law.p, q = law.q, a = (p * p - 1 - q * q) / 2, b = p * q;
    m = (p * p + 1 + q * q) / 2;
    r = std::hypot(a, b);
    phi = std::atan2(b, a);
    least = p * p / (m + r);
  }
};

/// Returns true if low <= offset + k period <= high for an integer k.
bool meets(double low, double high, double offset, double period) {
  return std::floor((high - offset) / period) >= std::ceil((low - offset) / period);
}

}  // namespace

double TurnLaw::turn(double theta) const {
  return 2 * std::atan2(std::sin(theta), p * std::cos(theta) + q * std::sin(theta));
}

double TurnLaw::rate(double theta) const {
  const double s = std::sin(theta), c = p * std::cos(theta) + q * s;
  return 2 * p / (s * s + c * c);
}

RateBounds bounds_of(const TurnLaw& law, double low, double high) {
  const Wave f(law);
  const double from = 2 * low - f.phi - outward, to = 2 * high - f.phi + outward;
  const bool has_least = meets(from, to, pi, 2 * pi), has_steepest = meets(from, to, pi / 2, pi);
  const double least =
      has_least ? f.least : std::max(f.least, f.m + f.r * std::min(std::cos(from), std::cos(to)));
  const double steepest = has_steepest ? 1 : std::max(std::abs(std::sin(from)), std::abs(std::sin(to)));
  const double rate = 2 * law.p / (least * (1 - outward));
  return {rate, rate * 2 * f.r * steepest / (least * (1 - outward)) * (1 + outward)};
}

std::vector<TurnLaw> usual_turn_laws(const Linkage& linkage) {
  std::vector<TurnLaw> laws;
  for (const RestHinge& hinge : linkage.hinges) {
    const bool in_space = linkage.bodies[hinge.lower].spin || linkage.bodies[hinge.upper].spin;
    laws.push_back({in_space ? 1 : hinge.axis.z(), 0});
  }
  return laws;
}

int hinge_sense(const Linkage& linkage, int hinge) {
  const RestHinge& h = linkage.hinges[hinge];
  const Eigen::Vector3d turn = linkage.bodies[h.upper].first_turn() - linkage.bodies[h.lower].first_turn();
  return turn.dot(h.axis) < 0 ? -1 : 1;
}

}  // namespace kinetix::model
