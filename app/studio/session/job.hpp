#pragma once

#include <atomic>
#include <functional>
#include <list>
#include <memory>
#include <thread>

namespace kinetix::app::studio {

/// Work of a session that takes long, on threads of its own. What ran before is asked to stop, and ends when it comes to
/// it: whoever starts the next does not wait.
class Job {
 public:
  void start(std::function<void(std::stop_token)> work) {
    ask_to_stop();
    runs_.remove_if([](const Run& run) { return run.ended->load(); });
    const auto ended = std::make_shared<std::atomic<bool>>(false);
    runs_.push_back({ended, std::jthread([work = std::move(work), ended](const std::stop_token& stop) {
                       work(stop);
                       *ended = true;
                     })});
  }
  void ask_to_stop() {
    for (Run& run : runs_) run.thread.request_stop();
  }

 private:
  struct Run {
    std::shared_ptr<std::atomic<bool>> ended;
    std::jthread thread;
  };
  std::list<Run> runs_;
};

}  // namespace kinetix::app::studio
