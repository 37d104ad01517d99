#pragma once

#include <pybind11/pybind11.h>

namespace kinetix::python {

/// Each function adds one concept to the module `kinetix._core`, which the package's Python files wrap and document.
void add_errors(pybind11::module_& core);
void add_states(pybind11::module_& core);
void add_designs(pybind11::module_& core);
void add_strips(pybind11::module_& core);
void add_results(pybind11::module_& core);
void add_runs(pybind11::module_& core);
void add_custom_goals(pybind11::module_& core);
void add_exports(pybind11::module_& core);

}  // namespace kinetix::python
