#pragma once

#include <optional>
#include <vector>

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
  /// plates, cord: sign of theta, 1 or -1; nothing: that of the design's theta
  std::optional<int> branch = {};
  std::optional<model::Grip> grip = {};  ///< plates: the part that they grip; nothing: the rim
  bool press = false;                    ///< plates: push their rows and never pull them
  int hinge = -1;                        ///< hinge: the driven one
  /// hinge: turn of the wall's half at its upper vertex; shape memory: twice the theta at which its springs rest in the end;
  /// rad, within (-pi, pi)
  double angle = 0;
  std::vector<int> through = {};  ///< cord: the hinges through which it runs, in order
  double shorten_mm = 0;          ///< cord: by how much
  std::vector<int> springs = {};  ///< shape memory: the hinges that have one; empty: all
  double k_turn = 0;              ///< shape memory: of each spring, N mm/rad

  bool operator==(const DriveSection&) const = default;
};

/// The key `press` of plates.
targets::Key press_key();
/// The `drive:` key of a design.
targets::Key drive_key();

/// Nothing without the section, or where it names a side alone, which says nothing of where to go.
/// @param structure with all its hinges
/// @throws InvalidInput for whatever formats.md does not allow: among others a part to grip that is not
/// there or, in an exactly mobile structure, whose rows leave the planes of their plates; a cord that nothing shortens
std::optional<DriveSection> read_drive_section(const targets::Section& root, const model::Sheet& structure);

/// Which way to leave a bifurcation that the drive leaves open, 1 or -1.
int read_side(const targets::Section& root);

}  // namespace kinetix::app
