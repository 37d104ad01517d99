#pragma once

#include <array>
#include <string>

#include "model/contact/certified_range.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/sheet/sheet.hpp"

namespace kinetix::app {

/// How far a sheet folds without any contact of walls, proven and not sampled.
struct Certified {
  model::CertifiedRange designed;
  model::CertifiedRange printed;  ///< of walls that are larger all round by its growth_mm

  /// Whether no walls meet on the way to theta, rad.
  bool covers(double theta) const { return covers(designed, theta); }
  bool covers_printed(double theta) const { return covers(printed, theta); }

 private:
  static bool covers(const model::CertifiedRange& range, double theta) {
    return range && !range.overlaps_as_built() && range.negative.theta <= theta &&
           theta <= range.positive.theta;
  }
};

/// Names of the two walls that end a range, whose plates are two a hinge. @pre limit.is_limit
inline std::array<std::string, 2> wall_names(const model::CertifiedLimit& limit, const model::Sheet& sheet) {
  return {wall_name(sheet, limit.walls.first / 2), wall_name(sheet, limit.walls.second / 2)};
}

/// "walls A and B overlap as built" and what helps.
std::string overlap_words(const model::WallPair& walls, const model::Sheet& sheet);

}  // namespace kinetix::app
