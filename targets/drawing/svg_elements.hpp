#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <string_view>

#include "targets/drawing/curve_chords.hpp"

namespace pugi {
class xml_document;
class xml_node;
}  // namespace pugi

namespace kinetix::targets {

/// Numbers and words of an attribute of SVG, one after the other.
class SvgScanner {
 public:
  explicit SvgScanner(std::string_view text) : text_(text) {}

  bool at_end();
  /// Returns the next letter, or 0 if a number or the end comes first.
  char letter();
  std::string_view word();
  /// @throws InvalidInput for anything else
  double number();
  Eigen::Vector2d point();
  /// Returns a flag of an arc, which needs no space after it. @throws InvalidInput for anything but 0 and 1
  bool flag();
  bool at(char c);
  void expect(char c);

 private:
  void skip();

  std::string_view text_;
};

/// User units per unit of a length, by https://www.w3.org/TR/css-values-3/#absolute-lengths. NaN for unknown units.
double user_units(std::string_view unit);

/// Reads a length in user units. @param whole 100 %
/// @throws InvalidInput for other units
double svg_length(std::string_view text, double whole);

/// Reads the transforms of an attribute or a style. @throws InvalidInput for unknown transforms
Eigen::Affine2d svg_transform(std::string_view text);

/// Part of an SVG element: straight lines, or the chords of one curve.
struct SvgStroke {
  ChordPoints points;
  std::string curve;  ///< name of the curve; empty for straight lines
};

/// Reads the strokes of a path. @throws InvalidInput for a path that cannot be read
std::vector<SvgStroke> parse_svg_path(std::string_view text);

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
