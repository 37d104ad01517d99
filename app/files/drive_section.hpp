#pragma once

#include <map>

#include "model/lattice/lattice.hpp"
#include "model/lattice/lattice_motion.hpp"
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

/// Returns the key `press` of plates.
targets::Key press_key();
/// Returns the `drive:` key of a design.
targets::Key drive_key();

/// Reads the drive. Empty without the section, or if it names only a side, which sets no goal.
/// @param structure with all its hinges
/// @throws InvalidInput for all that formats.md does not allow. Examples: a part to grip that does not exist, and a
/// tendon that nothing shortens. In an exactly mobile structure, also a part to grip whose rows leave the planes of
/// their plates.
std::optional<model::Drive> read_drive_section(const targets::Section& root, const model::Lattice& structure);

/// Returns the section's text. A side of 1, the default, is left out.
std::string drive_text(const model::Lattice& structure, const std::optional<model::Drive>& drive, int side);

/// Describes what moves a structure.
const char* describe(const model::Drive& drive);

/// Reads the branch to take at a bifurcation that the drive leaves open, 1 or -1.
int read_side(const targets::Section& root);

}  // namespace kinetix::app
