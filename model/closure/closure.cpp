#include "model/closure/closure.hpp"

#include <cmath>
#include <limits>

#include "model/base/decompositions.hpp"
#include "model/base/invalid_input.hpp"
#include "model/hinge/hinge_turn.hpp"

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

namespace {

// Rad: below, the next term of the series is less than 2e-15, and the formulas lose half their digits.
constexpr double small_angle = 1e-3;

/// Returns the integral of exp(s omega) v over s from 0 to 1.
Vector3d along_arc(const Vector3d& omega, const Vector3d& v) {
  const double squared = omega.squaredNorm(), angle = std::sqrt(squared);
  const double a = angle < small_angle ? 0.5 - squared / 24 : (1 - std::cos(angle)) / squared;
  const double b =
      angle < small_angle ? 1.0 / 6 - squared / 120 : (angle - std::sin(angle)) / (squared * angle);
  return v + a * omega.cross(v) + b * omega.cross(omega.cross(v));
}

}  // namespace

State retract(const Linkage& structure, const State& state, const Eigen::VectorXd& twists) {
  State out = state;
  for (std::size_t b = 0; b < state.size(); ++b) {
    const Vector3d omega = twists.segment<3>(6 * b), v = twists.segment<3>(6 * b + 3);
    const Eigen::AngleAxisd turn(omega.norm(), omega.stableNormalized());
    out[b].R = Eigen::Quaterniond(turn * state[b].R).normalized().toRotationMatrix();
    out[b].p += structure.size.edge_mm * along_arc(omega, v);
  }
  return out;
}

namespace {

void append_row(Entries& entries, int row, int column, const Vector3d& gradient) {
  for (int c = 0; c < 3; ++c) entries.emplace_back(row, column + c, gradient[c]);
}

RelativeTurn relative_turn(const RestHinge& hinge, const State& state) {
  return {hinge, state[hinge.lower], state[hinge.upper]};
}

Vector3d turn_since(const Pose& from, const Pose& now) {
  const Eigen::AngleAxisd turn(now.R * from.R.transpose());
  return turn.angle() * turn.axis();
}

/// Returns the transposed inverse of the left Jacobian of the exponential map at `turn`, applied to v.
Vector3d rate_of_logarithm(const Vector3d& turn, const Vector3d& v) {
  const double angle = turn.norm();
  const double c =
      angle < 1e-4 ? 1.0 / 12 : 1 / (angle * angle) - (1 + std::cos(angle)) / (2 * angle * std::sin(angle));
  return v + 0.5 * turn.cross(v) + c * turn.cross(turn.cross(v));
}

double residual(const HingeTurn& drive, const Linkage& structure, const State& state) {
  return std::remainder(hinge_turn(structure, state, drive.hinge) - drive.angle, 2 * pi);
}

double residual(const BodyPush& drive, const Linkage& structure, const State& state) {
  const Pose& now = state[drive.body];
  const Vector3d shift = (now.p - drive.from.p) / structure.size.edge_mm;
  return drive.direction.omega.dot(turn_since(drive.from, now)) + drive.direction.v.dot(shift) - drive.amount;
}

void append_gradient(const HingeTurn& drive, const Linkage& structure, const State& state, int row,
                     Entries& entries) {
  const RestHinge& hinge = structure.hinges[drive.hinge];
  const Vector3d gradient = relative_turn(hinge, state).rate_in_space();
  append_row(entries, row, 6 * hinge.upper, gradient);
  append_row(entries, row, 6 * hinge.lower, -gradient);
}

void append_gradient(const BodyPush& drive, const Linkage&, const State& state, int row, Entries& entries) {
  const Vector3d turn = turn_since(drive.from, state[drive.body]);
  append_row(entries, row, 6 * drive.body, rate_of_logarithm(turn, drive.direction.omega));
  append_row(entries, row, 6 * drive.body + 3, drive.direction.v);
}

void check(const HingeTurn& drive, const Linkage& structure) {
  if (drive.hinge < 0 || drive.hinge >= static_cast<int>(structure.hinges.size()))
    throw InvalidInput("the driven hinge does not exist");
  if (!(std::abs(drive.angle) < pi))
    throw InvalidInput("a driven hinge turns by less than 180 deg to either side");
}

void check(const BodyPush& drive, const Linkage& structure) {
  if (drive.body < 0 || drive.body >= static_cast<int>(structure.bodies.size()))
    throw InvalidInput("the pushed body does not exist");
  const Twist& d = drive.direction;
  if (!(d.omega.squaredNorm() + d.v.squaredNorm() > 0) || !d.omega.allFinite() || !d.v.allFinite())
    throw InvalidInput("the direction of a push must be finite and not zero");
  if (!std::isfinite(drive.amount)) throw InvalidInput("the amount of a push must be finite");
}

}  // namespace

void validate(const ClosureDrive& drive, const Linkage& structure) {
  std::visit([&](const auto& d) { check(d, structure); }, drive);
}

double hinge_turn(const Linkage& structure, const State& state, int hinge) {
  return relative_turn(structure.hinges[hinge], state).angle();
}

double turn_distance(const Linkage& structure, const State& a, const State& b) {
  double largest = 0;
  for (int h = 0; h < static_cast<int>(structure.hinges.size()); ++h) {
    const double turn = hinge_turn(structure, a, h) - hinge_turn(structure, b, h);
    largest = std::max(largest, std::abs(std::remainder(turn, 2 * pi)));
  }
  return largest;
}

double drive_residual(const ClosureDrive& drive, const Linkage& structure, const State& state) {
  return std::visit([&](const auto& d) { return residual(d, structure, state); }, drive);
}

void append_drive_gradient(const ClosureDrive& drive, const Linkage& structure, const State& state, int row,
                           Entries& entries) {
  std::visit([&](const auto& d) { append_gradient(d, structure, state, row, entries); }, drive);
}

namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

// Weight of a drive as a multiple of a hinge's: hinges that cannot close give way and the drive does not. The
// normal equations contain its square, so a much larger weight would cost them their digits.
constexpr double drive_weight = 1000;
// Added to each diagonal entry of the normal equations, where entries are about 1. Without it they are
// singular if the structure moves freely apart from its drive. A larger value would slow the last steps.
constexpr double min_damping = 1e-13;
// Largest value added to the diagonal entries of about 1. Steps with more damping make no progress, and the
// search ends.
constexpr double max_damping = 1e6;
// Largest step of a body, rad or cell edges. Beyond it the linearisation is not valid.
constexpr double longest_step = 0.5;

/// Returns NaN if an entry is not finite.
double largest(const VectorXd& v) {
  return v.allFinite() ? v.lpNorm<Eigen::Infinity>() : std::numeric_limits<double>::quiet_NaN();
}

/// Hinges and drives together, with body 0 held.
class DrivenSystem {
 public:
  DrivenSystem(const Linkage& structure, const std::vector<ClosureDrive>& drives)
      : s_(structure), drives_(drives) {}

  VectorXd residual(const State& state) const {
    const VectorXd hinges = closure_residual(s_, state);
    VectorXd all(rows());
    all.head(hinges.size()) = hinges;
    for (std::size_t k = 0; k < drives_.size(); ++k)
      all[hinges.size() + static_cast<Eigen::Index>(k)] = drive_residual(drives_[k], s_, state);
    return all;
  }

  SparseMatrix jacobian(const State& state) const {
    auto entries = closure_entries(s_, state);
    int row = 6 * static_cast<int>(s_.hinges.size());
    for (const ClosureDrive& drive : drives_) append_drive_gradient(drive, s_, state, row++, entries);
    std::erase_if(entries, [](const auto& e) { return e.col() < 6; });
    for (auto& e : entries) e = {e.row(), e.col() - 6, e.value()};
    SparseMatrix jacobian(rows(), 6 * (static_cast<Eigen::Index>(s_.bodies.size()) - 1));
    jacobian.setFromTriplets(entries.begin(), entries.end());
    return jacobian;
  }

  VectorXd squared_weights() const {
    VectorXd weights = VectorXd::Ones(rows());
    weights.tail(static_cast<Eigen::Index>(drives_.size())).setConstant(drive_weight * drive_weight);
    return weights;
  }

  State retract(const State& state, const VectorXd& step) const {
    VectorXd twists = VectorXd::Zero(6 + step.size());
    twists.tail(step.size()) = step;
    return retract_straight(s_, state, twists);
  }

 private:
  Eigen::Index rows() const { return static_cast<Eigen::Index>(6 * s_.hinges.size() + drives_.size()); }

  const Linkage& s_;
  const std::vector<ClosureDrive>& drives_;
};

/// A search from one start.
class Search {
 public:
  Search(const DrivenSystem& system, const State& start, const ClosureOptions& options)
      : system_(system),
        options_(options),
        weights_(system.squared_weights()),
        residual_(system.residual(start)) {
    reached_.state = start;
  }

  Closure run() {
    if (!residual_.allFinite()) return finish(false, "the start holds a number that is not finite");
    while (largest(residual_) > 0.01 * options_.tolerance) {
      if (reached_.iterations++ >= options_.max_iterations) return finish(false, "the iterations ran out");
      linearise();
      while (!step()) {
        if (damping_ > max_damping) return finish(true, "no step lowers the misfit");
        damping_ = std::max(10 * damping_, 1e-8);
      }
      if (last_step_ <= options_.step_tolerance) return finish(true, "no better state is near");
    }
    return finish(true, "all hinges closed");
  }

 private:
  void linearise() {
    const SparseMatrix jacobian = system_.jacobian(reached_.state);
    gradient_ = jacobian.transpose() * weights_.cwiseProduct(residual_);
    normal_ = jacobian.transpose() * (weights_.asDiagonal() * jacobian);
  }

  /// Returns false if the damping must grow.
  bool step() {
    SparseMatrix damped = normal_;
    damped.diagonal().array() += damping_ + min_damping;
    if (!factor_.compute(damped)) return false;
    const VectorXd step = -factor_.solve(gradient_);
    if (!step.allFinite() || largest(step) > longest_step) return false;
    last_step_ = largest(step);
    return accept(system_.retract(reached_.state, step)) || last_step_ <= options_.step_tolerance;
  }

  bool accept(State candidate) {
    VectorXd residual = system_.residual(candidate);
    if (!(misfit(residual) < misfit(residual_))) return false;
    reached_.state = std::move(candidate);
    residual_ = std::move(residual);
    damping_ /= 10;
    return true;
  }

  double misfit(const VectorXd& residual) const { return weights_.dot(residual.cwiseAbs2()); }

  Closure finish(bool converged, const std::string& why) {
    reached_.converged = converged;
    reached_.residual = largest(residual_);
    reached_.closed = reached_.residual <= options_.tolerance;
    reached_.why = why;
    return std::move(reached_);
  }

  const DrivenSystem& system_;
  const ClosureOptions& options_;
  const VectorXd weights_;
  Closure reached_;
  VectorXd residual_, gradient_;
  SparseMatrix normal_;
  SparseFactor factor_;
  double damping_ = 1e-6;
  double last_step_ = 0;
};

}  // namespace

void ClosureOptions::validate() const {
  if (max_iterations < 0) throw InvalidInput("max_iterations must not be negative");
  if (!(tolerance > 0)) throw InvalidInput("tolerance must be positive");
  if (!(step_tolerance > 0)) throw InvalidInput("step_tolerance must be positive");
}

Closure solve_closure(const Linkage& structure, const State& start, const std::vector<ClosureDrive>& drives,
                      const ClosureOptions& options) {
  options.validate();
  for (const ClosureDrive& drive : drives) validate(drive, structure);
  if (start.size() != structure.bodies.size())
    throw InvalidInput("a closure search starts from one pose for each body");
  return Search(DrivenSystem(structure, drives), start, options).run();
}

}  // namespace kinetix::model
