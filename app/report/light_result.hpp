#pragma once

#include <nlohmann/json_fwd.hpp>

namespace kinetix::app {

/// A result as a page takes it, a third of its size: numbers to six digits, poses as `rows` of seven numbers (x, y, z in
/// mm to 0.0001, then the quaternion w, x, y, z to 1e-6), and of the frames between flat and the fold none where the page
/// computes them (`has_scene`, and an exact family), else as many as fit into 60 kB; what no page reads is left out.
nlohmann::ordered_json light_result(nlohmann::ordered_json result, bool has_scene);

}  // namespace kinetix::app
