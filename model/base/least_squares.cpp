#include "model/base/least_squares.hpp"

#include <Eigen/QR>

namespace kinetix {

Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  return A.colPivHouseholderQr().solve(b);
}

}  // namespace kinetix
