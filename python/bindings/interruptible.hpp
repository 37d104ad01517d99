#pragma once

#include <functional>
#include <optional>
#include <stop_token>

namespace kinetix::python {

/// Runs work on a thread of its own, without the interpreter's lock, while the caller's thread looks out for Ctrl-C, which
/// asks the work to stop. What the work throws is thrown again; so is what another signal's handler raised in Python, once
/// the work has ended, and KeyboardInterrupt where Ctrl-C came a second time, or `keeps_best` is not set.
/// @param time_limit_s after which the work is asked to stop as well; nothing: never
/// @param keeps_best whether work that was stopped has something to give. @pre the lock is held
void run_interruptibly(const std::function<void(const std::stop_source&)>& work,
                       std::optional<double> time_limit_s, bool keeps_best);

}  // namespace kinetix::python
