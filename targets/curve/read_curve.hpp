#pragma once

#include <cstddef>
#include <string>

#include "targets/curve/curve.hpp"
#include "targets/document/section.hpp"

namespace kinetix::targets {

/// Bytes of a CSV file, 16 MiB: 80 for each of the points allowed, more than two numbers in full precision
/// take.
inline constexpr std::size_t max_csv_bytes = 16 << 20;
/// Points of a curve: far finer than cells can follow; a limit so that a wrong file is refused, not worked
/// on.
inline constexpr std::size_t max_curve_points = 200'000;
/// mm, either way from 0: a kilometre is larger than any sheet, so that a point beyond it is a wrong unit.
inline constexpr double max_coordinate_mm = 1e6;

/// Every key of a `target:` section of kind curve.
const KeyTable& curve_target_keys();

/// The curve under the key `points`: the path of a CSV file, relative to the document's folder, or a list
/// [[x, z], ...], in mm.
/// @throws InvalidInput at the point at fault, in the CSV or in the document
Curve read_curve(const Node& points);

/// A CSV file whose first line is the header `x,z` (or `x_mm,z_mm`), then one point a row, mm. Empty lines,
/// lines that start with #, spaces around a number, CRLF and a byte order mark are fine.
/// @throws InvalidInput naming file:line:column for another header or unit, a row that is not two finite
/// numbers within a kilometre, more than 200 000 points, more than 16 MiB, or what Curve refuses
Curve read_curve_csv(const std::string& file);

}  // namespace kinetix::targets
