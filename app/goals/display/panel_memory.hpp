#pragma once

#include <cstddef>

#include "targets/display/display_goal.hpp"

namespace kinetix::app {

/// Bytes of the machine's memory.
std::size_t memory_of_machine();

/// @param runs searches, of which `threads` go on at a time (0: all cores)
/// @throws InvalidInput for a panel whose search would take more than `available` bytes: about 50 kB a cell
/// for each search, as measured on panels of 30 x 30 and 60 x 60 cells
void check_memory(targets::PanelSize size, int threads, int runs, std::size_t available);

}  // namespace kinetix::app
