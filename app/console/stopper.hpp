#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

namespace kinetix::app {

/// Asks a run to stop and keep the best so far: at the first Ctrl-C, or when its time is up. A second Ctrl-C ends the
/// program as it always did.
class Stopper {
 public:
  /// @param time_limit_s from now, s, > 0; nothing: as long as it takes
  explicit Stopper(std::optional<double> time_limit_s);
  ~Stopper();
  Stopper(const Stopper&) = delete;
  Stopper& operator=(const Stopper&) = delete;

  std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::mutex mutex_;
  std::condition_variable end_;
  bool ends_ = false;
  std::thread watch_;
};

}  // namespace kinetix::app
