#include "targets/drawing/drawing.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "targets/document/text_file.hpp"
#include "targets/document/wording.hpp"
#include "targets/drawing/join_lines.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;

constexpr double max_drawn_mm = 1e6;  // mm: a kilometre is larger than any sheet
// Sizes of drawings, mm: others need `structure.unit`, because their unit is probably wrong.
constexpr double usual_least_mm = 2, usual_most_mm = 20'000;

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

/// Numbers vertices and walls in reading order.
model::PlanarGraph in_reading_order(const JoinedLines& joined) {
  std::vector<Vector2d> points = joined.graph.vertices;
  straighten_sides(points, joined.join);
  model::PlanarGraph graph;
  std::vector<int> rank(points.size());
  for (const int v : reading_order(points, joined.join)) {
    rank[v] = static_cast<int>(graph.vertices.size());
    graph.vertices.push_back(points[v]);
  }
  for (const auto& [from, to] : joined.graph.edges)
    graph.edges.push_back({std::min(rank[from], rank[to]), std::max(rank[from], rank[to])});
  std::sort(graph.edges.begin(), graph.edges.end(), [](const model::GraphEdge& a, const model::GraphEdge& b) {
    return std::pair(a.from, a.to) < std::pair(b.from, b.to);
  });
  return graph;
}

Vector2d size_of(const std::vector<DrawnLine>& lines) {
  Eigen::AlignedBox2d box;
  for (const DrawnLine& line : lines) box.extend(line.from).extend(line.to);
  return box.isEmpty() ? Vector2d(0, 0) : Vector2d(box.sizes());
}

std::string size_words(const Vector2d& size) { return fmt::format("{:.4g} x {:.4g} mm", size.x(), size.y()); }

std::string place_words(const Vector2d& p) { return fmt::format("({:.6g}, {:.6g}) mm", p.x(), p.y()); }

/// Returns the least joining distance, in two digits, that leaves no near misses; empty if none is found.
std::optional<double> sufficient_join(const std::vector<DrawnLine>& lines,
                                      const std::vector<NearMiss>& misses) {
  double widest = 0;
  for (const NearMiss& miss : misses) widest = std::max(widest, miss.gap());
  for (double join = 1.1 * widest; join < 5 * widest; join *= 1.5) {
    const double digit = std::pow(10, std::floor(std::log10(join)) - 1);
    const double rounded = std::ceil(join / digit) * digit;
    JoinedLines joined = join_lines(lines, rounded);
    joined.join = std::min(rounded, widest);  // looks as far as before
    const std::vector<NearMiss> left = find_near_misses(joined);
    if (std::none_of(left.begin(), left.end(), [&](const NearMiss& m) { return m.gap() <= widest; }))
      return rounded;
  }
  return std::nullopt;
}

/// Examines a drawing step by step, until the first fault.
class DrawingExaminer {
 public:
  DrawingExaminer(const Node& path, std::string file, const DrawingSettings& settings)
      : path_(path), file_(std::move(file)), settings_(settings) {}

  DrawnWalls run(Drawing drawing) {
    out_.file = file_;
    out_.lines = std::move(drawing.lines);
    if (out_.lines.empty())
      return refuse(InvalidInput("the drawing has no lines. Draw each wall as one line", {file_}));
    if (!apply_unit(drawing) || settings_.are_cuts) return std::move(out_);
    for (const DrawnLine& line : out_.lines)
      if (line.curve >= 0) return refuse_curve(drawing, line);
    return join();
  }

 private:
  DrawnWalls refuse(const InvalidInput& fault) {
    out_.fault = fault;
    return std::move(out_);
  }

  DrawnWalls refuse_curve(const Drawing& drawing, const DrawnLine& line) {
    for (const DrawnLine& other : out_.lines)
      if (other.curve == line.curve) out_.marks.push_back(other.from);
    return refuse(
        InvalidInput(fmt::format("the curve near {} ({}) is not a wall. Draw straight walls, or delete it",
                                 place_words(line.from), drawing.curves[line.curve]),
                     {file_, line.line, 1}));
  }

  /// Scales the lines to mm. @return whether their size is plausible
  bool apply_unit(const Drawing& drawing) {
    const Vector2d size = size_of(out_.lines);
    const double mm = settings_.unit_mm.value_or(drawing.unit_mm) * settings_.scale;
    for (DrawnLine& line : out_.lines) {
      line.from *= mm;
      line.to *= mm;
      if (!(line.from.cwiseAbs().maxCoeff() <= max_drawn_mm) ||
          !(line.to.cwiseAbs().maxCoeff() <= max_drawn_mm)) {
        out_.fault = InvalidInput("a line ends more than a kilometre from 0. Check the unit of the drawing",
                                  {file_, line.line, 1});
        return false;
      }
    }
    out_.unit = settings_.unit_mm ? "structure.unit" : drawing.unit_source;
    const double largest = mm * size.maxCoeff();
    if (!settings_.unit_mm && !(largest >= usual_least_mm && largest <= usual_most_mm)) {
      out_.fault =
          path_.error(fmt::format("the drawing would measure {} ({}), which is unusual. Set structure.unit",
                                  size_words(mm * size), drawing.unit_source));
      return false;
    }
    out_.unit = fmt::format("1 unit = {:.4g} mm ({}{})", mm, out_.unit,
                            settings_.scale == 1 ? "" : ", structure.scale");
    return true;
  }

  DrawnWalls join() {
    try {
      const JoinedLines joined = join_lines(out_.lines, settings_.join_mm);
      out_.graph = in_reading_order(joined);
      const std::vector<NearMiss> misses = find_near_misses(joined);
      if (!misses.empty() && !settings_.join_mm) return refuse_near_misses(misses, joined);
      return std::move(out_);
    } catch (const InvalidInput& e) {
      return refuse(InvalidInput(e.reason(), {file_}));
    }
  }

  DrawnWalls refuse_near_misses(const std::vector<NearMiss>& misses, const JoinedLines& joined) {
    for (const NearMiss& miss : misses) out_.marks.push_back(miss.place);
    const auto& [place, other] = misses.front();
    const std::optional<double> enough = sufficient_join(out_.lines, misses);
    const std::string advice = enough ? fmt::format("Set structure.join_mm: {:.2g} to join them", *enough)
                                      : "Correct the drawing there, or set structure.join_mm";
    return refuse(InvalidInput(
        fmt::format("walls at {} and {} are {:.2g} mm apart, and ends are joined up to {:.2g} mm. {}",
                    place_words(place), place_words(other), misses.front().gap(), joined.join, advice),
        {file_, line_at(place), 1}));
  }

  /// Returns the line in the file of the drawn line that ends nearest to a place.
  int line_at(const Vector2d& place) const {
    const auto distance = [&](const DrawnLine& line) {
      return std::min((line.from - place).squaredNorm(), (line.to - place).squaredNorm());
    };
    return std::min_element(out_.lines.begin(), out_.lines.end(),
                            [&](const DrawnLine& a, const DrawnLine& b) { return distance(a) < distance(b); })
        ->line;
  }

  const Node& path_;
  std::string file_;
  const DrawingSettings& settings_;
  DrawnWalls out_;
};

}  // namespace

DrawnWalls examine_drawing(const Node& path, const DrawingSettings& settings) {
  const std::string wanted = "path of a DXF or SVG file";
  const std::filesystem::path file = std::filesystem::path(path.folder()) / path.text(wanted);
  const std::string ending = lower_case(file.extension().string());
  if (ending != ".dxf" && ending != ".svg")
    throw path.error("this is not a drawing. Give a file that ends in .dxf or .svg");
  const HiddenQuotes hidden(file.string(), path.folder());
  try {
    const std::string text = read_bytes(file.string(), max_drawing_bytes);
    return DrawingExaminer(path, file.string(), settings)
        .run(ending == ".dxf" ? parse_dxf(text) : parse_svg(text));
  } catch (const InvalidInput& e) {
    if (!e.place().file.empty()) throw;
    throw InvalidInput(e.reason(), {file.string(), e.place().line, e.place().column});
  }
}

DrawnWalls read_drawing(const Node& path, const DrawingSettings& settings) {
  DrawnWalls walls = examine_drawing(path, settings);
  if (walls.fault) throw InvalidInput(*walls.fault);
  return walls;
}

}  // namespace kinetix::targets
