#pragma once

#include "app/goals/curve/curve_file.hpp"
#include "app/run/run_options.hpp"
#include "optim/curve/fit_curve.hpp"

namespace kinetix::app {

/// What a search for the file's curve may vary, and how it is run.
optim::CurveVariables curve_variables(const CurveFile& file);
optim::MultiStartOptions curve_search(const CurveFile& file, const RunOptions& options);

}  // namespace kinetix::app
