#pragma once

#include <chrono>
#include <condition_variable>
#include <latch>
#include <mutex>
#include <string>
#include <thread>

#include "app/console/time_left.hpp"
#include "app/run/run_options.hpp"

namespace kinetix::app {

/// Progress on stderr: a bar where stderr is a terminal, lines where it is not, nothing when quiet. A stage that takes
/// longer than a second says so every second: how long it has been going on, and how much of it is done and left where
/// that is known. Calls may come from any thread.
class Console {
 public:
  /// @param says_starts a line for each stage as it begins, where stderr is no terminal; else a stage that is over within
  /// a second says nothing, so that a refusal stands alone
  explicit Console(bool quiet, bool says_starts = true);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  /// @param done share of the stage, 0 to 1 (negative: not known)
  /// @param note stands at the end, in the place of the time left   @param so_far in words, before the time
  void stage(const std::string& name, double done, const std::string& note = {},
             const std::string& so_far = {});
  void error(const std::string& message);
  void warning(const std::string& message);  ///< nothing where quiet
  Progress progress();

 private:
  using Clock = std::chrono::steady_clock;

  void beat();
  void show();
  void show_bar(double seconds);
  std::string note(double seconds);
  void clear_line();

  const bool quiet_, terminal_, says_starts_;
  std::mutex mutex_;  ///< of all below
  std::condition_variable end_;
  bool ends_ = false;
  bool on_screen_ = false;  ///< a bar
  int shown_percent_ = -1;
  double done_ = -1;
  TimeLeft left_;                   ///< of the stage
  Clock::time_point since_, next_;  ///< the stage began; its next word is due
  std::string stage_, note_, so_far_;
  std::latch awake_{1};  ///< the heart's thread has begun: beginnings take memory, too
  std::thread heart_;
};

}  // namespace kinetix::app
