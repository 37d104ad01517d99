#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "model/state.hpp"

namespace kinetix {

/// A rectangle of lattice vertices, corners included: the part of a structure that plates grip.
struct Grip {
  Vertex first;  ///< lower left
  Vertex last;   ///< upper right
  bool operator==(const Grip&) const = default;

  bool contains(Vertex v) const { return first.i <= v.i && v.i <= last.i && first.j <= v.j && v.j <= last.j; }
};

std::string to_string(const Grip& grip);

/// @throws InvalidInput unless the rectangle spans at least one cell both ways and the structure has every
/// vertex of its first and of its last row along the axis
void validate(const Grip& grip, Axis axis, const Structure& structure);

/// The bodies on the first and on the last row of vertices along the axis, of the grip or, without one, of
/// the whole structure. Ascending along the row.
using GrippedRows = std::array<std::vector<int>, 2>;
GrippedRows gripped_bodies(const Structure& structure, Axis axis, const std::optional<Grip>& grip = {});

/// How two rows lie in a state: the two parallel planes that hold them best, over their distance.
struct RowPlanes {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< unit, from the first row to the last
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
bool keeps_between_plates(const Structure& structure, const GrippedRows& rows,
                          const std::function<State(double)>& fold);

}  // namespace kinetix
