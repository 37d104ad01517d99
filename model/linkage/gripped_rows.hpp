#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// The bodies that two plates grip, those of the first and those of the second one, ascending along the
/// plate.
using GrippedRows = std::array<std::vector<int>, 2>;

/// How two rows lie in a state: the two parallel planes that hold them best, over their distance.
struct RowPlanes {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< unit vector, from the first row to the last
  double distance = 0;                                ///< of the planes, mm
  double off_plane = 0;                               ///< largest distance of a body from its plane, mm
};

/// Where several pairs hold them, as they do two parallel straight rows, the pair that is furthest apart.
/// @pre at least two bodies a row; a finite state
RowPlanes planes_of(const GrippedRows& rows, const State& state);

/// Whether plates can hold the rows all along an exact motion: in two parallel planes, cos(theta) times as
/// far apart as at rest. Rows that bend towards each other are not: their sheet would roll between the
/// plates.
/// @param fold state at theta, rad
bool keeps_between_plates(const Linkage& structure, const GrippedRows& rows,
                          const std::function<State(double)>& fold);

}  // namespace kinetix::model
