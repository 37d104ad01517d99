#pragma once

#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <exception>

#include "model/linkage/state.hpp"

namespace kinetix::python {

/// An error of a state that a callable of Python says: residuals whose sum of squares is to be least, and maybe their
/// derivatives. It is called from any thread and takes the interpreter's lock itself. Once Python has raised, all that
/// follows fails, so that a search comes to its end, where raise_again() throws what was raised first.
class OwnError {
 public:
  /// @param error takes poses, (N, 7), gives a number or m of them
  /// @param gradient takes the same, gives (m, N, 6), by each body's shift (mm) and turn (rad); or None
  OwnError(pybind11::object error, pybind11::object gradient)
      : error_(std::move(error)), gradient_(std::move(gradient)) {}

  bool has_gradient() const { return !gradient_.is_none(); }
  /// Of the first state that was looked at; -1 before.
  int residuals() const { return residuals_; }

  /// @return false where Python has raised, or a number is not finite. @throws nothing
  bool at(const model::State& state, Eigen::VectorXd& r) const noexcept;
  /// Row by row; columns are six a body. @pre has_gradient, at() was called. @return likewise
  bool gradient_at(const model::State& state, Eigen::MatrixXd& gradient) const noexcept;

  void raise_again() const {
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
