#pragma once

#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>

#include "app/files/design_file.hpp"
#include "model/assembly/assembly.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::app {

/// Returns the poses of a state for result.json, positions in mm.
nlohmann::ordered_json poses_json(const model::State& state);

/// Returns [[x, y], ...].
nlohmann::ordered_json points_json(const std::vector<Eigen::Vector2d>& points);

/// Returns [x, y, z].
nlohmann::ordered_json point_json(const Eigen::Vector3d& point);

/// Returns the section `structure` of imported bodies.
nlohmann::ordered_json bodies_json(const model::Assembly& bodies);

/// Returns the section `structure` of imported bodies for pages. Each hinge also has its kind, direction along the part
/// and confidence; pins also have diameter and clearance.
nlohmann::ordered_json shown_bodies_json(const model::Assembly& bodies);

/// Returns the surfaces at rest, mm: `bodies`, and `hinges` for soft parts (null for a hinge without one). Each surface
/// is {points, triangles} in base64: little-endian floats x, y, z, and 32-bit indices of points.
nlohmann::ordered_json meshes_json(const model::Assembly& bodies);

/// Returns the stiffness of a hinge for results, N/mm and N mm/rad.
nlohmann::ordered_json stiffness_json(const model::HingeStiffness& k);

/// Returns the section `structure` of a design.
nlohmann::ordered_json sheet_json(const Design& design);

/// Returns whether a result belongs to this sheet. All values (mm, rad) of its cells, walls, bodies and
/// hinges may differ by `rounding`, relative above 1 and absolute below.
bool matches_sheet(const nlohmann::ordered_json& result, const Design& design, double rounding);

}  // namespace kinetix::app
