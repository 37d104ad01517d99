#include "app/run/certified.hpp"

namespace kinetix::app {

// Plates are two a hinge.
std::array<std::string, 2> wall_names(const model::CertifiedLimit& limit, const model::Sheet& sheet) {
  return {wall_name(sheet, limit.walls.first / 2), wall_name(sheet, limit.walls.second / 2)};
}

}  // namespace kinetix::app
