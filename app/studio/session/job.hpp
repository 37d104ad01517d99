#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

namespace kinetix::app::studio {

/// Long work of a session, one task at a time, on a separate thread. start() does not wait. It asks the
/// running task to stop; the newest task begins after that.
class Job {
 public:
  using Work = std::function<void(const std::stop_token& stop)>;

  Job() = default;
  ~Job() {
    {
      const std::lock_guard lock(mutex_);
      next_.reset();
      stop_.request_stop();
    }
    if (thread_.joinable()) thread_.join();
  }
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  /// @param work reports its errors itself   @param dropped called if newer work replaced this before it
  /// began
  void start(
      Work work, std::function<void()> dropped = [] {}) {
    std::optional<Next> older;
    {
      const std::lock_guard lock(mutex_);
      stop_.request_stop();
      stop_ = {};
      older = std::exchange(next_, Next{std::move(work), std::move(dropped), stop_.get_token()});
      if (!runs_) begin();
    }
    if (older) older->dropped();
  }

  void stop_current() {
    const std::lock_guard lock(mutex_);
    stop_.request_stop();
  }

 private:
  struct Next {
    Work work;
    std::function<void()> dropped;
    std::stop_token stop;
  };

  /// @pre locked, nothing runs
  void begin() {
    if (thread_.joinable()) thread_.join();
    try {
      thread_ = std::thread([this] { run(); });
      runs_ = true;
    } catch (...) {
      next_.reset();
      throw;
    }
  }

  void run() {
    for (;;) {
      std::optional<Next> now;
      {
        const std::lock_guard lock(mutex_);
        now = std::exchange(next_, std::nullopt);
        runs_ = now.has_value();
      }
      if (!now) return;
      try {
        now->work(now->stop);
      } catch (...) {
        // Even the error report failed, for lack of memory.
      }
    }
  }

  std::mutex mutex_;
  std::stop_source stop_;
  std::optional<Next> next_;
  bool runs_ = false;
  std::thread thread_;
};

}  // namespace kinetix::app::studio
