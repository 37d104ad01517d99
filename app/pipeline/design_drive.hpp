#pragma once

#include "app/files/design_file.hpp"
#include "model/linkage/linkage_drive.hpp"

namespace kinetix::app {

/// The drive of a design: as its file says, or to its theta.
model::LinkageDrive drive_of(const DesignFile& design);

}  // namespace kinetix::app
