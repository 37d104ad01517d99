#pragma once

#include <string>

namespace kinetix::bench {

enum class Marker { diamond, circle, ring, triangle };

/// How a legend entry is drawn.
struct SeriesStyle {
  std::string colour;
  Marker marker = Marker::circle;
  bool is_dashed = false;  ///< its line
};

/// Single precision has the colour of double, hollow markers and a dashed line. Methods without a style of
/// their own are purple triangles.
SeriesStyle style_of(const std::string& series);

/// One marker, about 7 wide. @param opacity in [0, 1]
std::string svg_marker(const SeriesStyle& style, double x, double y, double opacity);

}  // namespace kinetix::bench
