#pragma once

#include <nlohmann/json.hpp>

#include "app/studio/play/shape.hpp"

namespace kinetix::app::studio {

/// `meshes`: the surfaces of bodies and soft parts at rest.
nlohmann::ordered_json meshes_message(const model::Assembly& assembly);
/// `design` of bodies, likewise without what the session alone knows. @pre moving.bodies
nlohmann::ordered_json bodies_message(const Design& design, const Moving& moving);

}  // namespace kinetix::app::studio
