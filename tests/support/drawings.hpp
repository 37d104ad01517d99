#pragma once

#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

#include "targets/drawing/drawing.hpp"

namespace kinetix::testing {

/// Returns a DXF file. @param parts groups of its entities   @param header groups of its header
inline std::string dxf_file(const std::string& parts, const std::string& header = "",
                            const std::string& sections = "") {
  return (header.empty() ? "" : "0\nSECTION\n2\nHEADER\n" + header + "0\nENDSEC\n") + sections +
         "0\nSECTION\n2\nENTITIES\n" + parts + "0\nENDSEC\n0\nEOF\n";
}

/// Returns the groups of a LINE entity.
inline std::string dxf_line(double x0, double y0, double x1, double y1, const std::string& layer = "0") {
  std::ostringstream text;
  text << "0\nLINE\n8\n"
       << layer << "\n10\n"
       << x0 << "\n20\n"
       << y0 << "\n30\n0\n11\n"
       << x1 << "\n21\n"
       << y1 << "\n31\n0\n";
  return text.str();
}

/// Returns the header of a DXF file with this unit.
inline std::string dxf_unit(int number) { return "9\n$INSUNITS\n70\n" + std::to_string(number) + "\n"; }

/// Returns an SVG file of 100 mm x 80 mm with user units of a millimetre.
inline std::string svg_file(const std::string& elements) {
  return "<?xml version=\"1.0\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100mm\" height=\"80mm\" "
         "viewBox=\"0 0 100 80\">" +
         elements + "</svg>\n";
}

/// Expects lines by x and y of both ends.
inline void expect_lines(const targets::Drawing& found, const std::vector<std::array<double, 4>>& expected) {
  ASSERT_EQ(found.lines.size(), expected.size());
  for (std::size_t k = 0; k < found.lines.size(); ++k) {
    const auto& [x0, y0, x1, y1] = expected[k];
    EXPECT_LE((found.lines[k].from - Eigen::Vector2d(x0, y0)).norm(), 1e-9)
        << "line " << k << " from " << found.lines[k].from.transpose();
    EXPECT_LE((found.lines[k].to - Eigen::Vector2d(x1, y1)).norm(), 1e-9)
        << "line " << k << " to " << found.lines[k].to.transpose();
  }
}

}  // namespace kinetix::testing
