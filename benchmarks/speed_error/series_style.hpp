#pragma once

#include <string>

namespace kinetix::bench {

enum class Marker { diamond, circle, ring, triangle };

/// Style of a legend entry.
struct SeriesStyle {
  std::string colour;
  Marker marker = Marker::circle;
  bool is_dashed = false;  ///< its line
};

/// Returns the style of a series. Single precision has the colour of double, hollow markers and a dashed line. Methods
/// without an entry are purple triangles.
SeriesStyle style_of(const std::string& series);

/// Draws one marker, about 7 wide. @param opacity in [0, 1]
std::string svg_marker(const SeriesStyle& style, double x, double y, double opacity);

}  // namespace kinetix::bench
