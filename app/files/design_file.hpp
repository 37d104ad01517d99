#pragma once

#include <memory>

#include "app/files/drive_section.hpp"
#include "app/files/goal_settings.hpp"
#include "app/files/hinge_section.hpp"
#include "model/lattice/lattice.hpp"
#include "model/linkage/state.hpp"
#include "model/material/process.hpp"
#include "targets/document/section.hpp"

namespace kinetix::targets {
struct CutSheet;
}

namespace kinetix::app {

/// Returns the keys of an entry of `design.hinges`.
const targets::KeyTable& hinge_entry_keys();

/// Content of a design.yaml. Angles in radians, lengths in mm.
struct Design {
  std::string name;                                     ///< default: the file's name without its ending
  model::Lattice structure;                             ///< with the parameters of every hinge
  model::Process process = model::processes().front();  ///< process that prints the design
  std::optional<LockKind> lock = {};                    ///< part that keeps it folded; empty: not given
  double theta = 0;                        ///< state to show, rad, within (-pi/2, pi/2); default flat
  std::optional<model::Drive> drive = {};  ///< empty: to theta
  int side = 1;                            ///< `side` of the drive: branch to take at a bifurcation, 1 or -1
  HingeSection hinge = {};
  std::map<int, HingeSection> hinge_overrides = {};  ///< per-hinge overrides, by index of the hinge
  PhysicsSection physics = {};
  /// Cuts from which the bodies follow; null for all other designs
  std::shared_ptr<const targets::CutSheet> cuts = {};
  std::vector<std::string> notes = {};  ///< changes to files that it names, one sentence each
};

/// Returns the hinge sections of a design: the common one if a hinge uses it, then each override.
std::vector<const HingeSection*> hinge_sections(const Design& design);

/// Returns the hinge that a design of imported bodies turns; null if none. Its number is -1 for the hinge that turns
/// most in the first motion.
const model::HingeTurn* turn_of(const Design& design);
/// Returns the pull of the imported bodies of a design; null if they are not pulled.
const model::BodyPull* body_pull_of(const Design& design);

/// Returns every key of a design.yaml of a sheet. bodies_keys() has those of imported bodies.
const targets::KeyTable& design_keys();

/// Bytes, 16 MiB. Designs may be larger than targets: this is enough for some 200 000 named hinges.
inline constexpr std::size_t max_design_bytes = 16 << 20;

/// Returns the file of a design. @param source that file, the folder of a result, or a result.json next to the design
/// @throws InvalidInput for a folder without a design
std::string design_at(const std::string& source);

/// Reads a design.
/// @throws InvalidInput for all that formats.md does not allow. Examples: a wall that the structure does not have,
/// that is named twice, or that does not run from its lower to its upper vertex. Other examples: cells of a pattern
/// that disagree, and errors of read_bodies().
Design read_design(const std::string& file);
/// Reads a design from a document in memory.
Design read_design(const targets::Node& root);

/// Returns the file's text. read_design gives the same design back, bit for bit: angles are in degrees with as many
/// digits as that takes. An exception is the last bit of an offset that is not a number of mm over cell_mm. Only
/// hinges that differ from the basic one are named.
/// @pre finite numbers within the ranges that read_design allows, and a name that it allows
std::string design_text(const Design& design);

}  // namespace kinetix::app
