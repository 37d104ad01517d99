#pragma once

#include <chrono>
#include <limits>
#include <list>
#include <map>
#include <memory>

#include "model/linkage/state.hpp"

namespace kinetix::app::studio {

/// Method that computes a shape. The numbers are written into frames.
enum class Mode { exact = 0, equilibrium = 1, bullet = 2 };

/// A shape of the design, as the page shows it (studio-protocol.md, "Frames").
struct Frame {
  int revision = 0;  ///< of its design
  Mode mode = Mode::exact;
  double theta = std::numeric_limits<double>::quiet_NaN();  ///< rad; NaN here and below: none
  double seconds = 0;                                       ///< s, simulated
  double force_N = std::numeric_limits<double>::quiet_NaN();
  double energy_Nmm = std::numeric_limits<double>::quiet_NaN();  ///< N mm
  model::State state;                                            ///< mm
  std::map<int, double> processed;  ///< per client: number of its last command whose effect this shows
};

/// Returns the message of a frame, little-endian. @param number of the frame, which the client acknowledges
std::string frame_bytes(const Frame& frame, std::int64_t number, int client);

/// Time step of the interactive engine, s: stable for shaking hands; four steps per frame of a screen.
inline constexpr double live_step_s = 1.0 / 240;

/// Advances an engine with real time. A slow engine runs in slow motion and does not catch up.
class PlayTime {
 public:
  /// Starts the clock now.
  void restart();
  /// Runs the steps since the last call.
  /// @param speed simulated over real time, (0, 1]   @param plays called before the first step   @param step
  /// advances by live_step_s
  void pass(double speed, const std::function<bool()>& plays, const std::function<void()>& step);

 private:
  using Clock = std::chrono::steady_clock;

  double pending_s_ = 0;  ///< s, simulated
  Clock::time_point played_ = Clock::now();
};

/// Message for pages; all of them share its bytes.
struct Text {
  std::string type;  ///< of the message
  std::shared_ptr<const std::string> bytes;
};

/// Messages that wait for a page. A message that describes the present (studio-protocol.md, "What the page is
/// told") replaces an older one of its type. All others accumulate, and their bytes are counted.
class WaitingTexts {
 public:
  void add(Text text);
  bool empty() const { return texts_.empty(); }
  /// Removes and returns the first. @pre not empty
  Text take();
  /// Returns the bytes of the messages that accumulate.
  std::size_t counted_bytes() const { return counted_; }

 private:
  std::list<Text> texts_;
  std::size_t counted_ = 0;
};

}  // namespace kinetix::app::studio
