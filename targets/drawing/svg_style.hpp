#pragma once

#include <map>
#include <string>
#include <string_view>

namespace pugi {
class xml_node;
}  // namespace pugi

namespace kinetix::targets {

/// Name of an element without its namespace.
std::string_view svg_name(const pugi::xml_node& node);

/// Attribute of any namespace, such as `xlink:href` for `href`.
std::string_view svg_attribute(const pugi::xml_node& node, std::string_view name);

/// Rules of the style elements of an SVG file. Selectors are of an element, a class, an id, or an element with a class.
class SvgStyles {
 public:
  explicit SvgStyles(const pugi::xml_node& svg);

  /// Returns a property of an element: from its style attribute, the style sheets or its own attribute. Empty if it is
  /// not set.
  std::string property(const pugi::xml_node& node, std::string_view name) const;

 private:
  /// Value of a property, and the number of its rule in the file.
  struct Value {
    std::string text;
    int rule = 0;
  };
  using Values = std::map<std::string, Value, std::less<>>;

  void read_sheet(std::string_view text);
  const Value* find(const std::string& selector, std::string_view name) const;

  std::map<std::string, Values, std::less<>> values_of_;  ///< by selector
};

/// Returns a colour as 0xRRGGBB; black for paints that are not known.
int svg_colour(std::string_view text);

}  // namespace kinetix::targets
