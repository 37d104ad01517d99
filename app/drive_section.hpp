#pragma once

#include <optional>

#include "model/grip.hpp"
#include "targets/document.hpp"

namespace kinetix {

/// The `drive:` section: how the structure is moved.
struct DriveSection {
  enum class Kind { plates, hinge };

  Kind kind = Kind::plates;
  Axis axis = Axis::y;             ///< plates: their normal
  double compression = 0;          ///< plates: 1 - final / initial distance, (0, 1)
  std::optional<int> branch = {};  ///< plates: sign of theta, 1 or -1; nothing: that of the design's theta
  std::optional<Grip> grip = {};   ///< plates: the part that they grip; nothing: the rim
  Wall wall = {};                  ///< hinge: the driven wall, one of the structure's
  double angle = 0;                ///< hinge: turn of wall.to() against wall.from, rad, within (-pi, pi)

  bool operator==(const DriveSection&) const = default;
};

/// Nothing without the section, or where it names a side alone, which says nothing of where to go.
/// @param structure with all its hinges
/// @throws InvalidInput for whatever contracts.md does not allow: among others a part to grip that is not
/// there or, in an exactly mobile structure, whose rows leave the planes of their plates
std::optional<DriveSection> read_drive_section(const Node& root, const Structure& structure);

/// Which way to leave a bifurcation that the drive leaves open, 1 or -1.
int read_side(const Node& root);

}  // namespace kinetix
