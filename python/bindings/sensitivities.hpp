#pragma once

#include <pybind11/pybind11.h>

#include "app/run/run.hpp"
#include "python/bindings/arrays.hpp"

namespace kinetix::python {

/// Computes the derivatives of a function of a run's equilibrium by all its hinges and by their material, by the
/// adjoint.
/// @param poses derivatives of the function by each body's shift (mm) and turn (rad), (N, 6); empty: 0.
/// @param load, energy derivatives of the function by the drive's load (N, or N mm) and by the stored energy (N mm).
/// @throws InvalidInput without an equilibrium that reached its goal and is stable
pybind11::dict sensitivity_of(const app::Run& run, const std::optional<Numbers>& poses, double load,
                              double energy);

}  // namespace kinetix::python
