#include "targets/drawing/svg_path.hpp"

#include <cctype>

#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"
#include "targets/document/wording.hpp"
#include "targets/drawing/svg_scanner.hpp"

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

}  // namespace

std::vector<SvgStroke> parse_svg_path(std::string_view text) { return PathWalk(text).run(); }

}  // namespace kinetix::targets
