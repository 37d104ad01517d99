#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

namespace pugi {
class xml_document;
class xml_node;
}  // namespace pugi

namespace kinetix::targets {

/// Size of the user units of an SVG file.
struct SvgPage {
  double unit_mm = 0;     ///< of a user unit along x
  bool has_unit = false;  ///< whether the file determines the unit, which is assumed otherwise
  std::string source;     ///< part of the file that gives the unit, or the assumption and its reason
  double stretch = 1;     ///< length of a user unit along y, relative to x
  Eigen::Vector2d size = Eigen::Vector2d(0, 0);  ///< whole size for percents, user units
};

/// Reads width, height and viewBox of the outermost svg element. @throws InvalidInput for a viewBox that cannot be read
SvgPage read_svg_page(const pugi::xml_document& document);

/// Returns the transform from the contents of a nested svg or symbol element to its parent. Its size is that of the
/// element that places it, which is the nested svg itself or a use. @param whole size of the parent, user units. Set to
/// the size of the contents.
Eigen::Affine2d svg_viewport(const pugi::xml_node& node, const pugi::xml_node& placed,
                             Eigen::Vector2d& whole);

}  // namespace kinetix::targets
