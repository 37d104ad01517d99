#include "targets/drawing/drawing.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>
#include <set>

#include "targets/document/text_file.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;

constexpr double max_drawn_mm = 1e6;   // mm: a kilometre is larger than any sheet
constexpr double min_drawn_mm = 1e-3;  // mm, of the mean line: a micrometre is finer than any printer
constexpr double same_place = 1e-3;    // of the mean line: CAD files keep three decimals or more of a mm

double mean_length(const Drawing& drawing) {
  double sum = 0;
  for (const auto& [a, b] : drawing) sum += (b - a).norm();
  return sum / static_cast<double>(drawing.size());
}

/// Numbering of places. Places that are near each other get the same number.
class Places {
 public:
  explicit Places(double near) : near_(near) {}

  int number(const Vector2d& p) {
    const auto [i, j] = square(p);
    for (const double a : {i - 1, i, i + 1})
      for (const double b : {j - 1, j, j + 1})
        for (const int known : at_[{a, b}])
          if ((points_[known] - p).norm() <= near_) return known;
    at_[{i, j}].push_back(static_cast<int>(points_.size()));
    points_.push_back(p);
    return static_cast<int>(points_.size()) - 1;
  }

  const std::vector<Vector2d>& points() const { return points_; }

 private:
  std::pair<double, double> square(const Vector2d& p) const {
    return {std::floor(p.x() / near_), std::floor(p.y() / near_)};
  }

  double near_;
  std::vector<Vector2d> points_;
  std::map<std::pair<double, double>, std::vector<int>> at_;
};

/// Moves points within `near` of the outermost line of a side onto that line, since plates press on the points of one.
void straighten_sides(std::vector<Vector2d>& points, double near) {
  for (int along = 0; along < 2; ++along)
    for (const double sign : {-1.0, 1.0}) {
      const auto out = [&](const Vector2d& a, const Vector2d& b) {
        return sign * a[along] < sign * b[along];
      };
      const double line = (*std::max_element(points.begin(), points.end(), out))[along];
      for (Vector2d& p : points)
        if (std::abs(p[along] - line) <= near) p[along] = line;
    }
}

/// Returns the order of the points from below, and from the left at equal heights.
std::vector<int> reading_order(const std::vector<Vector2d>& points, double near) {
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int v) { return std::pair(std::round(points[v].y() / near / 2), points[v].x()); };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  return order;
}

/// @throws InvalidInput
void check(const Drawing& drawing) {
  if (drawing.size() > max_drawn_lines) throw InvalidInput("has more than a million lines");
  for (const DrawnLine& line : drawing)
    for (const Vector2d& end : line)
      if (!(end.cwiseAbs().maxCoeff() <= max_drawn_mm))
        throw InvalidInput("a line ends more than a kilometre from 0. Check the unit of the drawing");
  if (drawing.empty() || !(mean_length(drawing) > 0))
    throw InvalidInput("the drawing has no straight lines. Draw each wall as one line");
  if (!(mean_length(drawing) >= min_drawn_mm))
    throw InvalidInput("lines are shorter than a micrometre on average. Check the unit of the drawing");
}

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

model::PlanarGraph walls_of(const Drawing& drawing) {
  const double near = same_place * mean_length(drawing);
  Places places(near);
  std::vector<std::pair<int, int>> lines;
  for (const auto& [a, b] : drawing) {
    const int from = places.number(a), to = places.number(b);
    lines.emplace_back(from, to);
  }
  std::vector<Vector2d> points = places.points();
  straighten_sides(points, near);
  model::PlanarGraph graph;
  std::vector<int> rank(points.size());
  for (const int v : reading_order(points, near)) {
    rank[v] = static_cast<int>(graph.vertices.size());
    graph.vertices.push_back(points[v]);
  }
  std::set<std::pair<int, int>> walls;
  for (const auto& [a, b] : lines)
    if (a != b) walls.insert(std::minmax(rank[a], rank[b]));
  for (const auto& [a, b] : walls) graph.edges.push_back({a, b});
  return graph;
}

model::PlanarGraph read_drawing(const Node& path) {
  const std::string wanted = "path of a DXF or SVG file";
  const std::filesystem::path file = std::filesystem::path(path.folder()) / path.text(wanted);
  const std::string ending = lower_case(file.extension().string());
  if (ending != ".dxf" && ending != ".svg")
    throw path.error("this is not a drawing. Give a file that ends in .dxf or .svg");
  const HiddenQuotes hidden(file.string(), path.folder());
  try {
    const std::string text = read_bytes(file.string(), max_drawing_bytes);
    const Drawing drawing = ending == ".dxf" ? parse_dxf(text) : parse_svg(text);
    check(drawing);
    return walls_of(drawing);
  } catch (const InvalidInput& e) {
    if (!e.place().file.empty()) throw;
    throw InvalidInput(e.reason(), {file.string(), e.place().line, e.place().column});
  }
}

}  // namespace kinetix::targets
