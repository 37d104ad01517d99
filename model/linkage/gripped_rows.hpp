#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Bodies gripped by the first and by the second plate, each in ascending order along the plate.
using GrippedRows = std::array<std::vector<int>, 2>;

/// Two parallel planes that fit two rows best in a state, relative to their distance.
struct RowPlanes {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< unit vector, from the first row to the last
  double distance = 0;                                ///< distance of the planes, mm
  double off_plane = 0;                               ///< largest distance of a body from its plane, mm
};

/// Returns the planes of two rows. If several pairs fit, as for two parallel straight rows, the pair furthest
/// apart is returned.
/// @pre at least two bodies per row; a finite state
RowPlanes planes_of(const GrippedRows& rows, const State& state);

/// Returns true if plates can hold the rows during an exact motion: in two parallel planes, cos(theta) times
/// as far apart as at rest. Rows that bend towards each other give false, because their sheet would roll
/// between the plates.
/// @param fold state at theta, rad
bool keeps_between_plates(const Linkage& structure, const GrippedRows& rows,
                          const std::function<State(double)>& fold);

}  // namespace kinetix::model
