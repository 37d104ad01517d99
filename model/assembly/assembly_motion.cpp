#include "model/assembly/assembly_motion.hpp"

#include <cmath>

#include "model/base/decompositions.hpp"
#include "model/closure/closure.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

// Squared singular value at which the wanted turns and closure have equal weight. It is far below the proper ones of
// structures (1e-4), and far above those that rounding to float leaves of a mechanism's zero (1e-11).
constexpr double wanted_weight = 1e-8;
constexpr int max_bodies = 150;  // bodies, for a dense decomposition: about a second

double turn_rate(const Linkage& s, const VectorXd& twists, std::size_t k) {
  const RestHinge& h = s.hinges[k];
  return (twists.segment<3>(6 * h.upper) - twists.segment<3>(6 * h.lower)).dot(h.axis);
}

VectorXd wanted_turns(const Linkage& s) {
  VectorXd wanted = VectorXd::Zero(6 * static_cast<Eigen::Index>(s.bodies.size()));
  for (std::size_t b = 0; b < s.bodies.size(); ++b) wanted.segment<3>(6 * b) = s.bodies[b].first_turn();
  return wanted;
}

/// Returns the weights of turns and shifts. Shifts have little weight, because bodies must follow their turns.
VectorXd turn_weights(const Linkage& s) {
  VectorXd weights = VectorXd::Constant(6 * static_cast<Eigen::Index>(s.bodies.size()), 1e-3 * wanted_weight);
  for (std::size_t b = 0; b < s.bodies.size(); ++b) weights.segment<3>(6 * b).setConstant(wanted_weight);
  return weights;
}

Linkage with_first_hinges(const Linkage& linkage, std::size_t count) {
  Linkage out = linkage;
  out.hinges.resize(count);
  return out;
}

/// Returns the last state if there is one after rest, otherwise a step along the first motion.
State start_of(const Linkage& linkage, const AssemblyMotion& motion, const FirstMotion& first, int hinge,
               double step) {
  const std::size_t n = motion.states.size();
  if (n > 1) return motion.states.back();
  VectorXd twists(6 * linkage.bodies.size());
  for (std::size_t b = 0; b < linkage.bodies.size(); ++b)
    twists.segment<6>(6 * b) << first.twists[b].omega, first.twists[b].v;
  const double rate = turn_rate(linkage, twists, hinge);
  if (!(std::abs(rate) > 1e-6)) return motion.states.back();
  return retract_straight(linkage, motion.states.back(), step / rate * twists);
}

}  // namespace

FirstMotion first_motion(const Linkage& linkage) {
  const Eigen::SparseMatrix<double> J = closure_jacobian(linkage, rest_state(linkage));
  const VectorXd weights = turn_weights(linkage);
  Eigen::SparseMatrix<double> normal = J.transpose() * J;
  Eigen::SparseMatrix<double> diagonal(normal.rows(), normal.cols());
  diagonal.setIdentity();
  diagonal = weights.asDiagonal() * diagonal;
  normal += diagonal;
  const SparseFactor solver(normal);
  const VectorXd twists = solver.solve(weights.cwiseProduct(wanted_turns(linkage)));
  FirstMotion out;
  double turns = 0;
  for (std::size_t b = 0; b < linkage.bodies.size(); ++b)
    out.twists.push_back({twists.segment<3>(6 * b), twists.segment<3>(6 * b + 3)});
  for (std::size_t k = 0; k < linkage.hinges.size(); ++k) {
    const double rate = turn_rate(linkage, twists, k);
    turns += rate * rate;
    if (linkage.hinges[k].ball || std::abs(rate) <= std::abs(out.rate) * (1 + 1e-6)) continue;
    out.rate = rate;
    out.fastest = static_cast<int>(k);
  }
  out.strain = turns > 0 ? std::sqrt((J * twists).squaredNorm() / turns) : 1;
  return out;
}

std::optional<int> degrees_of_freedom(const Linkage& linkage, const State& state, std::size_t hinges,
                                      double smallest) {
  if (static_cast<int>(linkage.bodies.size()) > max_bodies) return std::nullopt;
  const Eigen::SparseMatrix<double> J = closure_jacobian(with_first_hinges(linkage, hinges), state);
  const Eigen::MatrixXd normal = Eigen::MatrixXd(J.transpose() * J);
  const VectorXd squares = symmetric_eigenvalues(normal);
  return static_cast<int>((squares.array() < smallest * smallest).count()) - 6;
}

int first_rigid_hinge(const Linkage& linkage, double smallest) {
  std::size_t moves = 0, rigid = linkage.hinges.size();
  while (rigid - moves > 1) {
    const std::size_t middle = (moves + rigid) / 2;
    (degrees_of_freedom(linkage, rest_state(linkage), middle, smallest).value_or(0) > 0 ? moves : rigid) =
        middle;
  }
  return static_cast<int>(rigid) - 1;
}

AssemblyMotion follow_turn(const Linkage& linkage, const FirstMotion& first, int hinge, double turn,
                           const AssemblyMotionOptions& options) {
  AssemblyMotion motion{{rest_state(linkage)}, {0}};
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / options.step)));
  for (int k = 1; k <= steps; ++k) {
    if (options.stop && options.stop()) return motion;
    const double at = turn * k / steps;
    const Closure closed =
        solve_closure(linkage, start_of(linkage, motion, first, hinge, turn / steps), {HingeTurn{hinge, at}});
    const HingeGaps gaps = hinge_gaps(linkage, closed.state);
    if (!(gaps.max <= options.limit && gaps.axis_max <= options.limit)) {
      motion.broken = gaps.max >= gaps.axis_max ? gaps.worst_hinge : gaps.worst_axis;
      motion.broken_turn = at;
      return motion;
    }
    motion.gap = std::max(motion.gap, gaps.max);
    motion.axis_gap = std::max(motion.axis_gap, gaps.axis_max);
    motion.states.push_back(closed.state);
    motion.turns.push_back(at);
  }
  motion.reached = true;
  return motion;
}

}  // namespace kinetix::model
