#pragma once

#include <chrono>
#include <functional>

namespace kinetix::app::studio {

/// Time step of an engine that is played with, s: fast enough for the eye, and for hands that shake; four in a frame of a screen.
inline constexpr double live_step_s = 1.0 / 240;

/// Takes an engine as far as time has gone on. One that is slow shows slow motion, it does not catch up.
class PlayTime {
 public:
  /// Time goes on from now.
  void restart();
  /// @param speed simulated over real time, (0, 1]   @param plays asked before the first step   @param step takes live_step_s
  void pass(double speed, const std::function<bool()>& plays, const std::function<void()>& step);

 private:
  using Clock = std::chrono::steady_clock;

  double owed_s_ = 0;  ///< simulated
  Clock::time_point played_ = Clock::now();
};

}  // namespace kinetix::app::studio
