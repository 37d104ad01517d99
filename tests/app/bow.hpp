#pragma once

namespace kinetix::testing {

/// A bow of 30 mm over 96 mm in ten cells: quick to search and to verify.
inline constexpr const char* bow = R"(kinetix: 1
name: bow
target: {kind: curve, points: [[0, 0], [16, 17], [32, 27], [48, 30], [64, 27], [80, 17], [96, 0]]}
structure: {cells: [10, 1], cell_mm: 14}
)";

}  // namespace kinetix::testing
