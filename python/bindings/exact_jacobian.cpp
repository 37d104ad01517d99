#include "python/bindings/exact_jacobian.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "model/lattice/square/family/exact_derivatives.hpp"
#include "python/bindings/arrays.hpp"

namespace kinetix::python {
namespace {

namespace py = pybind11;

/// @throws InvalidInput
model::ExactDesign<double> exact_design(const PythonDesign& design) {
  const model::Structure* squares = design.sheet().squares();
  const auto found = squares ? classify(*squares) : model::Classification{};
  using model::Family;
  const bool known = found.family == Family::F1 || found.family == Family::F2 || found.family == Family::F3;
  if (!known || found.transposed)
    throw InvalidInput(
        "derivatives are known of sheets of squares of the families F1, F2 and F3 that fold along x; this "
        "one: " +
        design.exact().why);
  return found.design;
}

std::vector<std::string> names_of(const model::ExactJacobian& derivatives, int columns, int rows) {
  std::vector<std::string> names(derivatives.parameters());
  for (int c = 0; c < columns; ++c) {
    names[derivatives.beta(c)] = fmt::format("beta[{}]", c);
    names[derivatives.t(c)] = fmt::format("t[{}]", c);
  }
  for (int r = 0; r < rows; ++r) names[derivatives.s(r)] = fmt::format("s[{}]", r);
  names[derivatives.gamma()] = "gamma";
  names[derivatives.theta()] = "theta";
  return names;
}

}  // namespace

py::tuple exact_jacobian(const PythonDesign& design, double theta) {
  model::ExactDesign<double> exact = exact_design(design);
  exact.theta = theta;
  model::State lattice;
  model::ExactJacobian derivatives;
  fold_with_jacobian(exact, design.sheet().size().edge_mm, lattice, derivatives);
  const auto& bodies = design.sheet().squares()->bodies;
  std::vector<double> numbers;
  for (int p = 0; p < derivatives.parameters(); ++p)
    for (const auto& vertex : bodies) {
      const model::Twist& twist = derivatives.twist(p, model::lattice_body(vertex, exact.rows()));
      numbers.insert(numbers.end(), twist.v.begin(), twist.v.end());
      numbers.insert(numbers.end(), twist.omega.begin(), twist.omega.end());
    }
  return py::make_tuple(
      names_of(derivatives, exact.columns(), exact.rows()),
      array_of(std::move(numbers), {derivatives.parameters(), static_cast<py::ssize_t>(bodies.size()), 6}));
}

}  // namespace kinetix::python
