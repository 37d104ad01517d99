#include <cmath>
#include <map>
#include <set>

#include "model/base/invalid_input.hpp"
#include "targets/document/number.hpp"
#include "targets/drawing/drawing.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;

/// A pair of lines of a text DXF: a group code that says what the value is.
struct Group {
  int code = 0;
  std::string_view value;
  int line = 0;  ///< of the value, from 1
};

InvalidInput wrong(const Group& group, const std::string& what) {
  return InvalidInput(what, {"", group.line, 1});
}

double number_of(const Group& group) {
  try {
    return parse_number(group.value);
  } catch (const InvalidInput& e) {
    throw wrong(group, e.reason());
  }
}

int integer_of(const Group& group) {
  constexpr int most = 1'000'000;  // flags and units are small
  try {
    return parse_integer(group.value, -most, most);
  } catch (const InvalidInput& e) {
    throw wrong(group, e.reason());
  }
}

class Groups {
 public:
  explicit Groups(std::string_view text) : text_(text) {}

  std::optional<Group> next() {
    if (rest().empty()) return std::nullopt;
    Group code{0, line(), line_};
    Group group{integer_of(code), line(), line_};
    return group;
  }

 private:
  std::string_view rest() {
    while (!text_.empty() && (text_.back() == '\n' || text_.back() == '\r' || text_.back() == ' '))
      text_.remove_suffix(1);
    return text_;
  }
  std::string_view line() {
    const std::size_t end = text_.find('\n');
    std::string_view out = text_.substr(0, end);
    text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
    ++line_;
    const std::size_t first = out.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return out.substr(first, out.find_last_not_of(" \t\r") + 1 - first);
  }

  std::string_view text_;
  int line_ = 0;
};

/// Returns the mm in a unit of $INSUNITS. 0 means that the drawing names none: mm, as laser cutters assume.
double unit_mm(const Group& unit) {
  static const std::map<int, double> known = {{0, 1}, {1, 25.4}, {2, 304.8}, {4, 1}, {5, 10}, {6, 1000}};
  const auto found = known.find(integer_of(unit));
  if (found != known.end()) return found->second;
  throw wrong(unit, "the unit $INSUNITS " + std::string(unit.value) +
                        " is not supported. Give mm, cm, m, inches or feet");
}

constexpr double missing = std::numeric_limits<double>::quiet_NaN();  // a coordinate that has not come yet

/// Takes the entities one after the other.
class Entities {
 public:
  void take(const Group& group) {
    if (group.code == 0) return begin(group);
    if (group.code == 67) is_on_paper_ = integer_of(group) != 0;
    if (name_ == "LINE") return take_line(group);
    if (name_ == "LWPOLYLINE" || name_ == "VERTEX") return take_vertex(group);
    if (name_ == "POLYLINE") take_flags(group);
  }

  Drawing drawing(double mm) {
    for (DrawnLine& line : lines_)
      for (Vector2d& end : line) end *= mm;
    return std::move(lines_);
  }

 private:
  void begin(const Group& group) {
    static const std::set<std::string_view> curved = {"ARC", "CIRCLE", "ELLIPSE", "SPLINE"};
    if (curved.contains(group.value))
      throw wrong(group, "the curve " + std::string(group.value) +
                             " is not supported. Draw walls as LINE, LWPOLYLINE or POLYLINE");
    if (group.value == "MLINE" || group.value == "3DFACE")
      throw wrong(group,
                  std::string(group.value) + " is not supported. Draw walls as LINE, LWPOLYLINE or POLYLINE");
    if (group.value == "INSERT") throw wrong(group, "there is a block here. Explode it into lines");
    end_line();
    if (group.value != "VERTEX") {
      end_polyline();
      is_on_paper_ = false;
    }
    name_ = group.value;
  }

  void take_line(const Group& group) {
    for (int k = 0; k < 4; ++k)
      if (group.code == (std::array{10, 20, 11, 21})[k]) line_[k] = number_of(group);
  }

  void take_vertex(const Group& group) {
    if (group.code == 10) points_.emplace_back(number_of(group), missing);
    if (group.code == 20 && !points_.empty()) points_.back().y() = number_of(group);
    if (group.code == 42 && number_of(group) != 0)
      throw wrong(group, "this polyline has an arc (a bulge). Draw straight walls");
    if (name_ == "LWPOLYLINE") take_flags(group);
  }

  void take_flags(const Group& group) {
    constexpr int closed = 1, smooth_or_mesh = 2 | 4 | 16 | 64;
    if (group.code == 230 && number_of(group) < 0)
      throw wrong(group, "this polyline is drawn from below (extrusion along -z). Flatten the drawing");
    if (group.code != 70) return;
    if ((integer_of(group) & smooth_or_mesh) != 0)
      throw wrong(group, "this polyline is a smooth curve or a mesh. Draw straight walls");
    is_closed_ = (integer_of(group) & closed) != 0;
  }

  void end_line() {
    if (name_ == "LINE") add({line_[0], line_[1]}, {line_[2], line_[3]});
    line_.fill(missing);
  }

  void add(const Vector2d& a, const Vector2d& b) {
    if (!a.allFinite() || !b.allFinite()) throw InvalidInput("has a line without one of its coordinates");
    if (!is_on_paper_) lines_.push_back({a, b});
  }

  void end_polyline() {
    for (std::size_t k = 1; k < points_.size(); ++k) add(points_[k - 1], points_[k]);
    if (is_closed_ && points_.size() > 2) add(points_.back(), points_.front());
    points_.clear();
    is_closed_ = false;
  }

  Drawing lines_;
  std::string_view name_;                                              ///< of the entity that is open
  std::array<double, 4> line_ = {missing, missing, missing, missing};  ///< x, y of both ends
  std::vector<Vector2d> points_;
  bool is_closed_ = false;
  bool is_on_paper_ = false;  ///< the entity that is open: frames and title blocks of a layout
};

}  // namespace

// DXF in its text form is pairs of lines, a group code and a value. Of Debian's readers one is under version 2 of the
// GPL alone, which does not go together with parts under the Apache licence; the other has had no release since 2011.
Drawing parse_dxf(const std::string& text) {
  if (text.starts_with("AutoCAD Binary DXF"))
    throw InvalidInput("this is a binary DXF. Save it as text (ASCII)");
  Groups groups(text);
  Entities entities;
  std::string_view section, variable;
  double mm = 1;
  bool is_dxf = false, names_section = false, is_whole = false;
  while (const auto group = groups.next()) {
    if (group->code == 0 &&
        (group->value == "SECTION" || group->value == "ENDSEC" || group->value == "EOF")) {
      if (section == "ENTITIES") entities.take({0, "END", group->line});
      section = {};
      names_section = group->value == "SECTION";
      is_dxf = true;
      is_whole = group->value == "EOF";
    } else if (names_section && group->code == 2) {
      section = group->value;
      names_section = false;
    } else if (section == "ENTITIES") {
      entities.take(*group);
    } else if (section == "HEADER") {
      if (group->code == 9) variable = group->value;
      if (group->code == 70 && variable == "$INSUNITS") mm = unit_mm(*group);
    }
  }
  if (!is_dxf) throw InvalidInput("is not a DXF file");
  if (!is_whole) throw InvalidInput("is cut off: a DXF file ends with EOF");
  return entities.drawing(mm);
}

}  // namespace kinetix::targets
