#include "model/closure/closure_solver.hpp"

#include <limits>

#include "model/base/invalid_input.hpp"
#include "model/base/sparse_factor.hpp"
#include "model/closure/closure.hpp"

namespace kinetix::model {
namespace {

using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

// Weight of a drive as a multiple of a hinge's: hinges that cannot close give way and the drive does not. The
// normal equations contain its square, so a much larger weight would cost them their digits.
constexpr double drive_weight = 1000;
// Added to each diagonal entry of the normal equations, where entries are about 1. Without it they are
// singular if the structure moves freely apart from its drive. A larger value would slow the last steps.
constexpr double least_damping = 1e-13;
// Largest value added to the diagonal entries of about 1. Steps with more damping make no progress, and the
// search ends.
constexpr double most_damping = 1e6;
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
        if (damping_ > most_damping) return finish(true, "no step lowers the misfit");
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
    damped.diagonal().array() += damping_ + least_damping;
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
