#include "app/goals/display/panel_memory.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <thread>

namespace kinetix::app {
namespace {

constexpr double bytes_a_cell = 50e3;  // of one search, as measured on panels of 30 x 30 and 60 x 60 cells

}  // namespace

std::size_t memory_of_machine() {
  return static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

void check_memory(targets::PanelSize size, int threads, int runs, std::size_t available) {
  const int allowed =
      threads > 0 ? threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const int at_a_time = std::min(allowed, runs);
  const double needed = bytes_a_cell * size[0] * size[1] * at_a_time, gib = 1 << 30;
  if (needed <= static_cast<double>(available)) return;
  throw InvalidInput(
      fmt::format("a panel of {} x {} cells takes about {:.1f} GiB of memory to search on {} threads, and "
                  "this machine has {:.1f} GiB; give fewer cells{}",
                  size[0], size[1], needed / gib, at_a_time, static_cast<double>(available) / gib,
                  at_a_time > 1 ? ", or --threads 1" : ""),
      {"", 0, 0, "structure.cells"});
}

}  // namespace kinetix::app
