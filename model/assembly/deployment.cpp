#include "model/assembly/deployment.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "model/base/decompositions.hpp"
#include "model/closure/closure.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

// Weight of the pull relative to the squared singular values of closure (1e-4 to 10). It sets the softness of hinges
// against the pull before the multipliers close them. A much smaller weight would cost the factor its digits.
constexpr double pull_weight = 1e-6;
// Times pull_weight: weight of turns without a pull, which keeps them in place
constexpr double rest_weight = 1e-3;
constexpr double longest_step = 0.3;  // rad, cell edges, of a body: beyond it the linearisation is not valid
constexpr double min_step = 1e-11;    // rad, cell edges, of a body: no better state is near
constexpr double max_damping = 1e3;   // times pull_weight: steps with more damping make no progress

/// Mean square arm of the tetrahedron's four points about an axis, cell edges^2: weight of a turn squared relative to
/// a shift squared.
constexpr double turn_square = 2.0 / 3.0 * pull_arm * pull_arm;

Vector3d turn_to(const Eigen::Matrix3d& R, const Eigen::Matrix3d& to) {
  Vector3d sum = Vector3d::Zero();
  for (int k = 0; k < 3; ++k) sum += R.col(k).cross(to.col(k));
  return 0.5 * sum;
}

/// Returns the mean square distance of the pulled points of a body from their targets, cell edges squared.
double off_square(const Pose& pose, const Pose& to, bool turns, double edge_mm) {
  const double shift = ((pose.p - to.p) / edge_mm).squaredNorm();
  return turns ? shift + 0.5 * turn_square * (pose.R - to.R).squaredNorm() : shift;
}

/// Search for the closed state nearest to a pull.
class NearestClosed {
 public:
  NearestClosed(const Linkage& linkage, const DeploymentOptions& options)
      : s_(linkage), options_(options), multipliers_(VectorXd::Zero(6 * linkage.hinges.size())) {}

  /// @return true if its hinges are closed
  bool find(const Pull& pull, State& state) {
    multipliers_.setZero();
    double damping = 0;
    for (int k = 0; k < options_.iterations; ++k) {
      const VectorXd closure = closure_residual(s_, state);
      if (!closure.allFinite()) return false;
      linearise(pull, state, closure);
      VectorXd step;
      State next;
      for (;; damping = std::max(4 * damping, 1.0)) {
        if (damping > max_damping) return close(state);
        step = solve(damping);
        if (!step.allFinite()) continue;
        if (const double longest = step.lpNorm<Eigen::Infinity>(); longest > longest_step)
          step *= longest_step / longest;
        next = retract_straight(s_, state, step);
        if (merit(pull, next) <= merit(pull, state) + 1e-15) break;
      }
      damping /= 4;
      state = std::move(next);
      const VectorXd now = closure_residual(s_, state);
      multipliers_ += now;
      if (step.lpNorm<Eigen::Infinity>() < min_step || (is_closed(now) && still(step))) break;
    }
    return close(state);
  }

 private:
  bool is_closed(const VectorXd& closure) const {
    return closure.lpNorm<Eigen::Infinity>() <= options_.closed;
  }
  /// Closes the state if the multipliers approached it without end. This happens for motions of the first order only.
  /// It also happens for structures that move only due to rounding in files, whose hinges then stay slightly open.
  bool close(State& state) const {
    if (is_closed(closure_residual(s_, state))) return true;
    Closure closed = solve_closure(s_, state, {});
    if (!(closed.residual <= options_.limit)) return false;
    state = std::move(closed.state);
    return true;
  }
  /// Returns true if a step is far below the resolution of users and simulation.
  static bool still(const VectorXd& step) { return step.lpNorm<Eigen::Infinity>() < 1e-8; }

  /// Returns the multipliers' function: half the squared misfits with the multipliers added, plus the pull.
  double merit(const Pull& pull, const State& state) const {
    double off = 0;
    for (std::size_t b = 0; b < state.size(); ++b)
      off += off_square(state[b], pull.to[b], pull.turns, s_.size.edge_mm);
    return 0.5 * ((closure_residual(s_, state) + multipliers_).squaredNorm() + pull_weight * off);
  }

  void linearise(const Pull& pull, const State& state, const VectorXd& closure) {
    const SparseMatrix jacobian = closure_jacobian(s_, state);
    gradient_ = jacobian.transpose() * (closure + multipliers_);
    weights_ = VectorXd::Constant(gradient_.size(), pull_weight);
    for (std::size_t b = 0; b < state.size(); ++b) {
      weights_.segment<3>(6 * b).setConstant(pull_weight * (pull.turns ? turn_square : rest_weight));
      gradient_.segment<3>(6 * b + 3) += pull_weight * (state[b].p - pull.to[b].p) / s_.size.edge_mm;
      if (pull.turns)
        gradient_.segment<3>(6 * b) -= pull_weight * turn_square * turn_to(state[b].R, pull.to[b].R);
    }
    normal_ = jacobian.transpose() * jacobian;
  }

  VectorXd solve(double damping) {
    SparseMatrix damped = normal_;
    SparseMatrix diagonal(normal_.rows(), normal_.cols());
    diagonal.setIdentity();
    damped += SparseMatrix(((1 + damping) * weights_).asDiagonal() * diagonal);
    if (!factor_.compute(damped)) return VectorXd::Constant(gradient_.size(), NAN);
    return -factor_.solve(gradient_);
  }

  const Linkage& s_;
  const DeploymentOptions& options_;
  VectorXd multipliers_;  ///< divided by pull_weight
  VectorXd gradient_, weights_;
  SparseMatrix normal_;
  SparseFactor factor_;
};

int steps_of(const Linkage& linkage, const Pull& pull, const DeploymentOptions& options) {
  double steps = 1;
  for (std::size_t b = 0; b < pull.to.size(); ++b) {
    const Vector3d shift = (pull.to[b].p - linkage.rest_position(static_cast<int>(b))) / linkage.size.edge_mm;
    if (pull.turns) steps = std::max(steps, Eigen::AngleAxisd(pull.to[b].R).angle() / options.turn);
    if (!pull.turns) steps = std::max(steps, shift.norm() / options.shift);
  }
  return static_cast<int>(std::ceil(steps));
}

void measure(const Linkage& linkage, const Pull& pull, Deployment& out) {
  constexpr double shown = 0.5 / pull_arm;  // ratio to the arms of the pull: tiles are about a cell edge wide
  const State& last = out.states.back();
  const std::vector<Vector3d> arms = pull_points(pull.turns);
  double sum = 0;
  for (std::size_t b = 0; b < last.size(); ++b)
    for (const Vector3d& arm : arms) {
      const Vector3d off =
          (last[b].p - pull.to[b].p) / linkage.size.edge_mm + shown * (last[b].R - pull.to[b].R) * arm;
      sum += off.squaredNorm() / static_cast<double>(arms.size());
      out.off_max = std::max(out.off_max, off.norm());
    }
  out.off_rms = std::sqrt(sum / static_cast<double>(last.size()));
}

/// Returns the pulled points of all bodies, mm.
Eigen::Matrix3Xd pulled_places(const State& state, bool turns, double edge_mm) {
  const std::vector<Vector3d> arms = pull_points(turns);
  Eigen::Matrix3Xd out(3, state.size() * arms.size());
  Eigen::Index column = 0;
  for (const Pose& pose : state)
    for (const Vector3d& arm : arms) out.col(column++) = pose.p + edge_mm * pose.R * arm;
  return out;
}

}  // namespace

std::vector<Vector3d> pull_points(bool turns) {
  if (!turns) return {Vector3d::Zero()};
  const double c = pull_arm / std::sqrt(3.0);
  return {{c, c, c}, {c, -c, -c}, {-c, c, -c}, {-c, -c, c}};
}

Pull aligned_pull(const Linkage& linkage, Pull pull) {
  const double edge = linkage.size.edge_mm;
  const Eigen::Matrix3Xd from = pulled_places(pull.to, pull.turns, edge),
                         to = pulled_places(rest_state(linkage), pull.turns, edge);
  const Eigen::Matrix4d motion = rigid_fit(from, to);
  pull.to = moved(pull.to, {motion.topLeftCorner<3, 3>(), motion.topRightCorner<3, 1>()});
  return pull;
}

Pull pull_at(const Linkage& linkage, const Pull& pull, double share) {
  Pull out = pull;
  for (std::size_t b = 0; b < out.to.size(); ++b) {
    const Vector3d rest = linkage.rest_position(static_cast<int>(b));
    const Eigen::AngleAxisd turn(pull.to[b].R);
    out.to[b].p = rest + share * (pull.to[b].p - rest);
    out.to[b].R = Eigen::AngleAxisd(share * turn.angle(), turn.axis()).toRotationMatrix();
  }
  return out;
}

Deployment deploy(const Linkage& linkage, const Pull& pull, const DeploymentOptions& options) {
  Deployment out;
  out.states.push_back(rest_state(linkage));
  out.shares.push_back(0);
  NearestClosed nearest(linkage, options);
  const int steps = steps_of(linkage, pull, options);
  State state = out.states.back();
  for (int k = 1; k <= steps && !(options.stop && options.stop()); ++k) {
    const double share = static_cast<double>(k) / steps;
    if (!nearest.find(pull_at(linkage, pull, share), state)) break;
    const HingeGaps gaps = hinge_gaps(linkage, state);
    out.gap = std::max(out.gap, gaps.max);
    out.axis_gap = std::max(out.axis_gap, gaps.axis_max);
    out.states.push_back(state);
    out.shares.push_back(share);
  }
  out.reached = out.shares.back() == 1;
  measure(linkage, pull, out);
  return out;
}

double mean_half_turn(const Linkage& linkage, const State& state) {
  double sum = 0;
  for (const RestHinge& h : linkage.hinges)
    sum += 0.5 * Eigen::AngleAxisd(Eigen::Matrix3d(state[h.lower].R.transpose() * state[h.upper].R)).angle();
  return sum / static_cast<double>(linkage.hinges.size());
}

}  // namespace kinetix::model
