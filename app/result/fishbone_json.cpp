#include "app/result/fishbone_json.hpp"

#include <nlohmann/json.hpp>

namespace kinetix::app {

nlohmann::ordered_json ribs_json(const optim::RibsDesign& design) {
  auto ribs = nlohmann::ordered_json::array();
  for (std::size_t r = 0; r < design.layout.spine_and_ribs.ribs.size(); ++r) {
    const model::FishboneRib& rib = design.layout.spine_and_ribs.ribs[r];
    ribs.push_back({{"row", rib.row}, {"cells", rib.cells}, {"rms_mm", design.error.of_ribs[r]}});
  }
  return ribs;
}

}  // namespace kinetix::app
