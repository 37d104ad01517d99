#pragma once

#include <chrono>
#include <functional>
#include <limits>
#include <map>
#include <string>

#include "model/linkage/state.hpp"

namespace kinetix::app::studio {

/// How a shape is computed; the numbers stand in frames.
enum class Mode { exact = 0, equilibrium = 1, bullet = 2 };

/// One shape of the thing, as the page shows it (docs/studio.md, "Frames").
struct Frame {
  int revision = 0;  ///< of the design that it belongs to
  Mode mode = Mode::exact;
  double theta = std::numeric_limits<double>::quiet_NaN();  ///< rad; NaN here and below: there is none
  double seconds = 0;                                       ///< s, simulated
  double force_N = std::numeric_limits<double>::quiet_NaN();
  double energy_Nmm = std::numeric_limits<double>::quiet_NaN();  ///< N mm
  model::State state;                                            ///< mm
  std::map<int, double> heard;  ///< by client: the number of its last command whose effect this shows
};

/// The message of a frame, little-endian. @param number of the frame, which the client acknowledges
std::string frame_bytes(const Frame& frame, std::int64_t number, int client);

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
