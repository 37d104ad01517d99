#include "targets/drawing/dxf_groups.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "model/base/geometry.hpp"
#include "targets/document/number.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;

constexpr double flatness = 1e-6;  // relative to the size of an entity
constexpr double missing_coordinate = std::numeric_limits<double>::quiet_NaN();

/// Corner of a polyline, and the bulge of the side that follows it.
struct Corner {
  Vector2d at;
  double z = 0, bulge = 0;
  int line = 0;
};

/// @throws InvalidInput if heights differ
void check_flat(const DxfEntity& entity, const std::vector<double>& heights, double size) {
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  if (!heights.empty() && !(*high - *low <= flatness * size))
    throw entity.error(std::string(entity.name) + " is not parallel to the xy plane. Flatten the drawing");
}

std::vector<DxfStroke> strokes_of_corners(const DxfEntity& entity, std::vector<Corner> corners,
                                          bool is_closed) {
  if (is_closed && corners.size() > 1) corners.push_back(corners.front());
  std::vector<DxfStroke> strokes;
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
    const Corner &from = corners[k], &to = corners[k + 1];
    if (!from.at.allFinite() || !to.at.allFinite())
      throw entity.error("a polyline has a corner without one of its coordinates. Save the drawing again");
    if (from.bulge == 0 || from.at == to.at)
      strokes.push_back({{from.at, to.at}, "", from.line});
    else
      strokes.push_back({bulge_chords(from.at, to.at, from.bulge), "arc of a polyline", from.line});
  }
  return strokes;
}

std::vector<DxfStroke> light_polyline(const DxfEntity& entity) {
  std::vector<Corner> corners;
  for (const DxfGroup& group : entity.groups) {
    if (group.code == 10) corners.push_back({{group.number(), missing_coordinate}, 0, 0, group.line});
    if (corners.empty()) continue;
    if (group.code == 20) corners.back().at.y() = group.number();
    if (group.code == 42) corners.back().bulge = group.number();
  }
  return strokes_of_corners(entity, std::move(corners), (entity.integer(70, 0) & 1) != 0);
}

std::vector<DxfStroke> polyline(const DxfEntity& entity, const std::vector<const DxfEntity*>& vertices) {
  constexpr int closed = 1, smooth = 2 | 4, mesh = 16 | 64, spline_control = 16;
  const int flags = entity.integer(70, 0);
  if ((flags & mesh) != 0) throw entity.error("this polyline is a mesh. Draw its edges as lines");
  std::vector<Corner> corners;
  std::vector<double> heights;
  double size = 0;
  for (const DxfEntity* vertex : vertices) {
    if ((vertex->integer(70, 0) & spline_control) != 0) continue;
    corners.push_back({vertex->point(10), vertex->number(30, 0), vertex->number(42, 0), vertex->line});
    heights.push_back(corners.back().z);
    size = std::max(size, (corners.back().at - corners.front().at).norm());
  }
  check_flat(entity, heights, size);
  std::vector<DxfStroke> strokes = strokes_of_corners(entity, std::move(corners), (flags & closed) != 0);
  if ((flags & smooth) != 0)
    for (DxfStroke& stroke : strokes) stroke.curve = "smooth polyline";
  return strokes;
}

std::vector<DxfStroke> straight_line(const DxfEntity& entity) {
  const Vector2d from = entity.point(10), to = entity.point(11);
  check_flat(entity, {entity.number(30, 0), entity.number(31, 0)}, (to - from).norm());
  return {{{from, to}, "", entity.line}};
}

std::vector<DxfStroke> face(const DxfEntity& entity) {
  ChordPoints points;
  std::vector<double> heights;
  for (int k = 0; k < 4; ++k)
    if (entity.find(10 + k)) {
      points.push_back(entity.point(10 + k));
      heights.push_back(entity.number(30 + k, 0));
    }
  if (points.empty()) return {};
  double size = 0;
  for (const Vector2d& p : points) size = std::max(size, (p - points[0]).norm());
  check_flat(entity, heights, size);
  points.push_back(points[0]);
  return {{points, "", entity.line}};
}

std::vector<DxfStroke> arc(const DxfEntity& entity) {
  const bool is_circle = entity.name == "CIRCLE";
  const double radius = entity.number(40, 0),
               from = is_circle ? 0 : entity.number(50, 0) * radians_per_degree;
  double to = is_circle ? 2 * pi : entity.number(51, 360) * radians_per_degree;
  if (to <= from) to += 2 * pi;
  return {{ellipse_chords(entity.point(10), {radius, 0}, {0, radius}, from, to), std::string(entity.name),
           entity.line}};
}

std::vector<DxfStroke> ellipse(const DxfEntity& entity) {
  const Vector2d major = entity.point(11);
  const double ratio = entity.number(40, 1) * (entity.number(230, 1) < 0 ? -1 : 1);
  const double from = entity.number(41, 0);
  double to = entity.number(42, 2 * pi);
  if (to <= from) to += 2 * pi;
  return {{ellipse_chords(entity.point(10), major, ratio * Vector2d(-major.y(), major.x()), from, to),
           "ELLIPSE", entity.line}};
}

/// Returns all points whose x has this code.
ChordPoints points_of_spline(const DxfEntity& entity, int code) {
  ChordPoints points;
  for (const DxfGroup& group : entity.groups) {
    if (group.code == code) points.emplace_back(group.number(), missing_coordinate);
    if (group.code == code + 10 && !points.empty()) points.back().y() = group.number();
  }
  return points;
}

std::vector<double> numbers_of_spline(const DxfEntity& entity, int code) {
  std::vector<double> numbers;
  for (const DxfGroup& group : entity.groups)
    if (group.code == code) numbers.push_back(group.number());
  return numbers;
}

std::vector<DxfStroke> spline(const DxfEntity& entity) {
  constexpr int most_degree = 10;
  const ChordPoints control = points_of_spline(entity, 10), fit = points_of_spline(entity, 11);
  if (control.empty()) return {{fit, fit.size() > 2 ? "SPLINE" : "", entity.line}};
  const std::vector<double> knots = numbers_of_spline(entity, 40), weights = numbers_of_spline(entity, 41);
  const int degree = entity.integer(71, 3);
  const bool is_complete =
      degree >= 1 && degree <= most_degree && control.size() > static_cast<std::size_t>(degree) &&
      knots.size() == control.size() + degree + 1 && std::is_sorted(knots.begin(), knots.end()) &&
      (weights.empty() || weights.size() == control.size());
  if (!is_complete)
    throw entity.error(
        "a SPLINE has knots, weights and control points that do not match. Save the drawing again");
  ChordPoints points = spline_chords(degree, knots, control, weights);
  const bool is_line = points.size() == 2;
  return {{std::move(points), is_line ? "" : "SPLINE", entity.line}};
}

/// Lines of a DXF file without the spaces around them.
class DxfLines {
 public:
  explicit DxfLines(std::string_view text) : text_(text) {
    while (!text_.empty() && (text_.back() == '\n' || text_.back() == '\r' || text_.back() == ' '))
      text_.remove_suffix(1);
  }

  bool at_end() const { return text_.empty(); }
  int number() const { return number_; }
  std::string_view next() {
    const std::size_t end = text_.find('\n');
    const std::string_view out = text_.substr(0, end);
    text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
    ++number_;
    const std::size_t first = out.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return out.substr(first, out.find_last_not_of(" \t\r") + 1 - first);
  }

 private:
  std::string_view text_;
  int number_ = 0;
};

}  // namespace

bool is_from_below(const DxfEntity& entity) {
  const double x = entity.number(210, 0), y = entity.number(220, 0), z = entity.number(230, 1);
  if (!(std::hypot(x, y) <= flatness * std::abs(z)))
    throw entity.error(std::string(entity.name) + " is in a plane that is tilted. Flatten the drawing");
  return z < 0;
}

std::vector<DxfStroke> dxf_strokes(const DxfEntity& entity, const std::vector<const DxfEntity*>& vertices) {
  static const std::set<std::string_view> refused = {"MLINE", "MESH", "3DSOLID", "REGION", "BODY", "SURFACE"};
  if (refused.contains(entity.name))
    throw entity.error(std::string(entity.name) + " is not supported. Explode it into lines");
  if (entity.name == "LINE") return straight_line(entity);
  if (entity.name == "LWPOLYLINE") return light_polyline(entity);
  if (entity.name == "POLYLINE") return polyline(entity, vertices);
  if (entity.name == "3DFACE") return face(entity);
  if (entity.name == "ARC" || entity.name == "CIRCLE") return arc(entity);
  if (entity.name == "ELLIPSE") return ellipse(entity);
  if (entity.name == "SPLINE") return spline(entity);
  return {};
}

InvalidInput DxfGroup::error(const std::string& fault_text) const {
  return InvalidInput(fault_text, {"", line, 1});
}

double DxfGroup::number() const {
  try {
    return parse_number(value);
  } catch (const InvalidInput& e) {
    throw error(e.reason());
  }
}

int DxfGroup::integer() const {
  constexpr int most = 1'000'000;  // flags, counts and units are small
  try {
    return parse_integer(value, -most, most);
  } catch (const InvalidInput& e) {
    throw error(e.reason());
  }
}

const DxfGroup* DxfEntity::find(int code) const {
  const auto found =
      std::find_if(groups.begin(), groups.end(), [&](const DxfGroup& g) { return g.code == code; });
  return found == groups.end() ? nullptr : &*found;
}

double DxfEntity::number(int code, double otherwise) const {
  const DxfGroup* group = find(code);
  return group ? group->number() : otherwise;
}

int DxfEntity::integer(int code, int otherwise) const {
  const DxfGroup* group = find(code);
  return group ? group->integer() : otherwise;
}

std::string_view DxfEntity::text(int code) const {
  const DxfGroup* group = find(code);
  return group ? group->value : std::string_view();
}

Eigen::Vector2d DxfEntity::point(int code) const {
  constexpr int to_y = 10;  // codes of y are those of x plus 10
  const DxfGroup *x = find(code), *y = find(code + to_y);
  if (!x || !y)
    throw error(std::string(name) + " has no coordinate " + (x ? "y" : "x") + ". Save the drawing again");
  return {x->number(), y->number()};
}

InvalidInput DxfEntity::error(const std::string& fault_text) const {
  return InvalidInput(fault_text, {"", line, 1});
}

// DXF in its text form is pairs of lines, a group code and a value. One of Debian's readers is under version 2 of the
// GPL alone, which is not compatible with parts under the Apache licence. The other has had no release since 2011.
std::vector<DxfEntity> parse_dxf_entities(std::string_view text) {
  if (text.starts_with("AutoCAD Binary DXF"))
    throw InvalidInput("this is a binary DXF. Save it as text (ASCII)");
  std::vector<DxfEntity> entities;
  DxfLines lines(text);
  bool is_whole = false, has_sections = false;
  while (!lines.at_end() && !is_whole) {
    const DxfGroup code{0, lines.number() + 1, lines.next()};
    const std::string_view value = lines.next();
    const DxfGroup group{code.integer(), lines.number(), value};
    if (group.code == 0) {
      entities.push_back({value, group.line, {}});
      has_sections = has_sections || value == "SECTION";
      is_whole = value == "EOF";
    } else if (!entities.empty()) {
      entities.back().groups.push_back(group);
    }
  }
  if (!has_sections && !is_whole) throw InvalidInput("this is not a DXF file. Save the drawing as DXF");
  if (!is_whole) throw InvalidInput("the file is cut off: a DXF file ends with EOF. Save the drawing again");
  return entities;
}

}  // namespace kinetix::targets
