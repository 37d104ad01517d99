#pragma once

#include <nlohmann/json_fwd.hpp>

#include "optim/ribs/fit_ribs.hpp"

namespace kinetix::app {

/// Of each rib of a fishbone: the row of the spine that it leaves, its cells, and the rms distance of its bodies, mm.
nlohmann::ordered_json ribs_json(const optim::RibsDesign& design);

}  // namespace kinetix::app
