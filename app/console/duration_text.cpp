#include "app/console/duration_text.hpp"

#include <fmt/format.h>

namespace kinetix::app {

std::string duration_text(double seconds) {
  const auto whole = static_cast<long>(seconds);
  if (seconds < 10) return fmt::format("{:.2g} s", seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

}  // namespace kinetix::app
