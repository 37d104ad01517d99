#include <fmt/format.h>
#include <pybind11/stl.h>

#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"
#include "model/lattice/square/family/exact_derivatives.hpp"
#include "model/lattice/square/structure.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/bindings.hpp"
#include "python/bindings/many_folds.hpp"
#include "python/bindings/pose_table.hpp"

namespace kinetix::python {
namespace {

namespace py = pybind11;

using model::ExactDesign;
using model::Lanes;

/// Many strips with equal columns and rows: tilts, angles and, if hinges are off the middle, fractions, row by row.
struct Strips {
  Numbers beta, theta;
  std::optional<Numbers> t;
  double cell_mm = 1;
  int rows = 1;

  py::ssize_t count() const { return beta.shape(0); }
  int columns() const { return static_cast<int>(beta.shape(1)); }
  py::ssize_t bodies() const { return static_cast<py::ssize_t>(model::lattice_bodies(beta.shape(1), rows)); }
};

/// Rejects the value numbers[k, c]. @throws InvalidInput naming it
void reject(const char* name, py::ssize_t k, py::ssize_t c, double value, const char* allowed) {
  throw InvalidInput(fmt::format("{}[{}, {}] is {}, must be {}", name, k, c, number_text(value), allowed));
}

void check_shapes(const Strips& strips) {
  if (strips.beta.ndim() != 2 || strips.columns() < 1)
    throw InvalidInput("beta must have one row per strip and one column per column of cells, at least 1");
  if (strips.theta.ndim() != 1 || strips.theta.shape(0) != strips.count())
    throw InvalidInput(fmt::format("theta must be one angle a strip, {} in all", strips.count()));
  if (strips.t && (strips.t->ndim() != 2 || strips.t->shape(0) != strips.count() ||
                   strips.t->shape(1) != strips.beta.shape(1)))
    throw InvalidInput("t must have the shape of beta");
  require("cell_mm", strips.cell_mm, strips.cell_mm > 0 && std::isfinite(strips.cell_mm),
          "positive and finite");
  require("rows", strips.rows, strips.rows >= 1, "at least 1");
}

/// Checks family F2 (kinematics.md section 2): in each column the tilt is 0 or the hinge is in the middle.
void check_columns(const Strips& strips) {
  const py::ssize_t columns = strips.beta.shape(1);
  for (py::ssize_t k = 0; k < strips.count(); ++k)
    for (py::ssize_t c = 0; c < columns; ++c) {
      const double beta = strips.beta.data()[k * columns + c];
      if (!(std::abs(beta) < pi / 2)) reject("beta", k, c, beta, "within (-pi/2, pi/2) rad");
      if (!strips.t) continue;
      const double t = strips.t->data()[k * columns + c];
      if (!(t > 0 && t < 1)) reject("t", k, c, t, "within (0, 1)");
      if (beta != 0 && t != 0.5)
        reject("t", k, c, t, "0.5 in a column that is tilted: else it does not close");
    }
}

void check(const Strips& strips) {
  check_shapes(strips);
  check_columns(strips);
  for (py::ssize_t k = 0; k < strips.count(); ++k) {
    const double theta = strips.theta.data()[k];
    require(fmt::format("theta[{}]", k), theta, std::abs(theta) < pi / 2, "within (-pi/2, pi/2) rad");
  }
}

/// Writes strip k into a design of its size. Fractions of the walls of row 0 are from their left end, as in files.
void load(const Strips& strips, std::int64_t k, ExactDesign<double>& design) {
  const std::int64_t columns = strips.columns();
  for (int c = 0; c < columns; ++c) {
    design.beta[c] = strips.beta.data()[k * columns + c];
    if (strips.t) design.t[c] = model::fraction_from_lower(strips.t->data()[k * columns + c], {c, 0});
  }
  design.theta = strips.theta.data()[k];
}

/// Returns the numbers of a caller's array for results. @throws InvalidInput unless it has the shape, in C order and
/// doubles
double* writable(py::array out, const std::vector<py::ssize_t>& shape) {
  const bool fits = py::isinstance<py::array_t<double, py::array::c_style>>(out) && out.writeable() &&
                    std::vector<py::ssize_t>(out.shape(), out.shape() + out.ndim()) == shape;
  if (!fits)
    throw InvalidInput(fmt::format("out must be a writable array of float64 in C order, of shape ({})",
                                   fmt::join(shape, ", ")));
  return static_cast<double*>(out.mutable_data());
}

py::array fold_strips(Numbers beta, Numbers theta, std::optional<Numbers> t, double cell_mm, int rows,
                      std::optional<py::array> out, int threads) {
  const Strips strips{std::move(beta), std::move(theta), std::move(t), cell_mm, rows};
  check(strips);
  const std::vector<py::ssize_t> shape{strips.count(), strips.bodies(), pose_numbers};
  const py::array poses = out ? *out : unwritten(shape);
  double* const rows_of_poses = writable(poses, shape);
  const std::int64_t numbers = strips.bodies() * pose_numbers;
  many_folds_in_python(strips.count(), strips.bodies(), threads, [&](std::int64_t k, model::State& state) {
    thread_local ExactDesign<double> design;
    if (design.columns() != strips.columns() || design.rows() != strips.rows)
      design = ExactDesign<double>::basic(strips.columns(), strips.rows);
    if (!strips.t) std::fill(design.t.begin(), design.t.end(), 0.5);
    load(strips, k, design);
    fold_unchecked(design, strips.cell_mm, state);
    write_poses(state, rows_of_poses + k * numbers);
  });
  return poses;
}

/// Writes the derivatives of a body's pose: shift (mm), then turn (rad).
void write_twist(const model::Twist& twist, double* six) {
  std::copy_n(twist.v.data(), 3, six);
  std::copy_n(twist.omega.data(), 3, six + 3);
}

py::tuple strip_derivatives(Numbers beta, Numbers theta, double cell_mm, int rows, int threads) {
  const Strips strips{std::move(beta), std::move(theta), {}, cell_mm, rows};
  check(strips);
  const py::ssize_t columns = strips.columns(), bodies = strips.bodies(),
                    parameters = columns + 1;  // tilts and theta
  py::array poses = unwritten({strips.count(), bodies, py::ssize_t(pose_numbers)});
  py::array derivatives = unwritten({strips.count(), parameters, bodies, py::ssize_t(6)});
  auto *const p = static_cast<double*>(poses.mutable_data()), *const r = static_cast<double*>(
                                                                  derivatives.mutable_data());
  many_folds_in_python(strips.count(), strips.bodies(), threads, [&](std::int64_t k, model::State& state) {
    thread_local model::ExactJacobian jacobian;
    auto design = ExactDesign<double>::basic(strips.columns(), strips.rows);
    load(strips, k, design);
    fold_with_jacobian(design, strips.cell_mm, state, jacobian);
    write_poses(state, p + k * bodies * pose_numbers);
    double* six = r + k * parameters * bodies * 6;
    for (int c = 0; c <= columns; ++c)
      for (int b = 0; b < bodies; ++b, six += 6)
        write_twist(jacobian.twist(c < columns ? jacobian.beta(c) : jacobian.theta(), b), six);
  });
  return py::make_tuple(poses, derivatives);
}

/// Two strips side by side, with their gradient and the derivatives by their poses.
struct StripPair {
  ExactDesign<Lanes> design, gradient;
  Eigen::Matrix<Lanes, Eigen::Dynamic, 1> by_state;

  void resize(int columns, int rows, py::ssize_t bodies) {
    if (design.columns() != columns || design.rows() != rows)
      design = ExactDesign<Lanes>::basic(columns, rows);
    by_state.resize(6 * bodies);
  }

  void load(int lane, const Strips& strips, std::int64_t k) {
    const std::int64_t columns = strips.columns();
    for (int c = 0; c < columns; ++c) design.beta[c].set(lane, strips.beta.data()[k * columns + c]);
    design.theta.set(lane, strips.theta.data()[k]);
  }

  /// @param six shift and turn of each body; the kernel's order is turn, then shift
  void load_pulls(int lane, const double* six) {
    for (Eigen::Index body = 0; body < by_state.size(); body += 6)
      for (int d = 0; d < 3; ++d, ++six) {
        by_state[body + 3 + d].set(lane, six[0]);
        by_state[body + d].set(lane, six[3]);
        if (d == 2) six += 3;
      }
  }

  /// Writes the gradient by the tilts, then by theta.
  void write(int lane, double* row) const {
    for (const Lanes& beta : gradient.beta) *row++ = beta[lane];
    *row = gradient.theta[lane];
  }
};

py::array strip_gradients(Numbers beta, Numbers theta, Numbers by_poses, double cell_mm, int rows,
                          int threads) {
  const Strips strips{std::move(beta), std::move(theta), {}, cell_mm, rows};
  check(strips);
  const py::ssize_t columns = strips.columns(), bodies = strips.bodies(), numbers = 6 * bodies,
                    parameters = columns + 1;  // tilts and theta
  if (by_poses.ndim() != 3 || by_poses.shape(0) != strips.count() || by_poses.shape(1) != bodies ||
      by_poses.shape(2) != 6)
    throw InvalidInput(
        fmt::format("by_poses must be of shape ({}, {}, 6): one row per body", strips.count(), bodies));
  py::array gradients = unwritten({strips.count(), parameters});
  auto* const out = static_cast<double*>(gradients.mutable_data());
  const std::int64_t last = strips.count() - 1, pairs = (strips.count() + Lanes::count - 1) / Lanes::count;
  const auto fold_pair = [&](std::int64_t first, std::vector<model::PoseOf<Lanes>>& poses) {
    thread_local StripPair pair;
    pair.resize(strips.columns(), strips.rows, bodies);
    const auto strip = [&](int lane) { return std::min(Lanes::count * first + lane, last); };
    for (int lane = 0; lane < Lanes::count; ++lane) {
      pair.load(lane, strips, strip(lane));
      pair.load_pulls(lane, by_poses.data() + strip(lane) * numbers);
    }
    fold_unchecked(pair.design, strips.cell_mm, poses);
    fold_gradient(pair.design, strips.cell_mm, poses, pair.by_state, pair.gradient);
    for (int lane = 0; lane < Lanes::count; ++lane) pair.write(lane, out + strip(lane) * parameters);
  };
  many_folds_in_python<std::vector<model::PoseOf<Lanes>>>(pairs, Lanes::count * bodies, threads, fold_pair);
  return gradients;
}

}  // namespace

void add_strips(py::module_& core) {
  core.def("fold_strips", fold_strips);
  core.def("strip_derivatives", strip_derivatives);
  core.def("strip_gradients", strip_gradients);
}

}  // namespace kinetix::python
