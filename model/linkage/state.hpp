#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/linkage/linkage.hpp"

namespace kinetix::model {

/// Pose of a body: a point r of its rest frame (mm) is carried to p + R (r - rest position).
template <class T>
struct PoseOf {
  Eigen::Matrix<T, 3, 3> R = Eigen::Matrix<T, 3, 3>::Identity();
  Eigen::Matrix<T, 3, 1> p = Eigen::Matrix<T, 3, 1>::Zero();

  bool operator==(const PoseOf&) const = default;
};
using Pose = PoseOf<double>;

/// One pose per body of a structure, in its body order; positions in mm.
using State = std::vector<Pose>;

/// Rate of change of a pose: dR = [omega]x R, dp = v. Who hands one out says per what, and in mm or cell
/// edges.
struct Twist {
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();  ///< rad
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
};

/// Flat, mm.
State rest_state(const Linkage& structure);

bool is_finite(const State& state);

/// How far the two bodies of each hinge disagree about it.
struct HingeGaps {
  double max = 0;        ///< distance of the carried hinge points, in cell edges
  double rms = 0;        ///< likewise in cell edges, root mean square over all hinges
  double axis_max = 0;   ///< angle of the carried hinge axes, rad
  int worst_hinge = -1;  ///< index of the hinge with the largest distance
  int worst_axis = -1;   ///< index of the hinge with the largest angle
};

/// NaN anywhere in the state gives NaN in max and rms. @pre state.size() == structure.bodies.size()
HingeGaps hinge_gaps(const Linkage& structure, const State& state);

/// Distance of two states after the best rigid motion of `state` onto `reference`.
struct StateDistance {
  double rms = 0;  ///< of the body positions, in cell edges
  double max = 0;  ///< likewise in cell edges
};

/// Proper rigid alignment (Umeyama without scaling). NaN in either state gives NaN.
StateDistance aligned_distance(const Linkage& structure, const State& state, const State& reference);

/// That rigid motion, x -> R x + p, mm. @pre both are finite
Pose motion_onto(const State& state, const State& reference);
/// All bodies of a state, moved by it as one.
State moved(State state, const Pose& motion);
/// `state` after its motion onto a reference. @pre both are finite
State aligned(const State& state, const State& reference);

}  // namespace kinetix::model
