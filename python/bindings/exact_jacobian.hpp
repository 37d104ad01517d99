#pragma once

#include <pybind11/pybind11.h>

#include "python/bindings/designs.hpp"

namespace kinetix::python {

/// Computes the derivatives of the closed form of a sheet of family F1, F2 or F3 along x by all its parameters.
/// @return names of the parameters, and (parameters, N, 6): of each body the shift (mm) and the turn (rad)
/// @throws InvalidInput for any other sheet
pybind11::tuple exact_jacobian(const PythonDesign& design, double theta);

}  // namespace kinetix::python
