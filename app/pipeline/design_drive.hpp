#pragma once

#include "app/files/design_file.hpp"
#include "model/lattice/square/classify.hpp"
#include "model/lattice/square/drive.hpp"

namespace kinetix::app {

/// The drive of a design: as its file says, or by plates to its theta.
model::Drive drive_of(const DesignFile& design);

/// Theta at which an exactly mobile structure fulfils a drive, rad.
/// @throws InvalidInput where no theta up to 90 deg does, or where plates leave theta undetermined
double theta_of(const model::Drive& drive, const model::Classification& family,
                const model::Structure& structure);

}  // namespace kinetix::app
