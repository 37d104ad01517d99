#include "app/print/format/sheet_drawing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <boost/polygon/polygon.hpp>
#include <cmath>

namespace kinetix::app {
namespace {

constexpr double number_share = 0.12;  // of the cell edge: height of a hinge's number

namespace bp = boost::polygon;
using Eigen::Vector2d;
using Ring = std::vector<Vector2d>;
using Points = std::vector<bp::point_data<int>>;

constexpr double grid_mm = 1e-5;  // mm: unions are exact on this grid, up to sheets of 20 m

bp::point_data<int> on_grid(const Eigen::Vector3d& p) {
  return {static_cast<int>(std::lround(p.x() / grid_mm)), static_cast<int>(std::lround(p.y() / grid_mm))};
}

/// Counter-clockwise (Andrew's monotone chain), exact.
Points shadow(const std::vector<Eigen::Vector3d>& corners, const Eigen::Vector3d& at) {
  Points points, out;
  for (const Eigen::Vector3d& p : corners) points.push_back(on_grid(p + at));
  std::sort(points.begin(), points.end());
  const auto left = [](const auto& a, const auto& b, const auto& c) {
    const auto wide = [](int x) { return static_cast<long long>(x); };
    return (wide(b.x()) - a.x()) * (wide(c.y()) - a.y()) - (wide(b.y()) - a.y()) * (wide(c.x()) - a.x());
  };
  const auto add = [&](const auto& p, std::size_t first) {
    while (out.size() >= first + 2 && left(out[out.size() - 2], out.back(), p) <= 0) out.pop_back();
    out.push_back(p);
  };
  for (const auto& p : points) add(p, 0);
  const std::size_t lower = out.size() - 1;
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) add(*p, lower);
  out.pop_back();
  return out;
}

template <class Polygon>
Ring ring_of(const Polygon& polygon) {
  Ring ring;
  for (const auto& p : polygon) ring.push_back(grid_mm * Vector2d(p.x(), p.y()));
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

std::vector<Ring> united(const std::vector<Points>& shadows) {
  using namespace bp::operators;
  bp::polygon_set_data<int> set;
  for (const Points& shadow : shadows) {
    bp::polygon_data<int> polygon;
    bp::set_points(polygon, shadow.begin(), shadow.end());
    set += polygon;
  }
  std::vector<bp::polygon_with_holes_data<int>> polygons;
  set.get(polygons);
  std::vector<Ring> rings;
  for (const auto& polygon : polygons) {
    rings.push_back(ring_of(polygon));
    for (auto hole = polygon.begin_holes(); hole != polygon.end_holes(); ++hole)
      rings.push_back(ring_of(*hole));
  }
  return rings;
}

void find_bounds(SheetDrawing& drawing) {
  Eigen::AlignedBox2d box;
  for (const auto* parts : {&drawing.bodies, &drawing.soft})
    for (const SheetDrawing::Part& part : *parts)
      for (const Ring& ring : part.rings)
        for (const Vector2d& p : ring) box.extend(p);
  drawing.low = box.min();
  drawing.high = box.max();
}

}  // namespace

double number_height_mm(const PrintSheet& sheet) { return number_share * sheet.linkage.size.edge_mm; }

SheetDrawing sheet_drawing(const PrintSheet& sheet) {
  SheetDrawing drawing;
  for (int b = 0; b < static_cast<int>(sheet.bodies.size()); ++b) {
    if (sheet.meshes[b].points.empty()) continue;
    std::vector<Points> shadows;
    for (const model::ConvexPiece& piece : convex_pieces(sheet.bodies[b]))
      shadows.push_back(shadow(piece.corners, sheet.linkage.rest_position(b)));
    drawing.bodies.push_back({"body " + sheet.linkage.vertex_name(b), united(shadows)});
  }
  for (int h = 0; h < static_cast<int>(sheet.hinges.size()); ++h) {
    const model::RestHinge& hinge = sheet.linkage.hinges[h];
    const Eigen::Vector3d lower = sheet.linkage.rest_position(hinge.lower),
                          place = lower + sheet.linkage.size.edge_mm * hinge.lower_arm;
    if (!sheet.soft[h].points.empty())
      drawing.soft.push_back(
          {"hinge " + sheet.linkage.wall_name(h), united({shadow(sheet.soft[h].points, lower)})});
    const bool pin = sheet.hinges[h].made.kind == model::HingeKind::pin;
    drawing.hinges.push_back({h + 1, place.head<2>(), pin ? sheet.hinges[h].made.diameter_mm / 2 : 0});
  }
  find_bounds(drawing);
  return drawing;
}

}  // namespace kinetix::app
