#pragma once

#include <functional>
#include <thread>

namespace kinetix::app::studio {

/// Work of a session that takes long, on a thread of its own; one at a time.
class Job {
 public:
  /// Starts it; what ran before is asked to stop, and waited for.
  void start(std::function<void(std::stop_token)> work) { thread_ = std::jthread(std::move(work)); }
  void ask_to_stop() { thread_.request_stop(); }

 private:
  std::jthread thread_;
};

}  // namespace kinetix::app::studio
