#include "model/closure/mobility.hpp"

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "model/base/decompositions.hpp"
#include "model/base/invalid_input.hpp"
#include "model/closure/closure.hpp"

namespace kinetix::model {
namespace {

int gruebler(int per_body, int bodies, int joints, int dofs) {
  if (bodies < 1 || joints < 0 || dofs < 0)
    throw InvalidInput(
        "a linkage has at least one body and no negative number of joints or degrees of freedom");
  return per_body * (bodies - 1 - joints) + dofs;
}

}  // namespace

int gruebler_planar(int bodies, int joints, int dofs) { return gruebler(3, bodies, joints, dofs); }

int gruebler_spatial(int bodies, int joints, int dofs) { return gruebler(6, bodies, joints, dofs); }

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
constexpr std::size_t max_bodies_for_dense = 20;

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
                     (method == NullSpaceMethod::automatic && state.size() <= max_bodies_for_dense);
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

namespace {

using Eigen::Vector3d;

double largest_entry(const VectorXd& v) {
  return v.allFinite() ? v.lpNorm<Eigen::Infinity>() : std::numeric_limits<double>::infinity();
}

/// The hinge with the fastest turn in a first-order motion from rest, and its rate (rad per unit twist).
struct FastestHinge {
  int hinge = 0;
  double rate = 0;
};

FastestHinge fastest_hinge(const Linkage& s, const VectorXd& twists) {
  FastestHinge fastest;
  for (std::size_t k = 0; k < s.hinges.size(); ++k) {
    const RestHinge& h = s.hinges[k];
    const Vector3d relative = twists.segment<3>(6 * h.upper) - twists.segment<3>(6 * h.lower);
    const double rate = relative.dot(h.axis);
    if (std::abs(rate) > std::abs(fastest.rate)) fastest = {static_cast<int>(k), rate};
  }
  return fastest;
}

/// States along the motion from flat to a turn of the driven hinge.
struct Motion {
  State end;
  bool closed = false;    ///< all states are closed
  bool converged = true;  ///< every search converged
  double turn = 0;
  double misfit = 0;  ///< largest misfit during the motion
};

/// Drives the fastest hinge of a first-order motion from rest.
Motion follow(const Linkage& s, const VectorXd& direction, const MobilityOptions& options) {
  const auto [hinge, rate] = fastest_hinge(s, direction);
  const double step = options.turn / options.steps;
  Motion motion{rest_state(s)};
  if (rate == 0) return motion;
  motion.end = retract_straight(s, motion.end, step / std::abs(rate) * direction);
  motion.closed = true;
  for (int k = 1; k <= options.steps && motion.converged; ++k) {
    motion.turn = k * step;
    Closure reached = solve_closure(s, motion.end, {HingeTurn{hinge, std::copysign(motion.turn, rate)}});
    motion.misfit = std::max(motion.misfit, reached.residual);
    motion.converged = reached.converged;
    motion.closed = motion.closed && reached.residual <= options.closed;
    motion.end = std::move(reached.state);
  }
  return motion;
}

Motion follow_closed_form(const Linkage& s, const ExactMotion& exact, const MobilityOptions& options) {
  Motion motion;
  for (int k = 1; k <= options.steps; ++k) {
    motion.turn = options.turn * k / options.steps;
    motion.end = exact.at(motion.turn / 2);
    motion.misfit = std::max(motion.misfit, largest_entry(closure_residual(s, motion.end)));
  }
  motion.closed = motion.misfit <= options.closed;
  return motion;
}

/// Returns the directions to drive: each first-order motion and random mixtures, with both signs.
std::vector<VectorXd> directions(const Eigen::MatrixXd& basis, const MobilityOptions& options) {
  std::vector<VectorXd> all;
  const auto add = [&](const VectorXd& direction) {
    all.push_back(direction);
    all.push_back(-direction);
  };
  for (Eigen::Index k = 0; k < basis.cols(); ++k) add(basis.col(k));
  if (basis.cols() < 2) return all;
  std::mt19937 random(options.seed);
  std::normal_distribution<double> normal;
  for (int k = 0; k < options.combinations; ++k)
    add(basis * VectorXd::NullaryExpr(basis.cols(), [&] { return normal(random); }).normalized());
  return all;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

/// Examination of one structure.
class Examination {
 public:
  Examination(const Linkage& structure, const ExactMotion& exact, const MobilityOptions& options)
      : s_(structure), exact_(exact), options_(options) {}

  Mobility run() {
    count();
    const NullSpace flat = null_space(s_, rest_state(s_));
    found_.dofs_flat = flat.dofs();
    if (found_.dofs_flat == 0) return conclude(Verdict::not_mobile, "flat has no first-order motion");
    found_.misfit = std::numeric_limits<double>::infinity();
    if (exact_ && continues_in_closed_form()) return std::move(found_);
    bool all_converged = true;
    for (const VectorXd& direction : directions(flat.basis, options_)) {
      const Motion motion = follow(s_, direction, options_);
      if (goes_on(motion, "driven from flat, all hinges stay closed")) return std::move(found_);
      all_converged = all_converged && motion.converged;
    }
    return conclude_without_motion(all_converged);
  }

 private:
  void count() {
    const int bodies = static_cast<int>(s_.bodies.size()), hinges = static_cast<int>(s_.hinges.size());
    if (all_vertical(s_)) found_.gruebler_planar = gruebler_planar(bodies, hinges, hinges);
    found_.gruebler_spatial = gruebler_spatial(bodies, hinges, hinges);
  }

  bool continues_in_closed_form() {
    return goes_on(follow_closed_form(s_, exact_, options_),
                   "the analytic motion of " + exact_.name + " closes all hinges");
  }

  /// Returns true if the motion continues. A closed end state without a first-order motion is a second
  /// assembly, not a motion.
  bool goes_on(const Motion& motion, const std::string& why) {
    const int dofs = motion.closed ? null_space(s_, motion.end).dofs() : 0;
    if (dofs == 0 && motion.misfit >= found_.misfit) return false;
    found_.misfit = motion.misfit;
    found_.turn = motion.turn;
    if (dofs == 0) return false;
    found_.dofs_along = dofs;
    conclude(Verdict::mobile, why + " up to a turn of " + number(motion.turn) + " rad");
    return true;
  }

  Mobility conclude_without_motion(bool all_converged) {
    const std::string misfit =
        "a misfit of " + number(found_.misfit) + " at a turn of " + number(found_.turn) + " rad";
    if (!all_converged)
      return conclude(Verdict::undecided, "a search along a first-order motion did not converge");
    if (found_.dofs_flat == 1)
      return conclude(Verdict::not_mobile, "the one first-order motion of flat leaves " + misfit);
    return conclude(
        Verdict::undecided,
        "none of the first-order motions of flat that were tried continues; the best leaves " + misfit);
  }

  Mobility conclude(Verdict verdict, const std::string& why) {
    found_.verdict = verdict;
    found_.why = why;
    return found_;
  }

  const Linkage& s_;
  const ExactMotion& exact_;
  const MobilityOptions& options_;
  Mobility found_;
};

}  // namespace

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::mobile:
      return "mobile";
    case Verdict::not_mobile:
      return "not mobile";
    case Verdict::undecided:
      break;
  }
  return "undecided";
}

void MobilityOptions::validate() const {
  if (!(turn > 0) || !(turn <= 1)) throw InvalidInput("turn must lie in (0, 1] rad");
  if (steps < 2) throw InvalidInput("steps must be at least 2");
  if (!(closed > 0)) throw InvalidInput("closed must be positive");
  if (combinations < 0) throw InvalidInput("combinations must not be negative");
}

Mobility mobility(const Linkage& structure, const ExactMotion& exact, const MobilityOptions& options) {
  options.validate();
  return Examination(structure, exact, options).run();
}

}  // namespace kinetix::model
