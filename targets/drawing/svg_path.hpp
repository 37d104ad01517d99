#pragma once

#include <string>
#include <string_view>

#include "targets/drawing/curve_chords.hpp"

namespace kinetix::targets {

/// Part of an SVG element: straight lines, or the chords of one curve.
struct SvgStroke {
  ChordPoints points;
  std::string curve;  ///< name of the curve; empty for straight lines
};

/// Reads the strokes of a path. @throws InvalidInput for a path that cannot be read
std::vector<SvgStroke> parse_svg_path(std::string_view text);

}  // namespace kinetix::targets
