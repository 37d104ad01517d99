#include "model/closure/closure.hpp"

#include <Eigen/Geometry>

#include "model/base/rotation_vector.hpp"
#include "model/linkage/hinge_mismatch.hpp"

namespace kinetix::model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Entries = std::vector<Eigen::Triplet<double>>;

void append(Entries& entries, int row, int column, const Matrix3d& block) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) entries.emplace_back(row + r, column + c, block(r, c));
}

void append_body(Entries& entries, int row, int body, const Vector3d& arm, const Vector3d& axis,
                 double sign) {
  append(entries, row, 6 * body, -sign * cross_matrix(arm));
  for (int d = 0; d < 3; ++d) entries.emplace_back(row + d, 6 * body + 3 + d, sign);
  append(entries, row + 3, 6 * body, -sign * cross_matrix(axis));
}

}  // namespace

VectorXd closure_residual(const Linkage& structure, const State& state) {
  VectorXd residual(6 * structure.hinges.size());
  Eigen::Index row = 0;
  for (const RestHinge& hinge : structure.hinges) {
    const Pose &lower = state[hinge.lower], &upper = state[hinge.upper];
    residual.segment<3>(row) = point_mismatch(hinge, lower, upper, structure.size.edge_mm).gap;
    residual.segment<3>(row + 3) = axis_mismatch(hinge, lower, upper).gap;
    row += 6;
  }
  return residual;
}

Entries closure_entries(const Linkage& structure, const State& state) {
  Entries entries;
  entries.reserve(42 * structure.hinges.size());
  int row = 0;
  for (const RestHinge& hinge : structure.hinges) {
    const Pose &lower = state[hinge.lower], &upper = state[hinge.upper];
    const Mismatch axes = axis_mismatch(hinge, lower, upper);
    append_body(entries, row, hinge.lower, lower.R * hinge.lower_arm, axes.lower, 1);
    append_body(entries, row, hinge.upper, upper.R * hinge.upper_arm, axes.upper, -1);
    row += 6;
  }
  return entries;
}

Eigen::SparseMatrix<double> closure_jacobian(const Linkage& structure, const State& state) {
  const Entries entries = closure_entries(structure, state);
  Eigen::SparseMatrix<double> jacobian(6 * structure.hinges.size(), 6 * structure.bodies.size());
  jacobian.setFromTriplets(entries.begin(), entries.end());
  return jacobian;
}

State retract_straight(const Linkage& structure, const State& state, const VectorXd& twists) {
  State out = state;
  for (std::size_t b = 0; b < state.size(); ++b) {
    const Vector3d omega = twists.segment<3>(6 * b);
    const Eigen::AngleAxisd turn(omega.norm(), omega.stableNormalized());
    out[b].R = Eigen::Quaterniond(turn * state[b].R).normalized().toRotationMatrix();
    out[b].p += structure.size.edge_mm * twists.segment<3>(6 * b + 3);
  }
  return out;
}

}  // namespace kinetix::model
