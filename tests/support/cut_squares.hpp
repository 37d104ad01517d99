#pragma once

#include <fmt/format.h>

#include "targets/drawing/drawing.hpp"

namespace kinetix::testing {

/// Returns the cuts of n x n squares that turn about bridges at their corners, with the outline. At each corner of the
/// grid cuts of one direction pass, and those of the other end short of it.
/// @param side of a square, mm   @param gap width of the bridges, mm
inline std::vector<targets::DrawnLine> cut_squares(int n, double side, double gap) {
  std::vector<targets::DrawnLine> lines;
  const auto add = [&](double x0, double y0, double x1, double y1) {
    lines.push_back({.from = {x0, y0}, .to = {x1, y1}});
  };
  const double whole = n * side;
  add(0, 0, whole, 0);
  add(whole, 0, whole, whole);
  add(whole, whole, 0, whole);
  add(0, whole, 0, 0);
  for (int i = 1; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const bool is_even = (i + j) % 2 == 0;
      const double low = side * j + (is_even ? gap : 0), high = side * (j + 1) - (is_even ? 0 : gap);
      add(side * i, low, side * i, high);
      const double left = side * j + (is_even ? 0 : gap), right = side * (j + 1) - (is_even ? gap : 0);
      add(left, side * i, right, side * i);
    }
  return lines;
}

/// Returns lines as an SVG file in mm.
inline std::string svg_of(const std::vector<targets::DrawnLine>& lines, double size_mm,
                          const char* colour = "black") {
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{0}mm\" viewBox=\"0 0 {0} {0}\">\n",
      size_mm);
  for (const targets::DrawnLine& line : lines)
    out += fmt::format("<line stroke=\"{}\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>\n", colour,
                       line.from.x(), size_mm - line.from.y(), line.to.x(), size_mm - line.to.y());
  return out + "</svg>\n";
}

}  // namespace kinetix::testing
