#include <algorithm>
#include <cmath>
#include <pugixml.hpp>
#include <set>
#include <unordered_map>
#include <utility>

#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"
#include "targets/document/wording.hpp"
#include "targets/drawing/drawing.hpp"
#include "targets/drawing/svg_elements.hpp"
#include "targets/drawing/svg_style.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Affine2d;
using Eigen::Vector2d;

constexpr int deepest_group = 100;                      // groups in each other: drawings have some ten
constexpr std::size_t max_svg_elements = 2'000'000;     // including those that `use` repeats
constexpr std::size_t max_transformed_length = 10'000;  // bytes of a transform: rows of transforms take time

/// State that elements inherit.
struct Inherited {
  Affine2d at = Affine2d::Identity();
  Vector2d whole = Vector2d(0, 0);  ///< 100 % along x and y
  std::string stroke = {}, fill = {};
  bool is_visible = true;
  int depth = 0;
};

/// Lines of numbers of bytes in a file.
class LineNumbers {
 public:
  explicit LineNumbers(const std::string& text) {
    for (std::size_t k = 0; k < text.size(); ++k)
      if (text[k] == '\n') ends_.push_back(static_cast<std::ptrdiff_t>(k));
  }
  int of(const pugi::xml_node& node) const {
    const auto below = std::lower_bound(ends_.begin(), ends_.end(), node.offset_debug());
    return static_cast<int>(below - ends_.begin()) + 1;
  }

 private:
  std::vector<std::ptrdiff_t> ends_;
};

bool is_paint_absent(const std::string& paint) { return paint == "none" || paint == "transparent"; }

bool is_white(const std::string& paint) { return !paint.empty() && svg_colour(paint) == 0xFFFFFF; }

/// Reads element after element.
class SvgReader {
 public:
  SvgReader(const pugi::xml_document& document, const std::string& text)
      : svg_(document.document_element()), styles_(svg_), numbers_(text) {}

  Drawing run(const SvgPage& page) {
    Inherited all;
    all.at.scale(Vector2d(1, -page.stretch));
    all.whole = page.size;
    read(svg_, all);
    out_.unit_mm = page.unit_mm;
    out_.has_unit = page.has_unit;
    out_.unit_source = page.source;
    return std::move(out_);
  }

 private:
  void read(const pugi::xml_node& node, const Inherited& above) {
    try {
      read_element(node, above);
    } catch (const InvalidInput& e) {
      if (e.place().line > 0) throw;
      throw InvalidInput(e.reason(), {"", numbers_.of(node), 1});
    }
  }

  void read_element(const pugi::xml_node& node, const Inherited& above) {
    static const std::set<std::string_view> groups = {"svg", "g", "a", "switch", "use", "symbol"};
    if (above.depth > deepest_group)
      throw InvalidInput("groups are nested more than " + std::to_string(deepest_group) +
                         " levels deep. Ungroup them");
    if (++elements_ > max_svg_elements)
      throw InvalidInput("the drawing has more than 2 million elements. Give a smaller drawing");
    const pugi::xml_node placer = std::exchange(placer_, {});
    const std::string_view name = svg_name(node);
    const bool is_group = groups.contains(name);
    if (!is_group && !is_shape(name)) return;
    Inherited now = inherit(node, above);
    if (styles_.property(node, "display") == "none" || styles_.property(node, "opacity") == "0") return;
    if (name == "use") return expand(node, now);
    if (!is_group) return add_shape(node, name, now);
    if ((name == "svg" && node != svg_) || name == "symbol")
      now.at = now.at * svg_viewport(node, placer ? placer : node, now.whole);
    for (const pugi::xml_node& child : node.children())
      if (svg_name(child) != "symbol") read(child, now);
  }

  Inherited inherit(const pugi::xml_node& node, const Inherited& above) const {
    Inherited now = above;
    ++now.depth;
    const std::string transform = styles_.property(node, "transform");
    if (transform.size() > max_transformed_length)
      throw InvalidInput("a transform is longer than 10 000 bytes. Simplify it");
    if (!transform.empty() && transform != "none") {
      if (!styles_.property(node, "transform-origin").empty())
        throw InvalidInput("a transform-origin is not supported. Apply the transform in the drawing program");
      now.at = now.at * svg_transform(transform);
    }
    for (const auto& [name, value] : {std::pair("stroke", &now.stroke), std::pair("fill", &now.fill)})
      if (std::string own = styles_.property(node, name); !own.empty()) *value = std::move(own);
    const std::string visibility = styles_.property(node, "visibility");
    if (!visibility.empty()) now.is_visible = visibility != "hidden" && visibility != "collapse";
    return now;
  }

  void expand(const pugi::xml_node& node, Inherited now) {
    const std::string_view link = svg_attribute(node, "href");
    if (!link.starts_with('#'))
      throw InvalidInput("a use element refers to another file. Embed the element in the drawing");
    const pugi::xml_node used = element_of(std::string(link.substr(1)));
    if (!used) throw InvalidInput("the element " + in_ticks(link) + " of a use is missing. Remove the use");
    const std::string_view name = svg_name(used);
    const bool has_viewport = name == "symbol" || name == "svg";
    if (!has_viewport)
      now.at.translate(Vector2d(length(node, "x", now.whole.x()), length(node, "y", now.whole.y())));
    placer_ = has_viewport ? node : pugi::xml_node();
    read(used, now);
  }

  pugi::xml_node element_of(const std::string& id) {
    if (ids_.empty()) collect_ids(svg_, 0);
    const auto found = ids_.find(id);
    return found == ids_.end() ? pugi::xml_node() : found->second;
  }

  void collect_ids(const pugi::xml_node& node, int depth) {
    if (depth > deepest_group) return;
    ids_.try_emplace(node.attribute("id").value(), node);
    for (const pugi::xml_node& child : node.children()) collect_ids(child, depth + 1);
  }

  static bool is_shape(std::string_view name) {
    static const std::set<std::string_view> shapes = {"line", "polyline", "polygon", "rect",
                                                      "path", "circle",   "ellipse"};
    return shapes.contains(name);
  }

  /// Whether a shape leaves no ink on white paper. Shapes without any paint are lines for cutters.
  static bool is_blank(std::string_view name, const Inherited& now) {
    const bool is_empty = is_paint_absent(now.fill) || is_white(now.fill);
    if (is_paint_absent(now.stroke)) return is_empty || name == "line";
    return name == "rect" && now.stroke.empty() && is_white(now.fill);
  }

  static double length(const pugi::xml_node& node, const char* key, double whole) {
    const std::string_view text = node.attribute(key).value();
    return text.empty() ? 0 : svg_length(text, whole);
  }

  void add_shape(const pugi::xml_node& node, std::string_view name, const Inherited& now) {
    if (!now.is_visible || is_blank(name, now)) return;
    const double x = now.whole.x(), y = now.whole.y();
    for (const SvgStroke& stroke : strokes_of(node, name, x, y)) add(stroke, now, numbers_.of(node));
  }

  static std::vector<SvgStroke> strokes_of(const pugi::xml_node& node, std::string_view name, double x,
                                           double y) {
    if (name == "path") return parse_svg_path(node.attribute("d").value());
    if (name == "line")
      return {
          {{{length(node, "x1", x), length(node, "y1", y)}, {length(node, "x2", x), length(node, "y2", y)}},
           ""}};
    if (name == "rect") return rectangle(node, x, y);
    if (name == "circle" || name == "ellipse") {
      const double r = name == "circle" ? length(node, "r", Vector2d(x, y).norm() / std::sqrt(2.0)) : 0;
      const Vector2d radii =
          name == "circle" ? Vector2d(r, r) : Vector2d(length(node, "rx", x), length(node, "ry", y));
      if (!(radii.minCoeff() > 0)) return {};
      return {{ellipse_chords({length(node, "cx", x), length(node, "cy", y)}, {radii.x(), 0}, {0, radii.y()},
                              0, 2 * pi),
               std::string(name)}};
    }
    ChordPoints points;
    SvgScanner scan(node.attribute("points").value());
    while (!scan.at_end()) points.push_back(scan.point());
    if (name == "polygon" && points.size() > 2) points.push_back(points.front());
    return {{std::move(points), ""}};
  }

  static std::vector<SvgStroke> rectangle(const pugi::xml_node& node, double x, double y) {
    const Vector2d low(length(node, "x", x), length(node, "y", y));
    const Vector2d wide(length(node, "width", x), 0), high(0, length(node, "height", y));
    double rx = length(node, "rx", x), ry = length(node, "ry", y);
    if (!node.attribute("rx")) rx = ry;
    if (!node.attribute("ry")) ry = rx;
    rx = std::min(rx, wide.x() / 2);
    ry = std::min(ry, high.y() / 2);
    if (!(rx > 0 && ry > 0)) return {{{low, low + wide, low + wide + high, low + high, low}, ""}};
    ChordPoints points;
    for (int k = 0; k < 4; ++k) {  // clockwise as seen, from the corner at the lower right
      const Vector2d corner =
          low + (k == 0 || k == 3 ? wide : Vector2d(0, 0)) + (k < 2 ? high : Vector2d(0, 0));
      const Vector2d inwards(k == 0 || k == 3 ? -rx : rx, k < 2 ? -ry : ry);
      const double from = k * pi / 2;
      for (const Vector2d& p : ellipse_chords(corner + inwards, {rx, 0}, {0, ry}, from, from + pi / 2))
        points.push_back(p);
    }
    points.push_back(points.front());
    return {{std::move(points), "rect with round corners"}};
  }

  void add(const SvgStroke& stroke, const Inherited& now, int line) {
    if (stroke.points.size() < 2) return;
    const int colour = svg_colour(now.stroke);
    int curve = -1;
    if (!stroke.curve.empty()) {
      curve = static_cast<int>(out_.curves.size());
      out_.curves.push_back(stroke.curve);
    }
    for (std::size_t k = 1; k < stroke.points.size(); ++k) {
      out_.lines.push_back({now.at * stroke.points[k - 1], now.at * stroke.points[k], line, colour, curve});
      if (!out_.lines.back().from.allFinite() || !out_.lines.back().to.allFinite())
        throw InvalidInput("a coordinate is too large. Give smaller numbers");
    }
    if (out_.lines.size() > max_drawn_lines)
      throw InvalidInput("the drawing has more than a million lines. Give a smaller drawing");
  }

  pugi::xml_node svg_;
  SvgStyles styles_;
  LineNumbers numbers_;
  std::unordered_map<std::string, pugi::xml_node> ids_;
  pugi::xml_node placer_;  ///< use that places the svg or symbol element that is read next
  std::size_t elements_ = 0;
  Drawing out_;
};

}  // namespace

Drawing parse_svg(const std::string& text) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed =
      document.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_comments);
  if (!parsed)
    throw InvalidInput(std::string("this is not an SVG file: ") + parsed.description() +
                       ". Save it again as SVG");
  if (svg_name(document.document_element()) != "svg")
    throw InvalidInput("this is not an SVG file. Give a file whose first element is svg");
  return SvgReader(document, text).run(read_svg_page(document));
}

}  // namespace kinetix::targets
