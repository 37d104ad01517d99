#pragma once

#include <csignal>

namespace kinetix::app {

inline constexpr int interrupts[] = {SIGINT, SIGTERM, SIGHUP,
                                     SIGPIPE};  ///< signals that ask a program to end

/// Guard that holds interrupts back while it lives: no file may exist that the signal handler does not know.
class HeldSignals {
 public:
  HeldSignals() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal_number : interrupts) sigaddset(&signals, signal_number);
    pthread_sigmask(SIG_BLOCK, &signals, &before_);
  }
  ~HeldSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  sigset_t before_;
};

}  // namespace kinetix::app
