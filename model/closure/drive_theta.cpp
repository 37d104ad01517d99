#include "model/closure/drive_theta.hpp"

#include <cmath>
#include <utility>

#include "model/base/invalid_input.hpp"
#include "model/closure/closure.hpp"

namespace kinetix::model {
namespace {

using Kind = LinkageDrive::Kind;

constexpr int scan_steps = 900;             // steps of a tenth of a degree, to separate close roots
constexpr double widest = 89.9 * pi / 180;  // rad; at 90 deg every cell is closed
constexpr int halvings = 80;                // halvings of a step: down to the last bit of any theta

/// Deviation of the drive's coordinate in the linkage's state from its target.
class DriveMiss {
 public:
  DriveMiss(const LinkageDrive& drive, const Linkage& linkage, const std::function<State(double)>& fold)
      : drive_(drive), linkage_(linkage), fold_(fold) {}

  double operator()(double theta) const {
    const State state = fold_(theta);
    if (drive_.kind == Kind::hinge) return hinge_turn(linkage_, state, drive_.hinge) - drive_.angle;
    const int first = drive_.gripped[0].front(), last = drive_.gripped[1].front();
    const int d = component(drive_.axis);
    const double rest = linkage_.rest_position(last)[d] - linkage_.rest_position(first)[d];
    return 1 - (state[last].p[d] - state[first].p[d]) / rest - drive_.compression;
  }

 private:
  const LinkageDrive& drive_;
  const Linkage& linkage_;
  const std::function<State(double)>& fold_;
};

// Samples of theta up to the target of a straight tendon; the root is earlier if the ends curl up
constexpr int samples = 64;
constexpr double growth = 1.01;  // ratio of theta from sample to sample beyond
constexpr int golden_cuts = 60;  // cuts of a dip, down to the last bits of theta
// Ratio to theta: this far past the target, a straight tendon is certainly shorter
constexpr double beyond = 1e-6;
constexpr int max_secants = 100;  // steps in a bracket: bisection alone needs 50

/// Excess length of a tendon over its target, cell edges, on one side of flat.
class CordMiss {
 public:
  CordMiss(const LinkageDrive& drive, const Linkage& linkage, const std::function<State(double)>& fold,
           int side)
      : drive_(drive), linkage_(linkage), fold_(fold), side_(side) {}

  /// @param size absolute value of theta, rad
  double operator()(double size) const {
    const double length = cord_length(linkage_, drive_.through, fold_(side_ * size));
    return (length - drive_.rest_mm + drive_.shorten_mm) / linkage_.size.edge_mm;
  }

 private:
  const LinkageDrive& drive_;
  const Linkage& linkage_;
  const std::function<State(double)>& fold_;
  int side_;
};

/// Returns the root between a (miss > 0) and b (miss <= 0) by regula falsi with the Illinois rule.
double root_between(const CordMiss& miss, double a, double b) {
  double at_a = miss(a), at_b = miss(b);
  for (int k = 0; k < max_secants && at_b != 0; ++k) {
    const double middle = (a * at_b - b * at_a) / (at_b - at_a);
    if (!(middle > std::min(a, b) && middle < std::max(a, b))) break;
    const double now = miss(middle);
    if ((now > 0) == (at_b > 0))
      at_a /= 2;
    else
      a = b, at_a = at_b;
    b = middle, at_b = now;
  }
  return b;
}

/// Returns the size of theta between a and b at which a tendon is shortest. @pre its length has one dip
/// between them
double lowest_between(const CordMiss& miss, double a, double b) {
  constexpr double share = 1 / std::numbers::phi;
  for (int k = 0; k < golden_cuts; ++k) {
    const double low = b - share * (b - a), high = a + share * (b - a);
    (miss(low) < miss(high) ? b : a) = miss(low) < miss(high) ? high : low;
  }
  return (a + b) / 2;
}

/// Returns the smallest size of theta on one side, if any. A tendon may be short enough only briefly and
/// reach its length again at a much larger theta.
std::optional<double> cord_root(const CordMiss& miss, double straight) {
  struct Sample {
    double size, miss;
  };
  Sample first{0, miss(0)}, last = first;
  for (int k = 1; last.size < widest; ++k) {
    const double size = k <= samples ? straight * (1 + beyond) * k / samples : last.size * growth;
    const double here = std::min(size, widest);
    const Sample now{here, miss(here)};
    if (now.miss <= 0) return root_between(miss, last.size, now.size);
    if (last.miss < first.miss && last.miss <= now.miss) {
      const double lowest = lowest_between(miss, first.size, now.size);
      if (miss(lowest) <= 0) return root_between(miss, first.size, lowest);
    }
    first = std::exchange(last, now);
  }
  return std::nullopt;
}

Eigen::Vector3d middle_of(const std::vector<int>& bodies, const State& state) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int body : bodies) sum += state[body].p;
  return sum / static_cast<double>(bodies.size());
}

double apart(const GrippedRows& rows, const State& state) {
  return (middle_of(rows[1], state) - middle_of(rows[0], state)).norm();
}

double bisect(const DriveMiss& miss, double a, double b) {
  const bool rising = miss(b) > 0;
  for (int k = 0; k < halvings; ++k) {
    const double middle = (a + b) / 2;
    ((miss(middle) > 0) == rising ? b : a) = middle;
  }
  return (a + b) / 2;
}

}  // namespace

double theta_of(const LinkageDrive& drive, const Linkage& linkage, const std::function<State(double)>& fold) {
  if (drive.kind == Kind::shape_memory) return drive.theta();
  if (drive.kind == Kind::cord) {
    if (const auto theta = theta_of_cord(drive, linkage, fold)) return *theta;
    throw InvalidInput(
        "drive: no fold angle up to 89.9 deg shortens the tendon that much. Give a smaller shorten_mm");
  }
  const DriveMiss miss(drive, linkage, fold);
  const bool backwards = drive.kind == Kind::plates ? drive.branch < 0 : drive.theta() < 0;
  const double step = (backwards ? -widest : widest) / scan_steps;
  double before = miss(0);
  if (before == 0) return 0;
  for (int k = 1; k <= scan_steps; ++k) {
    const double now = miss(k * step);
    if (now == 0 || (now > 0) != (before > 0)) return bisect(miss, (k - 1) * step, k * step);
    before = now;
  }
  throw InvalidInput(
      "drive: no fold angle up to 89.9 deg reaches the goal of the drive. Give a smaller compression or "
      "angle");
}

std::optional<double> theta_of_cord(const LinkageDrive& drive, const Linkage& linkage,
                                    const std::function<State(double)>& fold) {
  const double straight = std::abs(drive.theta());
  if (straight == 0) return 0;
  const auto own = cord_root({drive, linkage, fold, drive.branch}, straight),
             other = cord_root({drive, linkage, fold, -drive.branch}, straight);
  const bool takes_other = other && (!own || *other < *own * (1 - beyond));
  if (takes_other) return -drive.branch * *other;
  return own ? std::optional(drive.branch * *own) : std::nullopt;
}

std::optional<double> folded_theta(const LinkageDrive& drive, double theta, const Linkage& linkage,
                                   const std::function<State(double)>& fold) {
  if (drive.kind == Kind::shape_memory) return std::nullopt;
  return drive.kind == Kind::cord ? theta_of_cord(drive.to(theta), linkage, fold) : theta;
}

double coordinate_of(const LinkageDrive& drive, const Linkage& linkage, const State& state) {
  if (drive.kind == Kind::plates)
    return 1 - apart(drive.gripped, state) / apart(drive.gripped, rest_state(linkage));
  if (drive.kind == Kind::cord) return drive.rest_mm - cord_length(linkage, drive.through, state);
  if (drive.kind == Kind::shape_memory) return 2 * mean_theta(linkage, state);
  return hinge_turn(linkage, state, drive.hinge);
}

double work_coordinate(const LinkageDrive& drive, const Linkage& linkage, const State& state) {
  if (drive.kind == Kind::hinge) return hinge_turn(linkage, state, drive.hinge);
  if (drive.kind == Kind::cord) return -cord_length(linkage, drive.through, state);
  const int first = drive.gripped[0].front(), last = drive.gripped[1].front(), d = component(drive.axis);
  return state[first].p[d] - state[last].p[d];
}

double theta_in(const LinkageDrive& drive, const Linkage& linkage, const State& state) {
  if (!drive.holds_coordinate()) return mean_theta(linkage, state);
  const double at = coordinate_of(drive, linkage, state);
  return drive.limited_to(drive.only_pulls() ? std::max(0.0, at) : at).theta();
}

double mean_theta(const Linkage& linkage, const State& state) {
  const auto& hinges = linkage.hinges;
  const bool some_upright =
      std::any_of(hinges.begin(), hinges.end(), [](const RestHinge& h) { return is_vertical(h); });
  double sum = 0;
  int count = 0;
  for (int h = 0; h < static_cast<int>(hinges.size()); ++h) {
    if (some_upright && !is_vertical(hinges[h])) continue;
    sum -= linkage.bodies[hinges[h].lower].sense * hinge_turn(linkage, state, h) / 2;
    ++count;
  }
  return sum / count;
}

namespace {

constexpr int energy_scan_steps =
    100;                           // from flat to the rest angle of the springs, to bracket the first minimum
constexpr double accuracy = 1e-8;  // rad: closer to a minimum, energies differ only by rounding
const double golden = (std::sqrt(5.0) - 1) / 2;  // golden section: the next bracket has the same proportions

/// Energy of hinges and springs along the closed form, N mm.
class FoldEnergy {
 public:
  FoldEnergy(const DrivenLinkage& driven, const Elasticity& elasticity)
      : driven_(driven), elasticity_(elasticity) {}

  double operator()(double theta) const {
    const Linkage& linkage = driven_.linkage;
    const State state = driven_.exact.at(theta);
    double sum = 0;
    for (std::size_t h = 0; h < linkage.hinges.size(); ++h) {
      const Elasticity& own = elasticity_.of(h);
      sum += own.law->at(hinge_turn(linkage, state, static_cast<int>(h)), own.k_turn).energy;
    }
    for (const int h : driven_.drive.springs) {
      const int sense = linkage.bodies[linkage.hinges[h].lower].sense;
      const double off = hinge_turn(linkage, state, h) - turn_at_theta(sense, driven_.drive.theta());
      sum += 0.5 * driven_.drive.k_spring * off * off;
    }
    return sum;
  }

 private:
  const DrivenLinkage& driven_;
  const Elasticity& elasticity_;
};

/// Returns the minimum in a bracket by golden-section search.
double minimum_between(const FoldEnergy& energy, double a, double b) {
  double low = b - golden * (b - a), high = a + golden * (b - a);
  double at_low = energy(low), at_high = energy(high);
  while (std::abs(b - a) > accuracy) {
    if (at_low < at_high) {
      b = high, high = low, at_high = at_low;
      at_low = energy(low = b - golden * (b - a));
    } else {
      a = low, low = high, at_low = at_high;
      at_high = energy(high = a + golden * (b - a));
    }
  }
  return (a + b) / 2;
}

}  // namespace

double exact_theta(const DrivenLinkage& driven, const Elasticity& elasticity) {
  if (driven.drive.is_external()) return driven.exact.theta_of(driven.drive);
  const FoldEnergy energy(driven, elasticity);
  const double goal = driven.drive.theta(), step = goal / energy_scan_steps;
  if (goal == 0) return 0;
  double last = energy(0);
  for (int k = 1; std::abs(k * step) <= widest; ++k) {
    const double now = energy(k * step);
    if (!(now < last)) return minimum_between(energy, std::max(k - 2, 0) * step, k * step);
    last = now;
  }
  return std::copysign(widest, goal);
}

}  // namespace kinetix::model
