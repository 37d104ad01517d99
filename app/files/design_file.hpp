#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/files/drive_section.hpp"
#include "app/files/hinge_section.hpp"
#include "app/files/physics_section.hpp"
#include "model/lattice/lattice.hpp"
#include "model/linkage/state.hpp"
#include "model/matter/process.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// Of one entry of `design.hinges`.
const targets::KeyTable& hinge_entry_keys();

/// The content of a design.yaml. Angles in radians, lengths in mm.
struct Design {
  std::string name;                                     ///< default: the file's name without its ending
  model::Lattice structure;                             ///< with the parameters of every hinge
  model::Process process = model::processes().front();  ///< that prints it
  double theta = 0;                        ///< the state to show, rad, within (-pi/2, pi/2); default flat
  std::optional<model::Drive> drive = {};  ///< nothing: to theta
  int side = 1;  ///< `side` of the drive: which way to leave a bifurcation that it leaves open, 1 or -1
  HingeSection hinge = {};
  std::map<int, HingeSection> own_hinges =
      {};  ///< of walls whose hinge is another one, by index of the hinge
  PhysicsSection physics = {};
};

/// How its hinges are made: first those that have nothing of their own, where there are any, then each of the others.
std::vector<const HingeSection*> hinge_sections(const Design& design);

/// Why a hinge's axis cannot sit as far off the middle of its wall as it does; nothing where it can, and of hinges that the
/// file does not describe.
std::optional<std::string> why_offset_does_not_fit(const Design& design, int hinge);

/// Returns the hinge that a design of imported bodies turns, its number -1 for the one that turns most in the first motion. Null where none is.
const model::HingeTurn* turn_of(const Design& design);
/// Returns by what the imported bodies of a design are pulled; null where they are not.
const model::BodyPull* body_pull_of(const Design& design);

/// Every key of a design.yaml of a sheet; bodies_keys(): of imported bodies.
const targets::KeyTable& design_keys();

/// Bytes, 16 MiB. Designs may be larger than targets: this holds some 200 000 named hinges.
inline constexpr std::size_t max_design_bytes = 16 << 20;

/// The file of a design. @param source it, the folder of a result, or its result.json, which stands beside the design
/// @throws InvalidInput for a folder without a design
std::string design_at(const std::string& source);

/// @throws InvalidInput for whatever formats.md does not allow: among others a wall that the structure does
/// not have, is named twice, or does not run from its lower to its upper vertex, and cells of a pattern that
/// disagree; of imported bodies as read_bodies()
Design read_design(const std::string& file);
/// The same of a document in memory.
Design read_design(const targets::Node& root);

/// The file's text. read_design gives the same design back, bit for bit: angles are in degrees with as many
/// digits as that takes. (An offset that is no number of mm over cell_mm loses its last bit.) Only hinges that differ
/// from the basic one are named.
/// @pre finite numbers within the ranges that read_design allows, and a name that it allows
std::string design_text(const Design& design);

}  // namespace kinetix::app
