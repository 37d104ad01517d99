#include <glog/logging.h>

#include "app/version.hpp"
#include "python/bindings/bindings.hpp"

PYBIND11_MODULE(_core, core) {
  using namespace kinetix::python;
  core.doc() = "The compiled part of the package kinetix; use that.";
  core.attr("version") = kinetix::app::version;
  FLAGS_minloglevel =
      google::GLOG_FATAL;  // Ceres reports points without a value on stderr; searches expect them
  add_errors(core);
  add_states(core);
  add_designs(core);
  add_strips(core);
  add_results(core);
  add_runs(core);
  add_custom_goals(core);
  add_exports(core);
}
