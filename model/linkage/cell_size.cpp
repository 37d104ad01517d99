#include "model/linkage/cell_size.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "model/base/invalid_input.hpp"

namespace kinetix::model {

void check_lengths(const CellSize& size) {
  for (const auto& [name, value] :
       {std::pair("cell edge", size.edge_mm), std::pair("wall thickness", size.thickness_mm),
        std::pair("wall height", size.height_mm)})
    if (!(value > 0) || !std::isfinite(value))
      throw InvalidInput(std::string(name) + " must be a positive length in mm");
}

}  // namespace kinetix::model
