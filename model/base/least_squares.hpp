#pragma once

#include <Eigen/Core>

namespace kinetix {

/// The x that makes |A x - b| least, by a QR factor with column pivoting.
/// @param A as many rows as b, at least as many as columns; of full column rank, or x is one of many
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace kinetix
