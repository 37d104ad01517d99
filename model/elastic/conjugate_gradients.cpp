#include "model/elastic/conjugate_gradients.hpp"

namespace kinetix::model {
namespace {

using Eigen::VectorXd;
using Outcome = TruncatedStep::Outcome;

// Ratio to the first residual, in the norm of the preconditioner. This is as accurate as a factor of the
// tangent for one step of Newton's method. The next step makes further iterations unnecessary.
constexpr double solved = 0.02;
constexpr double good_enough = 0.3;  // after the last iteration; above it, a new factor is faster

}  // namespace

TruncatedStep conjugate_gradients(TangentStiffness& tangent, const VectorXd& gradient, int most) {
  VectorXd x = VectorXd::Zero(gradient.size()), residual = -gradient;
  VectorXd direction = tangent.solve(residual);
  const double first = residual.dot(direction);
  double size = first;
  for (int k = 0; k < most && size > 0; ++k) {
    const VectorXd curved = tangent.multiply(direction);
    const double curvature = direction.dot(curved);
    if (!(curvature > 0)) {
      if (k > 0) direction *= x.norm() / direction.norm();
      return {x + direction, Outcome::negative};
    }
    const double length = size / curvature;
    x += length * direction;
    residual -= length * curved;
    const VectorXd next = tangent.solve(residual);
    const double next_size = residual.dot(next);
    if (next_size <= solved * solved * first) return {x, Outcome::solved};
    direction = next + next_size / size * direction;
    size = next_size;
  }
  return {x, size <= good_enough * good_enough * first ? Outcome::solved : Outcome::slow};
}

}  // namespace kinetix::model
