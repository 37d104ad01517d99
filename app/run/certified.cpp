#include "app/run/certified.hpp"

#include <fmt/format.h>

namespace kinetix::app {

std::string overlap_words(const model::WallPair& walls, const model::Sheet& sheet) {
  return fmt::format(
      "walls {} and {} overlap as built, before anything turns, so that no sheet of rigid walls can be made "
      "so: lower or thinner "
      "walls, less tilt or larger cells keep them apart",
      wall_name(sheet, walls.first / 2), wall_name(sheet, walls.second / 2));
}

}  // namespace kinetix::app
