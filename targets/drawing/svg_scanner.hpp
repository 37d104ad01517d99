#pragma once

#include <Eigen/Geometry>
#include <string_view>

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

}  // namespace kinetix::targets
