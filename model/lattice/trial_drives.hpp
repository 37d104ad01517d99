#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/lattice/lattice.hpp"
#include "model/linkage/exact_motion.hpp"

namespace kinetix::model {

/// A drive to try on a sheet, or the reason why there is none of its kind.
struct TrialDrive {
  std::string name;  ///< e.g. "cord along the middle row"
  std::optional<LinkageDrive> drive;
  std::string why_not;  ///< one sentence, if there is no drive
};

/// Returns drives that take a sheet to theta: plates normal to y and to x, and the hinges nearest to and farthest
/// from its middle. Squares also have tendons along the middle row and column of cells, across an even number of
/// them. Across an odd number a tendon would pull to one side from the start. If the sheet moves exactly, each drive
/// has the target of the closed form at theta, and plates must keep its rows straight. Otherwise each has the target
/// of a checkerboard of squares.
/// @param theta rad, in (-pi/2, pi/2), not 0
std::vector<TrialDrive> trial_drives(const Lattice& sheet, const ExactMotion& exact, double theta);

}  // namespace kinetix::model
