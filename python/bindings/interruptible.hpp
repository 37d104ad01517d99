#pragma once

#include <functional>
#include <optional>
#include <stop_token>

namespace kinetix::python {

/// Runs work on a separate thread, without the interpreter's lock. The caller's thread watches for Ctrl-C, which
/// requests the work to stop. Exceptions of the work are thrown again. So are those that another signal's handler
/// raised in Python, once the work has ended. KeyboardInterrupt is thrown if Ctrl-C comes after a request to stop, or
/// if `keeps_best` is not set.
/// @param time_limit_s after which the work is also requested to stop; empty: never.
/// @param keeps_best whether stopped work has a result. @pre the lock is held
void run_interruptibly(const std::function<void(const std::stop_source&)>& work,
                       std::optional<double> time_limit_s, bool keeps_best);

}  // namespace kinetix::python
