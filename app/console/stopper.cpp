#include "app/console/stopper.hpp"

#include <atomic>
#include <chrono>
#include <csignal>
#include <iostream>

namespace kinetix::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds between_looks{20};  // nobody sees a shorter wait

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may write it");
struct sigaction before;

extern "C" void note_interrupt(int signal_number) {
  interrupted = true;
  sigaction(signal_number, &before, nullptr);
}

void watch_for_interrupts() {
  interrupted = false;
  struct sigaction noting {};
  noting.sa_handler = note_interrupt;
  sigaction(SIGINT, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(SIGINT, &noting, nullptr);
}

}  // namespace

Stopper::Stopper(std::optional<double> time_limit_s) {
  watch_for_interrupts();
  const Clock::time_point begin = Clock::now();
  watch_ = std::thread([this, begin, time_limit_s] {
    std::unique_lock lock(mutex_);
    while (!source_.stop_requested() && !end_.wait_for(lock, between_looks, [this] { return ends_; })) {
      const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
      const bool late = time_limit_s && seconds >= *time_limit_s;
      if (interrupted || late) {
        std::cerr << (late ? "the time is up" : "interrupted")
                  << ": keeping the best so far (Ctrl-C ends without it)\n";
        source_.request_stop();
      }
    }
  });
}

Stopper::~Stopper() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  end_.notify_one();
  watch_.join();
  if (before.sa_handler != SIG_IGN) sigaction(SIGINT, &before, nullptr);
}

}  // namespace kinetix::app
