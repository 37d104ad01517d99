#pragma once

#include <pybind11/numpy.h>

#include <string>
#include <vector>

namespace kinetix::python {

/// Array of doubles, row by row. Anything else that a caller gives is copied into one.
using Numbers = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// Returns numbers that another object holds, without a copy. The array keeps their owner alive and cannot be written.
/// @param strides bytes from one entry to the next, by dimension
inline pybind11::array view_of(const double* numbers, std::vector<pybind11::ssize_t> shape,
                               std::vector<pybind11::ssize_t> strides, pybind11::handle owner) {
  pybind11::array_t<double> out(std::move(shape), std::move(strides), numbers, owner);
  out.attr("setflags")(pybind11::arg("write") = false);
  return out;
}

/// Returns a new array whose numbers are still to be written. It has ordinary pages: NumPy requests large ones, which
/// take twice as long to get on a machine with few of them at hand.
inline pybind11::array unwritten(std::vector<pybind11::ssize_t> shape) {
  std::size_t count = 1;
  for (const pybind11::ssize_t size : shape) count *= static_cast<std::size_t>(size);
  auto* numbers = new double[count];
  const pybind11::capsule owner(numbers, [](void* kept) { delete[] static_cast<double*>(kept); });
  return pybind11::array_t<double>(std::move(shape), numbers, owner);
}

/// Turns a vector into an array that owns it, without a copy.
inline pybind11::array array_of(std::vector<double>&& numbers, std::vector<pybind11::ssize_t> shape) {
  auto* kept = new std::vector<double>(std::move(numbers));
  const pybind11::capsule owner(kept, [](void* vector) { delete static_cast<std::vector<double>*>(vector); });
  return pybind11::array_t<double>(std::move(shape), kept->data(), owner);
}

/// Turns a vector into an array that owns it and refuses writes, for numbers of an object that does not change.
inline pybind11::array read_only(std::vector<double>&& numbers, std::vector<pybind11::ssize_t> shape) {
  pybind11::array out = array_of(std::move(numbers), std::move(shape));
  out.attr("setflags")(pybind11::arg("write") = false);
  return out;
}

}  // namespace kinetix::python
