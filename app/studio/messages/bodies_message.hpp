#pragma once

#include <nlohmann/json.hpp>

#include "app/studio/play/shape.hpp"

namespace kinetix::app::studio {

/// `meshes`: the surfaces of bodies and soft parts at rest.
nlohmann::ordered_json meshes_message(const model::Assembly& assembly);
/// Turn of the driven hinge that the file asks for, rad; 0 where bodies rest or are pulled.
double asked_turn(const Design& design);
/// `design` of bodies, likewise without what the session alone knows. @pre moving.bodies
nlohmann::ordered_json bodies_message(const Moving& moving);

}  // namespace kinetix::app::studio
