#pragma once

#include <string>

#include "targets/curve/curve.hpp"
#include "targets/curve/read_points.hpp"

namespace kinetix::targets {

/// Every key of a `target:` section of kind curve.
const KeyTable& curve_target_keys();

/// Reads the curve under the key `points` (read_points).
/// @throws InvalidInput at the point at fault, in the CSV or in the document, as read_points, or for what Curve
/// refuses
Curve read_curve(const Node& points);

/// Reads a curve from a CSV file (read_points_csv).
/// @throws InvalidInput as read_points_csv, or at the point at fault for what Curve refuses
Curve read_curve_csv(const std::string& file);

}  // namespace kinetix::targets
