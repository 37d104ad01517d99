#pragma once

#include <optional>

namespace kinetix::app {

/// Memory that this process can still take, bytes: what the system has available, or what a limit of the process (`ulimit -v`)
/// leaves, if that is less. Nothing where the system does not report it.
std::optional<double> free_memory();

}  // namespace kinetix::app
