#include "app/studio/play/play_time.hpp"

#include <algorithm>

namespace kinetix::app::studio {
namespace {

constexpr double most_owed_s = 0.1;  // simulated: a tenth of a second behind is not seen
// Of computing between two frames: 20 of them a second are shown however slow the engine is.
constexpr std::chrono::milliseconds busy{30};

}  // namespace

void PlayTime::restart() {
  owed_s_ = 0;
  played_ = Clock::now();
}

void PlayTime::pass(double speed, const std::function<bool()>& plays, const std::function<void()>& step) {
  const Clock::time_point now = Clock::now();
  const double passed = std::chrono::duration<double>(now - played_).count();
  owed_s_ = std::min(owed_s_ + speed * passed, most_owed_s);
  played_ = now;
  if (!plays()) return;
  for (; owed_s_ >= live_step_s && Clock::now() - now < busy; owed_s_ -= live_step_s) step();
}

}  // namespace kinetix::app::studio
