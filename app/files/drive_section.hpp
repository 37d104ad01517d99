#pragma once

#include <optional>

#include "model/lattice/square/grip.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "model/sheet/sheet.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// The `drive:` section: how the structure is moved.
struct DriveSection {
  using Kind = model::LinkageDrive::Kind;

  Kind kind = Kind::plates;
  model::Axis axis = model::Axis::y;  ///< plates: their normal
  double compression = 0;             ///< plates: 1 - final / initial distance, (0, 1)
  std::optional<int> branch = {};     ///< plates: sign of theta, 1 or -1; nothing: that of the design's theta
  std::optional<model::Grip> grip = {};  ///< plates: the part that they grip; nothing: the rim
  bool press = false;                    ///< plates: push their rows and never pull them
  int hinge = -1;                        ///< hinge: the driven one
  double angle = 0;  ///< hinge: turn of the wall's half at its upper vertex, rad, within (-pi, pi)

  bool operator==(const DriveSection&) const = default;
};

/// The key `press` of plates.
targets::Key press_key();
/// The `drive:` key of a design.
targets::Key drive_key();

/// Nothing without the section, or where it names a side alone, which says nothing of where to go.
/// @param structure with all its hinges
/// @throws InvalidInput for whatever formats.md does not allow: among others a part to grip that is not
/// there or, in an exactly mobile structure, whose rows leave the planes of their plates
std::optional<DriveSection> read_drive_section(const targets::Section& root, const model::Sheet& structure);

/// Which way to leave a bifurcation that the drive leaves open, 1 or -1.
int read_side(const targets::Section& root);

}  // namespace kinetix::app
