#pragma once

#include <map>
#include <vector>

#include "app/files/hinge_section.hpp"
#include "model/sheet/sheet.hpp"

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
std::map<int, HingeSection> own_hinges_of(const model::Sheet& sheet, const std::vector<HingePart>& parts);

/// The same of a design's file, with the place of the part in the message, also for a part that no hinge is of.
std::map<int, HingeSection> read_own_hinges(const targets::Section& root, const model::Sheet& sheet);

/// @throws InvalidInput for parts of a target that only a design can name: a search finds its own columns
void refuse_lines(const targets::Section& root, const std::vector<HingePart>& parts);

}  // namespace kinetix::app
