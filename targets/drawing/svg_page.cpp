
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <pugixml.hpp>

#include "model/base/invalid_input.hpp"
#include "targets/document/wording.hpp"
#include "targets/drawing/svg_elements.hpp"
#include "targets/drawing/svg_style.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Affine2d;
using Eigen::Vector2d;

constexpr double inch_mm = 25.4;  // mm, by its definition

/// Pixels per inch of the program that wrote a file.
struct PixelSize {
  double per_inch = 96;
  std::string program = {};  ///< empty: not known, and the pixels are those of CSS
};

bool is_by_illustrator(const pugi::xml_document& document) {
  for (const pugi::xml_node& node : document.children())
    if (node.type() == pugi::node_comment &&
        std::string_view(node.value()).find("Adobe Illustrator") != std::string_view::npos)
      return true;
  const pugi::xml_node svg = document.document_element();
  return std::string_view(svg.attribute("x").value()) == "0px" &&
         std::string_view(svg.attribute("y").value()) == "0px";
}

PixelSize pixels_of(const pugi::xml_document& document) {
  constexpr double illustrator = 72, early_inkscape = 90, changed_in = 0.92;
  if (is_by_illustrator(document)) return {illustrator, "Illustrator"};
  const pugi::xml_attribute version = document.document_element().attribute("inkscape:version");
  if (!version) return {};
  if (std::atof(version.value()) < changed_in) return {early_inkscape, "Inkscape before 0.92"};
  return {.program = "Inkscape"};
}

/// Width or height of a page.
struct PageSide {
  std::string text;
  double user_units = 0;  ///< 0: none, in percent, or in a unit without a size
  bool has_unit = false;
  bool is_in_pixels = false;  ///< px or no unit
};

/// Reads a length as browsers do. Blanks before the unit and capitals do not matter.
PageSide read_side(const std::string& text) {
  PageSide side{text};
  if (text.find_first_of("+.0123456789") != 0 || text.find('%') != std::string::npos) return side;
  SvgScanner scan(text);
  const double value = scan.number();
  scan.at_end();  // skips blanks
  std::string unit = lower_case(scan.word());
  if (unit == "q") unit = "Q";
  const double units = user_units(unit);
  if (!(units > 0) || !(value > 0)) return side;
  return {fmt::format("{:g}{}", value, unit), value * units, !unit.empty(), unit.empty() || unit == "px"};
}

/// Reads width or height of the page from its style, or else from its attribute.
PageSide side_of(const pugi::xml_node& svg, const char* name) {
  const PageSide styled = read_side(SvgStyles(pugi::xml_node()).property(svg, name));
  return styled.user_units > 0 ? styled : read_side(svg.attribute(name).value());
}

struct ViewBox {
  Vector2d low, size;
};

std::optional<ViewBox> view_box(const pugi::xml_node& node) {
  const pugi::xml_attribute box = node.attribute("viewBox");
  if (!box) return std::nullopt;
  SvgScanner scan(box.value());
  const Vector2d low = scan.point(), size = scan.point();
  if (!(size.minCoeff() > 0))
    throw InvalidInput("the viewBox has no size. Give `viewBox=\"x y width height\"` with a positive size");
  return ViewBox{low, size};
}

/// Applies preserveAspectRatio to the scales along x and y, by
/// https://www.w3.org/TR/SVG11/coords.html#PreserveAspectRatioAttribute
Vector2d fitted(const pugi::xml_node& node, const Vector2d& scale) {
  const std::string_view aspect = node.attribute("preserveAspectRatio").value();
  if (aspect == "none") return scale;
  return Vector2d::Constant(aspect.ends_with("slice") ? scale.maxCoeff() : scale.minCoeff());
}

constexpr const char* sides_text = "width and height";

/// Reports why a page has no unit.
std::string reason_without_unit(const PageSide& width, const PageSide& height) {
  if (width.text.empty() && height.text.empty()) return fmt::format("the file has no {}", sides_text);
  if (width.user_units > 0 || height.user_units > 0) return fmt::format("{} have no unit", sides_text);
  return fmt::format("{} are not lengths", sides_text);
}

}  // namespace

SvgPage read_svg_page(const pugi::xml_document& document) {
  const pugi::xml_node svg = document.document_element();
  const PixelSize pixels = pixels_of(document);
  const PageSide width = side_of(svg, "width"), height = side_of(svg, "height");
  const auto box = view_box(svg);
  const double css_pixel_mm = inch_mm / 96;
  SvgPage page;
  Vector2d scale(1, 1);  // user units of CSS per unit of the viewBox
  const bool has_size = width.user_units > 0 || height.user_units > 0;
  page.size = {width.user_units, height.user_units};
  if (box) {
    page.size = box->size;
    if (has_size) {
      const double x = width.user_units / box->size.x(), y = height.user_units / box->size.y();
      scale = fitted(svg, {x > 0 ? x : y, y > 0 ? y : x});
      page.stretch = scale.y() / scale.x();
    }
  }
  const PageSide& side = width.user_units > 0 ? width : height;
  const bool in_pixels = !has_size || side.is_in_pixels || !box;
  page.has_unit = !pixels.program.empty() || (has_size && side.has_unit);
  const double css_mm = in_pixels ? inch_mm / pixels.per_inch : css_pixel_mm;
  page.unit_mm = scale.x() * css_mm;
  const char* name = width.user_units > 0 ? "width" : "height";
  if (!page.has_unit)
    page.source = "px of 1/96 inch, assumed because " + reason_without_unit(width, height);
  else if (!in_pixels)
    page.source = fmt::format("{} {}", name, side.text);
  else
    page.source = fmt::format("px of 1/{:g} inch{}{}", css_mm == css_pixel_mm ? 96 : pixels.per_inch,
                              pixels.program.empty() ? "" : ", as in files of ", pixels.program);
  return page;
}

Affine2d svg_viewport(const pugi::xml_node& node, const pugi::xml_node& placed, Vector2d& whole) {
  const auto length = [&](const char* name, double all, const char* otherwise) {
    const std::string_view text = placed.attribute(name).value();
    return svg_length(text.empty() ? otherwise : text, all);
  };
  const Vector2d at(length("x", whole.x(), "0"), length("y", whole.y(), "0"));
  const Vector2d size(length("width", whole.x(), "100%"), length("height", whole.y(), "100%"));
  Affine2d out = Affine2d::Identity();
  out.translate(at);
  whole = size;
  if (const auto box = view_box(node)) {
    const Vector2d scale = fitted(node, size.cwiseQuotient(box->size));
    const std::string_view aspect = node.attribute("preserveAspectRatio").value();
    const auto share = [&](const char* low, const char* high) {
      return aspect.find(low) != std::string_view::npos    ? 0
             : aspect.find(high) != std::string_view::npos ? 1
                                                           : 0.5;
    };
    const Vector2d rest = size - scale.cwiseProduct(box->size);
    out.translate(rest.cwiseProduct(Vector2d(share("xMin", "xMax"), share("YMin", "YMax"))));
    out.scale(scale).translate(-box->low);
    whole = box->size;
  }
  return out;
}

}  // namespace kinetix::targets
