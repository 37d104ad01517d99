#include "app/pictures/panel_picture.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "model/base/algorithms.hpp"

namespace kinetix::app {
namespace {

using Eigen::Vector2d;

constexpr double picture_side = 800;  // px of the longer side
constexpr double picture_edge = 20;   // px around the drawing

/// Writes SVG elements in px, y downwards.
class DrawingPen {
 public:
  explicit DrawingPen(const std::vector<targets::DrawnLine>& lines) {
    for (const targets::DrawnLine& line : lines) box_.extend(line.from).extend(line.to);
    if (box_.isEmpty()) box_.extend(Vector2d(0, 0));
    const double side = box_.sizes().maxCoeff();
    if (side > 0 && std::isfinite(side)) scale_ = picture_side / side;
  }

  void line(const Vector2d& from, const Vector2d& to, const char* colour, double width) {
    const Vector2d a = at(from), b = at(to);
    out_ += fmt::format(
        "<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"{}\" stroke-width=\"{}\"/>\n",
        a.x(), a.y(), b.x(), b.y(), colour, width);
  }

  void circle(const Vector2d& middle, double radius, const char* paint) {
    const Vector2d p = at(middle);
    out_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{}\" {}/>\n", p.x(), p.y(), radius, paint);
  }

  void polygon(const model::PlanarGraph& graph, const std::vector<int>& corners, const char* paint) {
    std::string points;
    for (const int v : corners) {
      const Vector2d p = at(graph.vertices[v]);
      points += fmt::format("{:.2f},{:.2f} ", p.x(), p.y());
    }
    out_ += fmt::format("<polygon points=\"{}\" {}/>\n", points, paint);
  }

  void shape(const std::vector<model::FlatRing>& rings, const char* colour) {
    std::string path;
    for (const model::FlatRing& ring : rings) {
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Vector2d p = at(ring[k]);
        path += fmt::format("{}{:.2f} {:.2f}", k == 0 ? "M" : "L", p.x(), p.y());
      }
      path += "Z";
    }
    out_ += fmt::format("<path d=\"{}\" fill=\"{}\" fill-rule=\"evenodd\"/>\n", path, colour);
  }

  std::string text() const {
    const Vector2d size = scale_ * box_.sizes() + Vector2d::Constant(2 * picture_edge);
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 "
        "{0:.2f} "
        "{1:.2f}\" stroke-linecap=\"round\">\n<rect width=\"100%\" height=\"100%\" "
        "fill=\"white\"/>\n{2}</svg>\n",
        size.x(), size.y(), out_);
  }

 private:
  Vector2d at(const Vector2d& p) const {
    return Vector2d(scale_ * (p.x() - box_.min().x()), scale_ * (box_.max().y() - p.y())).array() +
           picture_edge;
  }

  Eigen::AlignedBox2d box_;
  double scale_ = 1;
  std::string out_;
};

/// Returns for each vertex whether it is connected to the largest number of others.
std::vector<bool> in_largest_piece(const model::PlanarGraph& graph) {
  const std::size_t count = graph.vertices.size();
  UnionFind pieces(count);
  for (const model::GraphEdge& edge : graph.edges) pieces.unite(edge.from, edge.to);
  std::vector<int> sizes(count, 0);
  for (std::size_t v = 0; v < count; ++v) ++sizes[pieces.find(static_cast<int>(v))];
  const auto largest = std::max_element(sizes.begin(), sizes.end()) - sizes.begin();
  std::vector<bool> is_in(count);
  for (std::size_t v = 0; v < count; ++v) is_in[v] = pieces.find(static_cast<int>(v)) == largest;
  return is_in;
}

constexpr const char* fault_colour = "#d00000";

}  // namespace

std::string drawing_picture(const targets::DrawnWalls& walls) {
  DrawingPen pen(walls.lines);
  const model::PlanarGraph& graph = walls.graph;
  if (graph.edges.empty())
    for (const targets::DrawnLine& line : walls.lines) pen.line(line.from, line.to, "#808080", 1.5);
  for (const model::GraphFace& face : bounded_faces(graph))
    if (face.vertices.size() % 2 != 0) pen.polygon(graph, face.vertices, "fill=\"#ffc0c0\"");
  const std::vector<bool> is_joined = in_largest_piece(graph);
  for (const auto& [from, to] : graph.edges)
    pen.line(graph.vertices[from], graph.vertices[to], is_joined[from] ? "black" : fault_colour, 2);
  for (const Vector2d& vertex : graph.vertices) pen.circle(vertex, 2.5, "fill=\"#0060c0\"");
  for (const Vector2d& mark : walls.marks)
    pen.circle(mark, 9, "fill=\"none\" stroke=\"#d00000\" stroke-width=\"2.5\"");
  return pen.text();
}

std::string cut_picture(const targets::CutSheet& sheet) {
  constexpr const char* shades[] = {"#e4e4e0", "#d0d0cb", "#bcbcb6", "#dadad5", "#c6c6c0"};
  DrawingPen pen(sheet.lines);
  for (std::size_t k = 0; k < sheet.pieces.size(); ++k)
    pen.shape(sheet.pieces[k], shades[k % std::size(shades)]);
  const bool has_green = targets::has_green_cuts(sheet.lines);
  for (const targets::DrawnLine& line : sheet.lines)
    if (!is_crease(line, has_green)) pen.line(line.from, line.to, "black", 1.5);
  for (const targets::SheetJoint& joint : sheet.joints)
    pen.line(joint.from, joint.to, joint.is_crease ? "#0060c0" : fault_colour, joint.is_crease ? 1.5 : 3);
  return pen.text();
}

}  // namespace kinetix::app
