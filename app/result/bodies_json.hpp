#pragma once

#include <nlohmann/json_fwd.hpp>

#include "model/assembly/assembly.hpp"

namespace kinetix::app {

/// `structure` of the result of imported bodies.
nlohmann::ordered_json bodies_json(const model::Assembly& bodies);

/// The same as pages show it: with kind, direction along the part, confidence and, of a pin, diameter and clearance of each hinge.
nlohmann::ordered_json shown_bodies_json(const model::Assembly& bodies);

/// Surfaces of `bodies` and of soft parts (`hinges`, null where there is none) at rest, mm: {points, triangles}, base64 of little-endian
/// floats x, y, z and of 32-bit numbers of points.
nlohmann::ordered_json meshes_json(const model::Assembly& bodies);

/// The stiffness of a hinge as results have it, N/mm and N mm/rad.
nlohmann::ordered_json stiffness_json(const model::HingeStiffness& k);

}  // namespace kinetix::app
