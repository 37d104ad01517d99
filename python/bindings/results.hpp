#pragma once

#include <pybind11/pybind11.h>

#include "app/run/goal.hpp"
#include "app/run/run_options.hpp"

namespace kinetix::python {

/// Settings of a run that Python requests.
struct RunChoice {
  app::RunOptions options;
  std::optional<double> time_limit_s;
  pybind11::object progress;  ///< a callable (stage, share done or None, words), or None
  bool keeps_best = true;     ///< whether a stopped run has a result
};

using RunFunction = std::function<app::Run(const app::RunOptions&)>;

/// Makes a run, interruptibly. @param file name in messages about errors found after reading; may be empty
/// @throws what a callable of Python raised. @pre the lock is held
std::shared_ptr<app::Run> run_in_python(const RunFunction& function, const std::string& file,
                                        RunChoice choice);

}  // namespace kinetix::python
