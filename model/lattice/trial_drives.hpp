#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/lattice/lattice.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {

/// A drive to try on a sheet, or why there is none of its kind.
struct TrialDrive {
  std::string name;  ///< e.g. "cord along the middle row"
  std::optional<LinkageDrive> drive;
  std::string why_not;  ///< in a sentence, where there is no drive
};

/// Ways to take a sheet to theta: plates normal to y and to x, the hinges nearest to and farthest from its middle, and of
/// squares cords along the middle row and column of cells, across an even number of them: across an odd one a cord pulls to
/// one side from the first. Where the sheet moves exactly, each drive asks for what the closed
/// form has at theta, and plates must keep its rows straight; else for what one checkerboard of squares has.
/// @param theta rad, in (-pi/2, pi/2), not 0
std::vector<TrialDrive> trial_drives(const Lattice& sheet, const ExactMotion& exact, double theta);

}  // namespace kinetix::model
