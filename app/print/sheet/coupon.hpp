#pragma once

#include <optional>

#include "app/print/sheet/print_sheet.hpp"

namespace kinetix::app {

/// A test piece that tells what clearance a printer keeps: pins with the process's rod and gaps of 0.1 to 0.6 mm a side,
/// each leaning by 0, 30 and 60 degrees. Raised numbers on the forks tell the gap, mm: columns run from 0.1 to 0.6 mm, rows from
/// upright to 60 degrees. Each hinge joins two bodies of its own.
/// @param bed_mm of the printer: a coupon that it does not hold is cut into tiles between its hinges
/// @throws BedTooSmall for a bed that does not hold each hinge
PrintSheet make_coupon(const model::Process& process, const std::optional<Eigen::Vector2d>& bed_mm = {});

}  // namespace kinetix::app
