#include "sim/start_motion.hpp"

#include <random>

#include "model/base/decompositions.hpp"
#include "model/closure/null_space.hpp"

namespace kinetix::sim {
namespace {

constexpr double least_share = 0.5;          // of the wanted spins: a motion with less is a different one
constexpr double weight_of_the_rest = 1e-6;  // relative to that of the spins: decides only what they leave
                                             // open

std::vector<model::Twist> bare_spins(const model::Linkage& structure) {
  std::vector<model::Twist> twists(structure.bodies.size());
  for (std::size_t b = 0; b < twists.size(); ++b) twists[b].omega = structure.bodies[b].first_turn();
  return twists;
}

/// Returns the internal motions as columns, then the six of the whole as a rigid body.
Eigen::MatrixXd all_motions(const model::Linkage& structure) {
  const Eigen::MatrixXd internal = null_space(structure, rest_state(structure)).basis;
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(6 * structure.bodies.size(), internal.cols() + 6);
  motions.leftCols(internal.cols()) = internal;
  for (std::size_t b = 0; b < structure.bodies.size(); ++b) {
    const Eigen::Vector3d r = structure.rest_position(static_cast<int>(b)) / structure.size.edge_mm;
    auto rigid = motions.block<6, 6>(6 * b, internal.cols());
    rigid.setIdentity();
    rigid.block<3, 3>(3, 0) << 0, r.z(), -r.y(), -r.z(), 0, r.x(), r.y(), -r.x(), 0;
  }
  return motions;
}

/// Finds the motion nearest to the wanted spins by least squares. Bodies that turn about z count with their z
/// part. Everything else is kept small if the spins leave a choice.
Eigen::VectorXd nearest_motion(const model::Linkage& structure, const Eigen::MatrixXd& motions) {
  Eigen::VectorXd weight = Eigen::VectorXd::Constant(motions.rows(), weight_of_the_rest);
  Eigen::VectorXd wanted = Eigen::VectorXd::Zero(motions.rows());
  for (std::size_t b = 0; b < structure.bodies.size(); ++b) {
    if (structure.bodies[b].spin) weight.segment<3>(6 * b).setOnes();
    weight[6 * b + 2] = 1;
    wanted.segment<3>(6 * b) = structure.bodies[b].first_turn();
  }
  const Eigen::MatrixXd weighted = weight.asDiagonal() * motions;
  return motions * SymmetricFactor(motions.transpose() * weighted).solve(weighted.transpose() * wanted);
}

}  // namespace

std::vector<model::Twist> start_motion(const model::Linkage& structure) {
  const Eigen::VectorXd motion = nearest_motion(structure, all_motions(structure));
  double share = 0, all = 0;
  for (std::size_t b = 0; b < structure.bodies.size(); ++b) {
    share += structure.bodies[b].first_turn().dot(motion.segment<3>(6 * b));
    all += structure.bodies[b].first_turn().squaredNorm();
  }
  share /= all;
  if (!(share > least_share)) return bare_spins(structure);
  std::vector<model::Twist> twists;
  for (std::size_t b = 0; b < structure.bodies.size(); ++b)
    twists.push_back({motion.segment<3>(6 * b) / share, motion.segment<3>(6 * b + 3) / share});
  return twists;
}

// Uses the generator's bits, since the distributions of the standard differ between libraries.
void disturb(std::vector<model::Twist>& motion, double by, unsigned seed, bool planar) {
  std::mt19937 random(seed);
  const auto part = [&] { return by * (2 * static_cast<double>(random()) / std::mt19937::max() - 1); };
  for (model::Twist& twist : motion) {
    const Eigen::Vector3d turn(part(), part(), part()), shift(part(), part(), part());
    twist.omega += planar ? Eigen::Vector3d(0, 0, turn.z()) : turn;
    twist.v += planar ? Eigen::Vector3d(shift.x(), shift.y(), 0) : shift;
  }
}

}  // namespace kinetix::sim
