#pragma once

#include <optional>

#include "model/linkage/cell_size.hpp"
#include "model/matter/made_hinge.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// Content of the `hinge:` section: what the hinges are made of.
struct HingeSection {
  enum class Model { rotary, elastic };

  Model model = Model::rotary;
  double k_point = 1000;           ///< N/mm, > 0
  double k_turn = 0.1;             ///< N mm/rad, > 0; 0 is allowed for rotary hinges
  std::optional<double> reach_mm;  ///< half distance of the two constraint points, 0.01 to 10 cell edges
  std::optional<double> k_contact = {};  ///< of walls in contact, N/mm, > 0; empty: 10 k_point or 5 max(k)
  std::optional<model::HingeStiffness> k = {};  ///< replaces k_point and k_turn
  std::optional<model::MadeHinge> made = {};    ///< replaces all of them except k_contact

  bool operator==(const HingeSection&) const = default;
};

/// Returns the stiffness in the directions of the hinge's frame. Empty if the section gives neither that nor a shape
/// that has it.
std::optional<model::HingeStiffness> framed_stiffness(const HingeSection& hinge);

/// Returns the keys of the section, with `except` (app/files/hinge_parts.hpp).
const targets::KeyTable& hinge_keys();
/// Returns the keys of the section for goals whose hinges are always elastic, without `except`.
targets::KeyTable elastic_hinge_keys();
/// Returns the keys of the hinge of a single wall.
const targets::KeyTable& single_hinge_keys();
/// Returns the keys of an entry of `except`.
const targets::KeyTable& hinge_part_keys();
/// Returns the keys of the column or row of such an entry.
const targets::KeyTable& hinge_line_keys();

/// Reads the section. @param root the whole document   @param size for the ranges of lengths, and for what a made
/// hinge takes from its wall
HingeSection read_hinge_section(const targets::Section& root, const model::CellSize& size);
/// Reads the section for goals whose hinges are always elastic. @throws InvalidInput also for model: rotary
HingeSection read_elastic_hinge_section(const targets::Section& root, const model::CellSize& size);
/// Reads the hinge of a single wall by single_hinge_keys(); its model is elastic.
HingeSection read_single_hinge(const targets::Section& section, const model::CellSize& size);

/// Describes how far a made hinge can be off the middle of its wall, and for a pin without caps how far with caps.
std::string offset_limit_text(const model::MadeHinge& hinge, const model::CellSize& size);

/// Returns the inside of a map that reads back to the same hinge, except its model: "k_point: 1000, k_turn: 0.1".
std::string hinge_text(const HingeSection& hinge);

}  // namespace kinetix::app
