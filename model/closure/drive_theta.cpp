#include "model/closure/drive_theta.hpp"

#include "model/base/angle.hpp"
#include "model/base/invalid_input.hpp"
#include "model/closure/closure_drive.hpp"

namespace kinetix::model {
namespace {

constexpr int scan_steps = 900;             // of a tenth of a degree, to part close roots
constexpr double widest = 89.9 * pi / 180;  // rad; at 90 deg every cell is closed
constexpr int halvings = 80;                // of a step: down to the last bit of any theta

/// What the drive prescribes, as the linkage in a state has it, minus what is asked.
class DriveMiss {
 public:
  DriveMiss(const LinkageDrive& drive, const Linkage& linkage, const std::function<State(double)>& fold)
      : drive_(drive), linkage_(linkage), fold_(fold) {}

  double operator()(double theta) const {
    const State state = fold_(theta);
    if (drive_.kind == LinkageDrive::Kind::hinge)
      return hinge_turn(linkage_, state, drive_.hinge) - drive_.angle;
    const int first = drive_.gripped[0].front(), last = drive_.gripped[1].front();
    const int d = drive_.axis == Axis::x ? 0 : 1;
    const double rest = linkage_.rest_position(last)[d] - linkage_.rest_position(first)[d];
    return 1 - (state[last].p[d] - state[first].p[d]) / rest - drive_.compression;
  }

 private:
  const LinkageDrive& drive_;
  const Linkage& linkage_;
  const std::function<State(double)>& fold_;
};

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
  const DriveMiss miss(drive, linkage, fold);
  const bool backwards = drive.kind == LinkageDrive::Kind::plates ? drive.branch < 0 : drive.theta() < 0;
  const double step = (backwards ? -widest : widest) / scan_steps;
  double before = miss(0);
  if (before == 0) return 0;
  for (int k = 1; k <= scan_steps; ++k) {
    const double now = miss(k * step);
    if (now == 0 || (now > 0) != (before > 0)) return bisect(miss, (k - 1) * step, k * step);
    before = now;
  }
  throw InvalidInput("drive: no theta up to 89.9 deg gives this structure what the drive asks for");
}

}  // namespace kinetix::model
