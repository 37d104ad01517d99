#include "app/run/certified.hpp"

#include <fmt/format.h>

namespace kinetix::app {

std::string overlap_words(const Certified& certified, const model::Sheet& sheet) {
  const auto [first, second] = wall_names(certified.designed.positive, sheet);
  return fmt::format(
      "walls {} and {} overlap as built, before anything turns, so that no sheet of rigid walls can be made "
      "so: lower or thinner "
      "walls, less tilt or larger cells keep them apart",
      first, second);
}

}  // namespace kinetix::app
