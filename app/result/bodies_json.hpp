#pragma once

#include <nlohmann/json_fwd.hpp>

#include "model/assembly/assembly.hpp"

namespace kinetix::app {

/// `structure` of the result of imported bodies.
nlohmann::ordered_json bodies_json(const model::Assembly& bodies);

/// The stiffness of a hinge as results have it, N/mm and N mm/rad.
nlohmann::ordered_json stiffness_json(const model::HingeStiffness& k);

}  // namespace kinetix::app
