#pragma once

#include <pybind11/pybind11.h>

#include <exception>

#include "model/linkage/state.hpp"

namespace kinetix::python {

/// Error of a state as computed by a Python callable: residuals whose sum of squares is to be least, and optionally
/// their derivatives. It may be called from any thread and takes the interpreter's lock itself. Once Python has
/// raised, all further calls fail, so that a search ends. throw_again() then throws the first exception.
class CustomError {
 public:
  /// @param error takes poses, (N, 7), returns a number or m of them
  /// @param gradient takes poses, (N, 7), returns (m, N, 6), by each body's shift (mm) and turn (rad); or None
  CustomError(pybind11::object error, pybind11::object gradient)
      : error_(std::move(error)), gradient_(std::move(gradient)) {}

  bool has_gradient() const { return !gradient_.is_none(); }
  /// Number of residuals of the first state that was evaluated; -1 before.
  int residuals() const { return residuals_; }

  /// @return false if Python has raised, or a number is not finite. @throws nothing
  bool at(const model::State& state, Eigen::VectorXd& r) const noexcept;
  /// Computes the gradient row by row, with six columns per body. @pre has_gradient, at() was called.
  /// @return false if Python has raised, or a number is not finite
  bool gradient_at(const model::State& state, Eigen::MatrixXd& gradient) const noexcept;

  void throw_again() const {
    if (raised_) std::rethrow_exception(raised_);
  }

 private:
  /// Calls with the lock held. @return whether nothing was raised, then or before
  template <class Call>
  bool in_python(Call call) const noexcept;

  pybind11::object error_, gradient_;
  mutable int residuals_ = -1;
  mutable std::exception_ptr raised_;
};

}  // namespace kinetix::python
