#pragma once

#include <map>
#include <vector>

#include "app/files/hinge_section.hpp"
#include "model/lattice/lattice.hpp"

namespace kinetix::app {

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
  static constexpr double in_hand = 0.99;

  std::optional<double> force_N;  ///< tolerance.force_N: largest load on the drive, N, > 0
  std::optional<double> strain;   ///< tolerance.strain: largest strain of blocks and films, ratio, (0, 10]

  bool any() const { return force_N || strain; }
};

/// Returns the keys `force_N` and `strain` of a `tolerance:` section. @param instead action of a search to keep them,
/// in words
/// @param usual_strain default
std::vector<targets::Key> hinge_limit_keys(const std::string& instead,
                                           const targets::Default& usual_strain = {});
/// Reads the limits. @throws InvalidInput for a strain if no hinges are blocks or films, and for more than their
/// materials withstand
HingeLimits read_hinge_limits(const targets::Section& tolerance, const HingeSection& hinge,
                              const std::vector<HingePart>& parts = {});

}  // namespace kinetix::app
