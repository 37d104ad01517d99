#include <Eigen/Geometry>
#include <charconv>
#include <cmath>
#include <pugixml.hpp>

#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"
#include "targets/document/wording.hpp"
#include "targets/drawing/drawing.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Affine2d;
using Eigen::Vector2d;

// mm of a user unit where the file says no more, by https://www.w3.org/TR/css-values-3/#absolute-lengths
constexpr double pixel_mm = 25.4 / 96;

constexpr int deepest = 100;  // groups in each other: drawings have some ten

/// Numbers and words of an attribute, one after the other.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  bool at_end() {
    skip();
    return text_.empty();
  }
  /// Returns the next letter, or 0 if a number or the end comes first.
  char letter() {
    skip();
    if (text_.empty() || !std::isalpha(static_cast<unsigned char>(text_[0]))) return 0;
    const char c = text_[0];
    text_.remove_prefix(1);
    return c;
  }
  std::string_view word() {
    skip();
    std::size_t end = 0;
    while (end < text_.size() && std::isalpha(static_cast<unsigned char>(text_[end]))) ++end;
    return take(end);
  }
  /// Skips this word if it comes next.
  void word(std::string_view wanted) {
    skip();
    if (text_.starts_with(wanted)) text_.remove_prefix(wanted.size());
  }
  double number() {
    skip();
    if (!text_.empty() && text_[0] == '+') text_.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
    if (error != std::errc() || !std::isfinite(value))
      throw InvalidInput("has " + in_ticks(text_.substr(0, 20)) + " instead of a number. Give a number");
    text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
    return value;
  }
  Vector2d point() {
    const double x = number();
    return {x, number()};
  }
  bool at(char c) {
    skip();
    return !text_.empty() && text_[0] == c;
  }
  void expect(char c) {
    if (!at(c)) throw InvalidInput(std::string("has no `") + c + "` where a transform needs one");
    text_.remove_prefix(1);
  }

 private:
  void skip() {
    const std::size_t start = text_.find_first_not_of(" \t\r\n,");
    text_.remove_prefix(start == std::string_view::npos ? text_.size() : start);
  }
  std::string_view take(std::size_t count) {
    const std::string_view token = text_.substr(0, count);
    text_.remove_prefix(count);
    return token;
  }

  std::string_view text_;
};

Affine2d one_transform(std::string_view name, const std::vector<double>& n) {
  const auto wants = [&](std::size_t least, std::size_t most) {
    if (n.size() < least || n.size() > most)
      throw InvalidInput("has a transform " + std::string(name) + " of " + std::to_string(n.size()) +
                         " numbers");
  };
  Affine2d out = Affine2d::Identity();
  if (name == "translate") {
    wants(1, 2);
    out.translate(Vector2d(n[0], n.size() > 1 ? n[1] : 0));
  } else if (name == "scale") {
    wants(1, 2);
    out.scale(Vector2d(n[0], n.size() > 1 ? n[1] : n[0]));
  } else if (name == "rotate") {
    wants(1, 3);
    const Vector2d about = n.size() == 3 ? Vector2d(n[1], n[2]) : Vector2d(0, 0);
    out.translate(about).rotate(n[0] * radians_per_degree).translate(-about);
  } else if (name == "matrix") {
    wants(6, 6);
    out.matrix() << n[0], n[2], n[4], n[1], n[3], n[5], 0, 0, 1;
  } else {
    throw InvalidInput("has a transform `" + std::string(name) +
                       "`. Give translate, scale, rotate or matrix");
  }
  return out;
}

Affine2d transform_of(const pugi::xml_node& node) {
  Scanner scan(node.attribute("transform").value());
  Affine2d all = Affine2d::Identity();
  while (!scan.at_end()) {
    const std::string_view name = scan.word();
    scan.expect('(');
    std::vector<double> numbers;
    while (!scan.at(')')) numbers.push_back(scan.number());
    scan.expect(')');
    all = all * one_transform(name, numbers);
  }
  return all;
}

/// Whether an element is hidden, as drawing programs hide a layer.
bool is_hidden(const pugi::xml_node& node) {
  std::string style = node.attribute("style").value();
  std::erase(style, ' ');
  return std::string_view(node.attribute("display").value()) == "none" ||
         style.find("display:none") != std::string::npos;
}

/// Lines of one element after the other, in mm.
class Reader {
 public:
  void read(const pugi::xml_node& node, const Affine2d& above, int depth = 0) {
    if (depth > deepest)
      throw InvalidInput("has groups more than " + std::to_string(deepest) + " levels deep");
    const std::string_view name = local_name(node);
    if (name == "defs" || name == "symbol" || name == "clipPath" || name == "mask") return;
    if (is_hidden(node)) return;
    if (name == "svg" && depth > 0)
      throw InvalidInput(
          "the drawing has an svg within its svg, which may have a different scale. Ungroup it");
    const Affine2d at = above * transform_of(node);
    if (name == "line")
      add(at, {number(node, "x1"), number(node, "y1")}, {number(node, "x2"), number(node, "y2")});
    else if (name == "polyline" || name == "polygon")
      add_points(at, node.attribute("points").value(), name == "polygon");
    else if (name == "rect")
      add_rectangle(at, node);
    else if (name == "path")
      add_path(at, node.attribute("d").value());
    else if (name == "circle" || name == "ellipse" || name == "use")
      throw InvalidInput("has a " + std::string(name) +
                         ". Draw walls as line, polyline, polygon, rect or straight paths");
    for (const pugi::xml_node& child : node.children()) read(child, at, depth + 1);
  }

  Drawing take() { return std::move(lines_); }

 private:
  static std::string_view local_name(const pugi::xml_node& node) {
    const std::string_view name = node.name();
    const std::size_t colon = name.find(':');
    return colon == std::string_view::npos ? name : name.substr(colon + 1);
  }

  static double number(const pugi::xml_node& node, const char* key) {
    const std::string_view text = node.attribute(key).value();
    if (text.empty()) return 0;
    Scanner scan(text);
    const double value = scan.number();
    scan.word("px");
    if (!scan.at_end())
      throw InvalidInput("has the length " + in_ticks(text) + ". Give user units, without a unit");
    return value;
  }

  void add(const Affine2d& at, const Vector2d& a, const Vector2d& b) { lines_.push_back({at * a, at * b}); }

  void add_points(const Affine2d& at, std::string_view text, bool closed) {
    Scanner scan(text);
    std::vector<Vector2d> points;
    while (!scan.at_end()) points.push_back(scan.point());
    for (std::size_t k = 1; k < points.size(); ++k) add(at, points[k - 1], points[k]);
    if (closed && points.size() > 2) add(at, points.back(), points.front());
  }

  void add_rectangle(const Affine2d& at, const pugi::xml_node& node) {
    const Vector2d low(number(node, "x"), number(node, "y"));
    if (number(node, "rx") > 0 || number(node, "ry") > 0)
      throw InvalidInput("there is a rect with round corners. Draw straight walls");
    const Vector2d wide(number(node, "width"), 0), high(0, number(node, "height"));
    const Vector2d corners[] = {low, low + wide, low + wide + high, low + high};
    for (int k = 0; k < 4; ++k) add(at, corners[k], corners[(k + 1) % 4]);
  }

  void add_path(const Affine2d& at, std::string_view text) {
    Scanner scan(text);
    Vector2d now(0, 0), start(0, 0);
    char command = 0;
    while (!scan.at_end()) {
      const char next = scan.letter();
      const bool is_new = next != 0;
      if (command == 0 && std::toupper(static_cast<unsigned char>(next)) != 'M')
        throw InvalidInput("has a path that begins with no M");
      if (is_new) command = next;
      const bool relative = std::islower(static_cast<unsigned char>(command));
      const Vector2d from = relative ? now : Vector2d(0, 0);
      Vector2d to = now;
      switch (std::toupper(static_cast<unsigned char>(command))) {
        case 'M':
          now = start = from + scan.point();
          command = relative ? 'l' : 'L';
          continue;
        case 'L':
          to = from + scan.point();
          break;
        case 'H':
          to.x() = from.x() + scan.number();
          break;
        case 'V':
          to.y() = from.y() + scan.number();
          break;
        case 'Z':
          to = start;
          if (!is_new) throw InvalidInput("has numbers after the command `Z` of a path");
          break;
        default:
          throw InvalidInput(std::string("has a path with the command `") + command +
                             "`. Draw straight walls by M, L, H, V and Z");
      }
      if (to != now) add(at, now, to);
      now = to;
    }
  }

  Drawing lines_;
};

/// Reads a length attribute in mm; empty for percents and missing attributes.
std::optional<double> length_mm(const pugi::xml_attribute& attribute) {
  if (!attribute || std::string_view(attribute.value()).find('%') != std::string_view::npos)
    return std::nullopt;
  Scanner scan(attribute.value());
  const double value = scan.number();
  const std::string_view unit = scan.word();
  if (unit == "mm") return value;
  if (unit == "cm") return 10 * value;
  if (unit == "in") return 25.4 * value;
  if (unit == "pt") return 25.4 / 72 * value;
  if (unit.empty() || unit == "px") return pixel_mm * value;
  throw InvalidInput("has a size in " + in_ticks(unit) + ". Give mm, cm, in, pt or px");
}

/// Returns the transform from user units to mm, y upwards.
Affine2d page(const pugi::xml_node& svg) {
  double mm_x = pixel_mm, mm_y = pixel_mm;
  const auto width = length_mm(svg.attribute("width")), height = length_mm(svg.attribute("height"));
  if (const pugi::xml_attribute box = svg.attribute("viewBox")) {
    Scanner scan(box.value());
    scan.point();
    const Vector2d size = scan.point();
    if (width && size.x() > 0) mm_x = *width / size.x();
    mm_y = height && size.y() > 0 ? *height / size.y() : mm_x;
    if (!width) mm_x = mm_y;
    // The rules are those of https://www.w3.org/TR/SVG11/coords.html#PreserveAspectRatioAttribute
    const std::string_view aspect = svg.attribute("preserveAspectRatio").value();
    const bool is_cut = aspect.ends_with("slice");
    if (aspect != "none") mm_x = mm_y = is_cut ? std::max(mm_x, mm_y) : std::min(mm_x, mm_y);
  }
  Affine2d out = Affine2d::Identity();
  out.scale(Vector2d(mm_x, -mm_y));
  return out;
}

}  // namespace

Drawing parse_svg(const std::string& text) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
  if (!parsed) throw InvalidInput(std::string("is not an SVG file: ") + parsed.description());
  const pugi::xml_node svg = document.document_element();
  if (!std::string_view(svg.name()).ends_with("svg")) throw InvalidInput("is not an SVG file");
  Reader reader;
  reader.read(svg, page(svg));
  return reader.take();
}

}  // namespace kinetix::targets
