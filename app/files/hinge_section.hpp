#pragma once

#include <optional>

#include "model/linkage/cell_size.hpp"
#include "model/matter/made_hinge.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// The `hinge:` section: what the hinges are made of.
struct HingeSection {
  enum class Model { rotary, elastic };

  Model model = Model::rotary;
  double k_point = 1000;                 ///< N/mm, > 0
  double k_turn = 0.1;                   ///< N mm/rad, > 0; 0 is allowed where rotary
  std::optional<double> reach_mm;        ///< half distance of the two constraint points, (0, 10] cell edges
  std::optional<double> k_contact = {};  ///< of two walls pressed together, N/mm, > 0; nothing: 10 k_point
  std::optional<model::HingeStiffness> k = {};  ///< instead of k_point and k_turn
  std::optional<model::MadeHinge> made = {};    ///< instead of all of them but k_contact

  bool operator==(const HingeSection&) const = default;
};

/// By the directions of the hinge's frame, where the section gives them or a shape that has them.
std::optional<model::HingeStiffness> framed_stiffness(const HingeSection& hinge);

/// Keys of the section, `except` with them (app/files/hinge_parts.hpp), and those where hinges are elastic whether
/// the file says so or not.
const targets::KeyTable& hinge_keys();
targets::KeyTable elastic_hinge_keys();
/// Keys of the hinge of a single wall, of an entry of `except`, and of the column or row that this is at.
const targets::KeyTable& single_hinge_keys();
const targets::KeyTable& hinge_part_keys();
const targets::KeyTable& hinge_line_keys();

/// @param root the whole document; @param size for the ranges of lengths, and what a made hinge takes from its
/// wall
HingeSection read_hinge_section(const targets::Section& root, const model::CellSize& size);
/// The same where hinges are elastic whether the file says so or not. @throws InvalidInput also for model:
/// rotary
HingeSection read_elastic_hinge_section(const targets::Section& root, const model::CellSize& size);
/// Of a single wall, by single_hinge_keys(); its model is elastic.
HingeSection read_single_hinge(const targets::Section& section, const model::CellSize& size);

/// Why a made hinge cannot sit where a file asks, and of a pin without caps how far they reach.
std::string offset_limit_text(const model::MadeHinge& hinge, const model::CellSize& size);

/// The inside of a map that reads back to the same, but for the model: "k_point: 1000, k_turn: 0.1".
std::string hinge_text(const HingeSection& hinge);

}  // namespace kinetix::app
