#include "python/bindings/interruptible.hpp"

#include <pybind11/pybind11.h>

#include <chrono>
#include <future>
#include <iostream>
#include <thread>

namespace kinetix::python {
namespace {

namespace py = pybind11;

using InterruptClock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds poll_interval{20};  // too short to be noticed

/// Handler of signals: requests the work to stop, and keeps what Python raised.
class Interrupts {
 public:
  Interrupts(std::stop_source stop, bool keeps_best) : stop_(std::move(stop)), keeps_best_(keeps_best) {}

  /// Lets Python's handlers run. @pre the lock is held
  void look() {
    if (PyErr_CheckSignals() == 0) return;
    py::error_already_set raised;
    const bool first = !stop_.stop_requested();
    stop_.request_stop();
    if (raised.matches(PyExc_KeyboardInterrupt) && first && keeps_best_)
      py::print("stopping and keeping the best result so far",
                py::arg("file") = py::module_::import("sys").attr("stderr"));
    else
      raised_.emplace(std::move(raised));
  }

  void throw_again() {
    if (raised_) throw py::error_already_set(std::move(*raised_));
  }

 private:
  std::stop_source stop_;
  bool keeps_best_ = true;
  std::optional<py::error_already_set> raised_;
};

}  // namespace

void run_interruptibly(const std::function<void(const std::stop_source&)>& work,
                       std::optional<double> time_limit_s, bool keeps_best) {
  const std::stop_source stop;
  Interrupts interrupts(stop, keeps_best);
  std::packaged_task<void()> task([&] { work(stop); });
  std::future<void> done = task.get_future();
  const auto begin = InterruptClock::now();
  const auto is_late = [&] {
    return time_limit_s &&
           std::chrono::duration<double>(InterruptClock::now() - begin).count() >= *time_limit_s;
  };
  {
    const py::gil_scoped_release others_may_run;
    std::thread worker(std::move(task));
    while (done.wait_for(poll_interval) != std::future_status::ready) {
      if (is_late()) std::stop_source(stop).request_stop();
      const py::gil_scoped_acquire mine;
      interrupts.look();
    }
    worker.join();
  }
  interrupts.look();
  interrupts.throw_again();
  done.get();
}

}  // namespace kinetix::python
