#pragma once

#include <optional>
#include <string>

#include "model/lattice/square/structure.hpp"
#include "model/linkage/gripped_rows.hpp"

namespace kinetix::model {

/// A rectangle of lattice vertices, including corners: the part of a structure that plates grip.
struct Grip {
  Vertex first;  ///< lower left
  Vertex last;   ///< upper right
  bool operator==(const Grip&) const = default;

  bool contains(Vertex v) const { return first.i <= v.i && v.i <= last.i && first.j <= v.j && v.j <= last.j; }
};

std::string to_string(const Grip& grip);

/// Checks a grip. @throws InvalidInput unless the rectangle spans at least one cell in both directions and the
/// structure has every vertex of its first and last row along the axis
void validate(const Grip& grip, Axis axis, const Structure& structure);

/// Returns the bodies on the first and on the last row of vertices along the axis, ascending along the row. The rows
/// are those of the grip or, without one, of the whole structure.
GrippedRows gripped_bodies(const Structure& structure, Axis axis, const std::optional<Grip>& grip = {});

}  // namespace kinetix::model
