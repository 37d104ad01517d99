#pragma once

#include <map>
#include <vector>

#include "app/files/hinge_section.hpp"
#include "model/lattice/lattice.hpp"

namespace kinetix::app {

/// Hinges of a sheet that are made otherwise than the rest: an entry of `hinge.except`.
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

/// A hinge's own section where it has one, else what all others have.
const HingeSection& hinge_at(const HingeSection& common, const std::map<int, HingeSection>& own, int hinge);

/// The list of the section `hinge`, empty where there is none. @param root the whole document, by hinge_keys()
std::vector<HingePart> read_hinge_parts(const targets::Section& root, const model::CellSize& size);

/// The hinges of a sheet that are not as the rest; of two parts that hold one hinge the later counts. Creases may
/// be none. @throws InvalidInput for a column or row that the sheet does not have
std::map<int, HingeSection> own_hinges_of(const model::Lattice& sheet, const std::vector<HingePart>& parts);

/// The same of a design's file, with the place of the part in the message, also for a part that no hinge is of.
std::map<int, HingeSection> read_own_hinges(const targets::Section& root, const model::Lattice& sheet);

/// @throws InvalidInput for parts of a target that only a design can name: a search finds its own columns
void refuse_lines(const targets::Section& root, const std::vector<HingePart>& parts);

/// What a goal allows its drive and its hinges to bear; nothing: any.
struct HingeLimits {
  /// Share of a limit that a search keeps to, so that the run from flat with its own steps keeps it too.
  static constexpr double in_hand = 0.99;

  std::optional<double> force_N;  ///< tolerance.force_N: most on the drive, N, > 0
  std::optional<double>
      strain;  ///< tolerance.strain: most of a hinge made as a block or film, ratio, (0, 10]

  bool any() const { return force_N || strain; }
};

/// The keys `force_N` and `strain` of a `tolerance:` section. @param instead what a search does where it has to
/// @param usual_strain where the file gives none
std::vector<targets::Key> hinge_limit_keys(const std::string& instead,
                                           const targets::Default& usual_strain = {});
/// @throws InvalidInput for a strain where no hinges are blocks or films, and for more than their materials bear
HingeLimits read_hinge_limits(const targets::Section& tolerance, const HingeSection& hinge,
                              const std::vector<HingePart>& parts = {});

}  // namespace kinetix::app
