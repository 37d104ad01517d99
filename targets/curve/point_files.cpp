#include "targets/curve/point_files.hpp"

#include <cmath>
#include <filesystem>
#include <map>
#include <pugixml.hpp>
#include <set>

#include "model/base/geometry.hpp"
#include "targets/display/image_goal.hpp"
#include "targets/display/picture.hpp"
#include "targets/document/number.hpp"
#include "targets/document/text_file.hpp"
#include "targets/document/wording.hpp"
#include "targets/drawing/drawing.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A straight piece of a drawing, mm.
using PathPiece = std::array<Vector2d, 2>;

constexpr double same_end = 1e-3;  // of the mean piece: CAD files keep three decimals or more of a mm

double mean_length(const std::vector<PathPiece>& pieces) {
  double sum = 0;
  for (const auto& [a, b] : pieces) sum += (b - a).norm();
  return sum / static_cast<double>(pieces.size());
}

/// Ends of pieces in squares of a grid. Ends that are near each other get the same number.
class NumberedEnds {
 public:
  explicit NumberedEnds(double near) : near_(near) {}

  int number(const Vector2d& p) {
    const double i = std::floor(p.x() / near_), j = std::floor(p.y() / near_);
    for (const double a : {i - 1, i, i + 1})
      for (const double b : {j - 1, j, j + 1})
        if (const auto known = at_.find({a, b}); known != at_.end())
          if ((points[known->second] - p).norm() <= near_) return known->second;
    at_.try_emplace({i, j}, static_cast<int>(points.size()));
    points.push_back(p);
    return static_cast<int>(points.size()) - 1;
  }

  std::vector<Vector2d> points;

 private:
  double near_;
  std::map<std::pair<double, double>, int> at_;
};

/// Walks along the only path of a drawing, from the start of its first piece if that is possible.
class PathWalker {
 public:
  explicit PathWalker(const std::vector<PathPiece>& pieces) : ends_(same_end * mean_length(pieces)) {
    for (const auto& [a, b] : pieces) join(ends_.number(a), ends_.number(b));
    for (std::size_t v = 0; v < next_.size(); ++v)
      if (next_[v].size() > 2)
        throw InvalidInput("more than two lines meet at " + point_text(ends_.points[v]) +
                           " of the drawing. Give a drawing of one path");
    const auto is_end = [](const auto& on) { return on.size() == 1; };
    if (!is_end(next_[0]))
      start_ = static_cast<int>(std::find_if(next_.begin(), next_.end(), is_end) - next_.begin()) %
               static_cast<int>(next_.size());
  }

  /// Returns the points of the path; a closed one ends at its first point.
  std::vector<Vector2d> walk() const {
    std::vector<Vector2d> out;
    std::vector<bool> seen(next_.size(), false);
    for (int at = start_; at >= 0;) {
      out.push_back(ends_.points[at]);
      seen[at] = true;
      const std::vector<int>& on = next_[at];
      const auto step = std::find_if(on.begin(), on.end(), [&](int v) { return !seen[v]; });
      at = step == on.end() ? -1 : *step;
    }
    if (out.size() < next_.size())
      throw InvalidInput(
          "the drawing has several separate paths. Give a drawing of one path: remove frames and holes");
    if (next_[start_].size() == 2) out.push_back(out.front());
    return out;
  }

 private:
  static std::string point_text(const Vector2d& p) {
    return "[" + number_text(p.x()) + ", " + number_text(p.y()) + "]";
  }

  /// Adds a piece, unless it has no length or is drawn twice.
  void join(int a, int b) {
    next_.resize(ends_.points.size());
    if (a == b || std::find(next_[a].begin(), next_[a].end(), b) != next_[a].end()) return;
    next_[a].push_back(b);
    next_[b].push_back(a);
  }

  NumberedEnds ends_;
  std::vector<std::vector<int>> next_;
  int start_ = 0;
};

FilePoints read_path(const std::string& file, bool is_dxf) {
  const std::string text = read_bytes(file, max_drawing_bytes);
  FilePoints out{{}, {}, {file}, {}, 1.0};
  std::vector<PathPiece> pieces;
  const Drawing drawing = is_dxf ? parse_dxf(text) : parse_svg(text);
  for (const DrawnLine& line : drawing.lines) pieces.push_back({line.from, line.to});
  out.unit_mm = drawing.unit_mm;
  if (!drawing.has_unit) out.notes.push_back("the unit of the drawing is " + drawing.unit_source);
  if (pieces.size() > max_curve_points)
    throw InvalidInput("the drawing has too many lines. Give at most " + std::to_string(max_curve_points));
  if (pieces.empty() || !(mean_length(pieces) > 0))
    throw InvalidInput("the drawing has no lines. Draw the goal as one path");
  for (const Vector2d& p : PathWalker(pieces).walk()) out.points.emplace_back(p.x(), p.y(), 0);
  return out;
}

FilePoints read_silhouette(const std::string& file) {
  FilePoints out{{}, {}, {file}};
  out.in_pixels = true;
  const Silhouette found = silhouette_of(read_image(file, ImageLevels::two, false));
  for (const Vector2d& p : found.points) out.points.emplace_back(p.x(), p.y(), 0);
  if (found.left_out > 0)
    out.notes.push_back("the outline is that of the largest part of the picture, without " +
                        counted(found.left_out, "smaller part") + " and without holes");
  return out;
}

constexpr double earth_radius_m = 6'371'008.8;  // m, mean radius of the ellipsoid WGS 84
constexpr int deepest_gpx = 20;                 // elements in each other: tracks have five

/// Points of a GPX file, in metres from the first one: x to the east, y to the north, z upwards.
class GpxReader {
 public:
  GpxReader(const std::string& file, const std::string& text, const PointForm& form)
      : file_(file), text_(text), form_(form) {}

  FilePoints read() {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(text_.data(), text_.size());
    if (!parsed) throw InvalidInput(std::string("is not a GPX file: ") + parsed.description());
    for (const char* name : {"trkpt", "rtept", "wpt"})
      if (out_.points.empty()) collect(document, name, 0);
    if (out_.points.empty()) throw InvalidInput("the file has no points of a track or route");
    out_.place = {file_};
    out_.unit_mm = 1000;
    return std::move(out_);
  }

 private:
  void collect(const pugi::xml_node& node, const char* name, int depth) {
    if (depth > deepest_gpx) throw InvalidInput("has elements more than 20 levels deep. Export it again");
    for (const pugi::xml_node& child : node.children()) {
      if (std::string_view(child.name()) == name)
        add(child);
      else
        collect(child, name, depth + 1);
    }
  }

  void add(const pugi::xml_node& node) {
    for (; counted_ < node.offset_debug(); ++counted_)
      if (text_[static_cast<std::size_t>(counted_)] == '\n') ++line_;
    const Place place{file_, line_, 1};
    try {
      const double latitude = parse_number(node.attribute("lat").value(), from_to(-90, 90, "degrees")),
                   longitude = parse_number(node.attribute("lon").value(), from_to(-180, 180, "degrees"));
      const pugi::xml_node height = node.child("ele");
      const double z = height ? parse_number(height.text().as_string(), from_to(-1e5, 1e5, "m")) : 0;
      add(latitude * radians_per_degree, longitude * radians_per_degree, z, place);
    } catch (const InvalidInput& e) {
      if (e.place().line > 0) throw;
      throw InvalidInput(e.reason(), place);
    }
  }

  void add(double latitude, double longitude, double height, const Place& place) {
    if (out_.points.empty()) first_ = {longitude, latitude, height};
    if (out_.points.size() == form_.most)
      throw InvalidInput("there are too many points. Give at most " + std::to_string(form_.most), place);
    const double east = std::remainder(longitude - first_.x(), 2 * pi) * std::cos(first_.y());
    out_.points.emplace_back(earth_radius_m * east, earth_radius_m * (latitude - first_.y()),
                             form_.axes.size() == 3 ? height - first_.z() : 0);
    out_.places.push_back(place);
  }

  const std::string& file_;
  const std::string& text_;
  const PointForm& form_;
  Vector3d first_ = Vector3d::Zero();  ///< longitude and latitude, rad, and height, m
  std::ptrdiff_t counted_ = 0;         ///< bytes whose line ends are counted
  int line_ = 1;
  FilePoints out_;
};

FilePoints read_flat_file(const std::string& file, const std::string& ending, const PointForm& form) {
  if (form.axes.size() == 3)
    throw InvalidInput("a drawing or picture has no points in space. Give a table with the header `x,y,z`");
  if (ending == ".svg" || ending == ".dxf") return read_path(file, ending == ".dxf");
  if (!form.is_closed)
    throw InvalidInput(
        "a picture gives a closed outline, and this goal is an open line. Give a drawing or a table");
  return read_silhouette(file);
}

}  // namespace

FilePoints read_point_file(const std::string& file, const PointForm& form) {
  const std::string ending = lower_case(std::filesystem::path(file).extension().string());
  static const std::set<std::string> flat = {".svg", ".dxf", ".png", ".jpg", ".jpeg", ".pbm", ".pgm"};
  if (ending != ".gpx" && !flat.contains(ending)) return read_point_table(file, form);
  try {
    FilePoints out = ending == ".gpx" ? GpxReader(file, read_bytes(file, max_csv_bytes), form).read()
                                      : read_flat_file(file, ending, form);
    if (out.places.empty()) out.places.assign(out.points.size(), out.place);
    return out;
  } catch (const InvalidInput& e) {
    if (!e.place().file.empty()) throw;
    throw InvalidInput(e.reason(), {file, e.place().line, e.place().column});
  }
}

}  // namespace kinetix::targets
