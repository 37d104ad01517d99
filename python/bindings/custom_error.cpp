#include "python/bindings/custom_error.hpp"

#include <fmt/format.h>

#include "model/base/invalid_input.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/pose_table.hpp"

namespace kinetix::python {
namespace {

namespace py = pybind11;

py::array poses_of(const model::State& state) {
  py::array_t<double> poses({static_cast<py::ssize_t>(state.size()), py::ssize_t(pose_numbers)});
  write_poses(state, poses.mutable_data());
  return poses;
}

Numbers numbers_of(const py::object& given, const char* what) {
  Numbers numbers = Numbers::ensure(given);
  if (numbers) return numbers;
  PyErr_Clear();
  throw InvalidInput(fmt::format("{} must give numbers, not {}", what, py::repr(given).cast<std::string>()));
}

}  // namespace

template <class Call>
bool CustomError::in_python(Call call) const noexcept {
  const py::gil_scoped_acquire mine;
  if (raised_) return false;
  try {
    call();
    return true;
  } catch (...) {
    raised_ = std::current_exception();
    return false;
  }
}

bool CustomError::at(const model::State& state, Eigen::VectorXd& r) const noexcept {
  const bool called = in_python([&] {
    const Numbers numbers = numbers_of(error_(poses_of(state)), "the error");
    if (numbers.ndim() > 1 || numbers.size() == 0)
      throw InvalidInput("the error must give a number or a list of numbers");
    if (residuals_ < 0) residuals_ = static_cast<int>(numbers.size());
    if (numbers.size() != residuals_)
      throw InvalidInput(fmt::format("the error gave {} numbers, and {} before: it must always give as many",
                                     numbers.size(), residuals_));
    r = Eigen::Map<const Eigen::VectorXd>(numbers.data(), residuals_);
  });
  return called && r.allFinite();
}

bool CustomError::gradient_at(const model::State& state, Eigen::MatrixXd& gradient) const noexcept {
  const auto columns = static_cast<Eigen::Index>(6 * state.size());
  const bool called = in_python([&] {
    const Numbers numbers = numbers_of(gradient_(poses_of(state)), "the gradient");
    if (numbers.size() != residuals_ * columns || numbers.ndim() < 2 ||
        numbers.shape(numbers.ndim() - 1) != 6)
      throw InvalidInput(fmt::format(
          "the gradient must have the shape ({}, {}, 6): of each residual by the shift (mm) and the turn "
          "(rad) of each body",
          residuals_, state.size()));
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    gradient = Eigen::Map<const Rows>(numbers.data(), residuals_, columns);
  });
  return called && gradient.allFinite();
}

}  // namespace kinetix::python
