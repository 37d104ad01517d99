#include "targets/drawing/svg_elements.hpp"

#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>

#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;

/// Follows the commands of a path from point to point.
class PathWalk {
 public:
  explicit PathWalk(std::string_view text) : scan_(text) {}

  std::vector<SvgStroke> run() {
    while (!scan_.at_end()) {
      const char next = scan_.letter();
      if (command_ == 0 && next != 'M' && next != 'm')
        throw InvalidInput("a path does not begin with the command M. Correct the path");
      if (next == 0 && (command_ == 'Z' || command_ == 'z'))
        throw InvalidInput("a path has numbers after the command Z. Correct the path");
      if (next != 0) command_ = next;
      follow();
    }
    return std::move(strokes_);
  }

 private:
  bool is_relative() const { return std::islower(static_cast<unsigned char>(command_)) != 0; }
  Vector2d origin() const { return is_relative() ? now_ : Vector2d(0, 0); }
  Vector2d point() {
    const Vector2d from = origin();
    return from + scan_.point();
  }

  void follow() {
    const char kind = static_cast<char>(std::toupper(static_cast<unsigned char>(command_)));
    switch (kind) {
      case 'M':
        now_ = start_ = point();
        command_ = is_relative() ? 'l' : 'L';
        break;
      case 'L':
        add_line(point());
        break;
      case 'H': {
        const double x = origin().x() + scan_.number();
        add_line({x, now_.y()});
        break;
      }
      case 'V': {
        const double y = origin().y() + scan_.number();
        add_line({now_.x(), y});
        break;
      }
      case 'Z':
        add_line(start_);
        break;
      case 'C':
      case 'S':
      case 'Q':
      case 'T':
        add_bezier(kind);
        return;
      case 'A':
        add_arc();
        break;
      default:
        throw InvalidInput("a path has the command " + in_ticks({&command_, 1}) +
                           ". Give M, L, H, V, C, S, Q, T, A and Z");
    }
    control_ = now_;
    last_ = 0;
  }

  void add_line(const Vector2d& to) {
    if (to != now_) strokes_.push_back({{now_, to}, ""});
    now_ = to;
  }

  void add_curve(ChordPoints points) {
    const bool is_line = points.size() == 2;
    now_ = points.back();
    strokes_.push_back({std::move(points), is_line ? "" : "curved path"});
  }

  /// Adds a Bézier curve. S and T continue the curve before them.
  void add_bezier(char kind) {
    const bool is_cubic = kind == 'C' || kind == 'S', continues = kind == 'S' || kind == 'T';
    const char family = is_cubic ? 'C' : 'Q';
    ChordPoints control = {now_};
    if (continues) control.push_back(last_ == family ? Vector2d(2 * now_ - control_) : now_);
    while (control.size() < (is_cubic ? 4u : 3u)) control.push_back(point());
    control_ = control[control.size() - 2];
    last_ = family;
    add_curve(bezier_chords(control));
  }

  void add_arc() {
    const Vector2d radii = scan_.point();
    const double tilt = scan_.number() * radians_per_degree;
    const bool is_large = scan_.flag(), is_clockwise = scan_.flag();
    add_curve(svg_arc_chords(now_, point(), radii, tilt, is_large, is_clockwise));
  }

  SvgScanner scan_;
  std::vector<SvgStroke> strokes_;
  char command_ = 0;
  char last_ = 0;  ///< family of the curve just before: C, Q, or 0 for none
  Vector2d now_ = {0, 0}, start_ = {0, 0}, control_ = {0, 0};
};

using Eigen::Affine2d;
using Eigen::Vector2d;

constexpr double inch = 96;  // user units, by the definition of CSS

bool is_svg_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Reads a number of a transform: an angle in degrees, a length in user units.
double transform_number(SvgScanner& scan) {
  static const std::map<std::string_view, double> angles = {
      {"", 1}, {"deg", 1}, {"rad", 1 / radians_per_degree}, {"turn", 360}, {"grad", 0.9}};
  const double value = scan.number();
  const std::string_view unit = scan.word();
  if (const auto angle = angles.find(unit); angle != angles.end()) return value * angle->second;
  if (const double units = user_units(unit); units > 0) return value * units;
  throw InvalidInput("a transform has the unit " + in_ticks(unit) + ". Give numbers without a unit");
}

Affine2d one_transform(std::string_view name, const std::vector<double>& n) {
  const auto require_count = [&](std::size_t least, std::size_t most) {
    if (n.size() < least || n.size() > most)
      throw InvalidInput("the transform " + std::string(name) + " has " + std::to_string(n.size()) +
                         " numbers. Give " + std::to_string(least) +
                         (least == most ? "" : " to " + std::to_string(most)));
  };
  Affine2d out = Affine2d::Identity();
  if (name == "translate") {
    require_count(1, 2);
    out.translate(Vector2d(n[0], n.size() > 1 ? n[1] : 0));
  } else if (name == "translateX" || name == "translateY") {
    require_count(1, 1);
    out.translate(name == "translateX" ? Vector2d(n[0], 0) : Vector2d(0, n[0]));
  } else if (name == "scale") {
    require_count(1, 2);
    out.scale(Vector2d(n[0], n.size() > 1 ? n[1] : n[0]));
  } else if (name == "scaleX" || name == "scaleY") {
    require_count(1, 1);
    out.scale(name == "scaleX" ? Vector2d(n[0], 1) : Vector2d(1, n[0]));
  } else if (name == "rotate") {
    require_count(1, 3);
    const Vector2d about = n.size() == 3 ? Vector2d(n[1], n[2]) : Vector2d(0, 0);
    out.translate(about).rotate(n[0] * radians_per_degree).translate(-about);
  } else if (name == "skewX" || name == "skewY") {
    require_count(1, 1);
    out.linear()(name == "skewX" ? 0 : 1, name == "skewX" ? 1 : 0) = std::tan(n[0] * radians_per_degree);
  } else if (name == "matrix") {
    require_count(6, 6);
    out.matrix() << n[0], n[2], n[4], n[1], n[3], n[5], 0, 0, 1;
  } else {
    throw InvalidInput("the transform " + in_ticks(name) +
                       " is not known. Give translate, scale, rotate, skewX, skewY or matrix");
  }
  return out;
}

}  // namespace

std::vector<SvgStroke> parse_svg_path(std::string_view text) { return PathWalk(text).run(); }

bool SvgScanner::at_end() {
  skip();
  return text_.empty();
}

char SvgScanner::letter() {
  skip();
  if (text_.empty() || !is_svg_letter(text_[0])) return 0;
  const char c = text_[0];
  text_.remove_prefix(1);
  return c;
}

std::string_view SvgScanner::word() {
  std::size_t end = 0;
  while (end < text_.size() && is_svg_letter(text_[end])) ++end;
  const std::string_view token = text_.substr(0, end);
  text_.remove_prefix(end);
  return token;
}

double SvgScanner::number() {
  skip();
  if (!text_.empty() && text_[0] == '+') text_.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
  if (error != std::errc() || !std::isfinite(value))
    throw InvalidInput("there is " + in_ticks(text_.substr(0, 20)) + " instead of a number. Give a number");
  text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
  return value;
}

Vector2d SvgScanner::point() {
  const double x = number();
  return {x, number()};
}

bool SvgScanner::flag() {
  skip();
  if (text_.empty() || (text_[0] != '0' && text_[0] != '1'))
    throw InvalidInput("an arc of a path has no flag 0 or 1. Correct the path");
  const bool is_set = text_[0] == '1';
  text_.remove_prefix(1);
  return is_set;
}

bool SvgScanner::at(char c) {
  skip();
  return !text_.empty() && text_[0] == c;
}

void SvgScanner::expect(char c) {
  if (!at(c)) throw InvalidInput(std::string("a transform has no `") + c + "`. Give e.g. translate(10 20)");
  text_.remove_prefix(1);
}

void SvgScanner::skip() {
  const std::size_t start = text_.find_first_not_of(" \t\r\n,");
  text_.remove_prefix(start == std::string_view::npos ? text_.size() : start);
}

double user_units(std::string_view unit) {
  static const std::map<std::string_view, double> known = {
      {"", 1},           {"px", 1},        {"in", inch},       {"mm", inch / 25.4}, {"cm", inch / 2.54},
      {"pt", inch / 72}, {"pc", inch / 6}, {"Q", inch / 101.6}};
  const auto found = known.find(unit);
  return found == known.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
}

double svg_length(std::string_view text, double whole) {
  SvgScanner scan(text);
  const double value = scan.number();
  if (scan.at('%')) return value / 100 * whole;
  const std::string_view unit = scan.word();
  const double units = user_units(unit);
  if (!(units > 0) || !scan.at_end())
    throw InvalidInput("the length " + in_ticks(text) +
                       " has an unknown unit. Give mm, cm, in, pt, pc or px");
  return value * units;
}

Affine2d svg_transform(std::string_view text) {
  SvgScanner scan(text);
  Affine2d all = Affine2d::Identity();
  while (!scan.at_end()) {
    const std::string_view name = scan.word();
    scan.expect('(');
    std::vector<double> numbers;
    while (!scan.at(')')) numbers.push_back(transform_number(scan));
    scan.expect(')');
    all = all * one_transform(name, numbers);
  }
  return all;
}

}  // namespace kinetix::targets
