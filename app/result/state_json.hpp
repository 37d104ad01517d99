#pragma once

#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>

#include "app/files/design_file.hpp"
#include "model/assembly/assembly.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::app {

/// The poses of a state as result.json has them.
nlohmann::ordered_json poses_json(const model::State& state);

/// [[x, y], ...], as a list.
nlohmann::ordered_json points_json(const std::vector<Eigen::Vector2d>& points);

/// [x, y, z].
nlohmann::ordered_json point_json(const Eigen::Vector3d& point);

/// `structure` of the result of imported bodies.
nlohmann::ordered_json bodies_json(const model::Assembly& bodies);

/// The same as pages show it: with kind, direction along the part, confidence and, of a pin, diameter and clearance of each hinge.
nlohmann::ordered_json shown_bodies_json(const model::Assembly& bodies);

/// Surfaces of `bodies` and of soft parts (`hinges`, null where there is none) at rest, mm: {points, triangles}, base64 of little-endian
/// floats x, y, z and of 32-bit numbers of points.
nlohmann::ordered_json meshes_json(const model::Assembly& bodies);

/// The stiffness of a hinge as results have it, N/mm and N mm/rad.
nlohmann::ordered_json stiffness_json(const model::HingeStiffness& k);

/// What results say of a design's sheet: their section `structure`.
nlohmann::ordered_json sheet_json(const Design& design);

/// Whether a result is of this sheet: cells, walls, bodies and hinges differ by less than `rounding`, relative, or in mm and rad.
bool is_of_sheet(const nlohmann::ordered_json& result, const Design& design, double rounding);

}  // namespace kinetix::app
