#pragma once

#include <map>

#include "model/lattice/lattice.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

targets::ValueType vertex_type();
/// Returns the key `wall`. @param with the alternative that it goes with
targets::Key wall_key(std::string with = {}, targets::Default fallback = targets::needed);

/// Reads a vertex [i, j] of squares, in the structure or not.
model::Vertex read_vertex(const targets::Node& node);

/// Reader of walls that a file names by their two vertices: [[i, j], [i, j]] for squares, [number, number] for any
/// other lattice.
class WallReader {
 public:
  /// @param sheet must outlive it
  explicit WallReader(const model::Lattice& sheet);

  /// Returns the index of the hinge on the wall that `wall` names by its two vertices.
  /// @throws InvalidInput for a wall that the structure does not have, or that does not run from its lower to its
  /// upper vertex
  int hinge_of(const targets::Node& wall) const;
  /// Returns the index of the hinge on the wall that the key `wall` of `owner` names, which must be given.
  int hinge_of(const targets::Section& owner) const;

 private:
  const model::Lattice& sheet_;
  std::map<std::pair<int, int>, int> hinge_between_;  ///< only of lattices whose vertices are numbers
};

}  // namespace kinetix::app
