#pragma once

#include <map>

#include "model/lattice/lattice.hpp"
#include "model/linkage/linkage.hpp"
#include "model/material/manufactured_hinge.hpp"
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
  std::optional<model::HingeStiffness> k = {};        ///< replaces k_point and k_turn
  std::optional<model::ManufacturedHinge> made = {};  ///< replaces all of them except k_contact
  std::optional<model::HingeKind> kind = {};  ///< of hinges whose sizes are left open; empty: left open too

  bool operator==(const HingeSection&) const = default;
};

/// Returns the stiffness in the directions of the hinge's frame. Empty if the section gives neither that nor a shape
/// that has it.
std::optional<model::HingeStiffness> framed_stiffness(const HingeSection& hinge);

/// Returns the keys of the section, with `except` (app/files/hinge_section.hpp).
const targets::KeyTable& hinge_keys();
/// Returns the keys of the section for goals whose hinges are always elastic, without `except`.
targets::KeyTable elastic_hinge_keys();
/// Returns the keys of the hinge of a single wall.
const targets::KeyTable& single_hinge_keys();
/// Returns the keys of an entry of `except`.
const targets::KeyTable& hinge_part_keys();
/// Returns the keys of the column or row of such an entry.
const targets::KeyTable& hinge_line_keys();

/// Reads the kind of hinges whose sizes the file leaves open: `hinge: {kind: pin}`. Empty if it does not.
/// @param root the whole document
std::optional<model::HingeKind> read_open_kind(const targets::Section& root);

/// Reads the section. @param root the whole document   @param size for the ranges of lengths, and for what a made
/// hinge takes from its wall
HingeSection read_hinge_section(const targets::Section& root, const model::CellSize& size);
/// Reads the section for goals whose hinges are always elastic. @throws InvalidInput also for model: rotary
HingeSection read_elastic_hinge_section(const targets::Section& root, const model::CellSize& size);
/// Reads the hinge of a single wall by single_hinge_keys(); its model is elastic.
HingeSection read_single_hinge(const targets::Section& section, const model::CellSize& size);

/// Describes how far a made hinge can be off the middle of its wall.
std::string offset_limit_text(const model::ManufacturedHinge& hinge, const model::CellSize& size);

/// Returns the inside of a map that reads back to the same hinge, except its model: "k_point: 1000, k_turn: 0.1".
std::string hinge_text(const HingeSection& hinge);

/// Hinges of a sheet that differ from the rest: an entry of `hinge.except`.
struct HingePart {
  enum class Place {
    creases,  ///< all hinges that lean
    column,   ///< of squares: the walls along x in a column
    row,      ///< of squares: the walls along y in a row
  };

  Place place = Place::creases;
  int line = 0;        ///< column or row, counted from 0
  HingeSection hinge;  ///< its model is elastic

  bool operator==(const HingePart&) const = default;
};

/// Returns the section of a hinge: its override, or the common one.
const HingeSection& hinge_at(const HingeSection& common, const std::map<int, HingeSection>& own, int hinge);

/// Reads the overrides of the section `hinge`; empty if there are none. @param root the whole document, by
/// hinge_keys()
std::vector<HingePart> read_hinge_parts(const targets::Section& root, const model::CellSize& size);

/// Returns the per-hinge overrides of a sheet. If two parts include one hinge, the later counts. A sheet may have no
/// creases.
/// @throws InvalidInput for a column or row that the sheet does not have
std::map<int, HingeSection> hinge_overrides_of(const model::Lattice& sheet,
                                               const std::vector<HingePart>& parts);

/// Reads the per-hinge overrides of a design's file. Errors give the position of the part. A part without hinges is
/// an error too.
std::map<int, HingeSection> read_hinge_overrides(const targets::Section& root, const model::Lattice& sheet);

/// Rejects parts of a target that only a design can name, since a search finds its own columns. @throws InvalidInput
void refuse_lines(const targets::Section& root, const std::vector<HingePart>& parts);

/// Limits of a goal on its drive and its hinges; empty: no limit.
struct HingeLimits {
  /// Fraction of a limit that a search keeps to, so that the run from flat with its different steps keeps the limit
  /// too.
  static constexpr double safe_share = 0.99;

  std::optional<double> force_N;  ///< tolerance.force_N: largest load on the drive, N, > 0
  std::optional<double> strain;   ///< tolerance.strain: largest strain of blocks and films, ratio, (0, 10]

  bool any() const { return force_N || strain; }
};

/// Returns the keys `force_N` and `strain` of a `tolerance:` section. @param instead action of a search to keep them,
/// in words
/// @param default_strain default
std::vector<targets::Key> hinge_limit_keys(const std::string& instead,
                                           const targets::Default& default_strain = {});
/// Reads the limits. @throws InvalidInput for a strain if no hinges are blocks or films, and for more than their
/// materials withstand
HingeLimits read_hinge_limits(const targets::Section& tolerance, const HingeSection& hinge,
                              const std::vector<HingePart>& parts = {});

}  // namespace kinetix::app
