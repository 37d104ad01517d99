#pragma once

#include <algorithm>

#include "model/closure/closure.hpp"
#include "model/hinge/elasticity.hpp"
#include "model/lattice/lattice_motion.hpp"

namespace kinetix::testing {

/// Returns the energy of all hinges in units of k_point edge^2, as model/hinge/elasticity.hpp states it.
inline double elastic_energy(const model::Linkage& structure, const model::State& state,
                             const model::Stiffness& k) {
  const Eigen::VectorXd misfit = closure_residual(structure, state);
  double energy = 0;
  for (int h = 0; h < static_cast<int>(structure.hinges.size()); ++h) {
    const double turn = hinge_turn(structure, state, h);
    energy += misfit.segment<3>(6 * h).squaredNorm() +
              k.reach * k.reach * misfit.segment<3>(6 * h + 3).squaredNorm() + 0.5 * k.turn * turn * turn;
  }
  return energy;
}

/// Returns the derivative of elastic_energy() by the bodies' twists, by central differences.
inline Eigen::VectorXd elastic_gradient(const model::Linkage& structure, const model::State& state,
                                        const model::Stiffness& k) {
  constexpr double step = 1e-5;
  Eigen::VectorXd gradient(6 * state.size());
  for (Eigen::Index c = 0; c < gradient.size(); ++c) {
    const auto energy_at = [&](double amount) {
      Eigen::VectorXd twists = Eigen::VectorXd::Zero(gradient.size());
      twists[c] = amount;
      return elastic_energy(structure, retract_straight(structure, state, twists), k);
    };
    gradient[c] = (energy_at(step) - energy_at(-step)) / (2 * step);
  }
  return gradient;
}

/// Removes the part that the plates hold (model/lattice/square/family/drive.hpp).
inline void drop_plate_forces(const model::Structure& structure, model::Axis axis,
                              Eigen::VectorXd& gradient) {
  const auto row = [&](model::Vertex v) { return axis == model::Axis::x ? v.i : v.j; };
  int lowest = row(structure.bodies[0]), highest = lowest;
  for (const model::Vertex v : structure.bodies) {
    lowest = std::min(lowest, row(v));
    highest = std::max(highest, row(v));
  }
  for (const int rim : {lowest, highest}) {
    std::vector<int> held;
    for (std::size_t b = 0; b < structure.bodies.size(); ++b)
      if (row(structure.bodies[b]) == rim) held.push_back(static_cast<int>(b));
    for (const int b : held) gradient[6 * b + 3 + (axis == model::Axis::x ? 0 : 1)] = 0;
    const int pin = held[held.size() / 2];
    gradient[6 * pin + 5] = 0;
    if (rim == lowest) gradient[6 * pin + (axis == model::Axis::x ? 0 : 1)] = 0;
  }
}

/// Removes the moment of a driven hinge.
inline void drop_hinge_moment(const model::Structure& structure, const model::State& state, int hinge,
                              Eigen::VectorXd& gradient) {
  std::vector<Eigen::Triplet<double>> entries;
  append_drive_gradient(model::HingeTurn{hinge, 0}, structure, state, 0, entries);
  Eigen::VectorXd moment = Eigen::VectorXd::Zero(gradient.size());
  for (const auto& entry : entries) moment[entry.col()] += entry.value();
  gradient -= moment.dot(gradient) / moment.squaredNorm() * moment;
}

/// Returns the largest force or moment on a body that neither its neighbours nor the drive balance. It is divided by
/// the largest force or moment of a turning spring or a pair of point springs. Contacts are not included.
inline double imbalance(const model::Structure& structure, const model::Drive& drive,
                        const model::State& state, const model::Stiffness& k, bool planar) {
  const model::Linkage linkage = structure;
  Eigen::VectorXd gradient = elastic_gradient(linkage, state, k);
  if (const auto* plates = std::get_if<model::Plates>(&drive))
    drop_plate_forces(structure, plates->axis, gradient);
  else
    drop_hinge_moment(structure, state, std::get<model::HingeTurn>(drive).hinge, gradient);
  const Eigen::VectorXd misfit = closure_residual(linkage, state);
  double largest = 0;
  for (int h = 0; h < static_cast<int>(structure.hinges.size()); ++h)
    largest = std::max({largest, 2 * misfit.segment<3>(6 * h).norm(),
                        2 * k.reach * k.reach * misfit.segment<3>(6 * h + 3).norm(),
                        k.turn * std::abs(hinge_turn(linkage, state, h))});
  for (std::size_t b = 0; planar && b < state.size(); ++b)
    for (const int out_of_plane : {0, 1, 5}) gradient[6 * b + out_of_plane] = 0;
  return gradient.lpNorm<Eigen::Infinity>() / largest;
}

}  // namespace kinetix::testing
