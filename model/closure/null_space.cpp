#include "model/closure/null_space.hpp"

#include <algorithm>
#include <random>

#include "model/base/decompositions.hpp"
#include "model/base/sparse_factor.hpp"
#include "model/closure/closure.hpp"

namespace kinetix::model {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

constexpr double zero = 1e-8;  // singular value, dimensionless: see null_space.hpp
// Added to J^T J, whose entries are of the order of 1, so that it has a factor although J is singular. It
// sets the pace: each iteration shrinks a direction of singular value s by 1e-12 / s^2 relative to
// those of 0.
constexpr double shift = 1e-12;
constexpr int iterations = 6;  // leave 1e-12 of a direction of singular value 1e-5
// Singular value: directions below it are separated only in a block that contains all of them
constexpr double slow = 1e-5;
// Bodies: about 15 ms; the dense method's time grows with their cube
constexpr std::size_t most_bodies_for_dense = 20;

MatrixXd random_block(Eigen::Index rows, Eigen::Index columns) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  return MatrixXd::NullaryExpr(rows, columns, [&] { return unit(random); });
}

/// Inverse iteration with (J^T J + shift)^-1 for the smallest singular values of a Jacobian and their
/// vectors.
class InverseIteration {
 public:
  explicit InverseIteration(const SparseMatrix& jacobian) : jacobian_(jacobian) {
    SparseMatrix normal = jacobian.transpose() * jacobian;
    normal.diagonal().array() += shift;
    factor_.compute(normal);
  }

  SingularVectors smallest(Eigen::Index count) const {
    MatrixXd block = orthonormal(random_block(jacobian_.cols(), count));
    for (int k = 0; k < iterations; ++k) block = orthonormal(factor_.solve_all(block));
    SingularVectors spectrum = right_singular_vectors(jacobian_ * block);
    spectrum.vectors = block * spectrum.vectors;
    return spectrum;
  }

 private:
  const SparseMatrix& jacobian_;
  SparseFactor factor_;
};

SingularVectors small_spectrum(const SparseMatrix& jacobian) {
  const InverseIteration inverse(jacobian);
  for (Eigen::Index count = 8;; count *= 2) {
    SingularVectors spectrum = inverse.smallest(std::min(count, jacobian.cols()));
    if (count >= jacobian.cols() || spectrum.values[0] > slow) return spectrum;
  }
}

}  // namespace

NullSpace null_space(const Linkage& structure, const State& state, NullSpaceMethod method) {
  const SparseMatrix jacobian = closure_jacobian(structure, state).rightCols(6 * (state.size() - 1));
  const bool dense = method == NullSpaceMethod::dense ||
                     (method == NullSpaceMethod::automatic && state.size() <= most_bodies_for_dense);
  const SingularVectors spectrum =
      dense ? right_singular_vectors(jacobian.toDense()) : small_spectrum(jacobian);

  const Eigen::Index dofs = (spectrum.values.array() <= zero).count();
  const Eigen::Index others = spectrum.values.size() - dofs;
  NullSpace space;
  space.basis = MatrixXd::Zero(6 * state.size(), dofs);
  space.basis.bottomRows(jacobian.cols()) = spectrum.vectors.rightCols(dofs);
  if (dofs > 0) space.largest_zero = spectrum.values[others];
  if (others > 0) space.smallest_other = spectrum.values[others - 1];
  return space;
}

}  // namespace kinetix::model
