#include <boost/geometry/algorithms/append.hpp>
#include <boost/geometry/algorithms/area.hpp>
#include <boost/geometry/algorithms/correct.hpp>
#include <boost/geometry/algorithms/intersection.hpp>
#include <boost/geometry/algorithms/is_valid.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/geometry/geometries/ring.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <cmath>
#include <limits>

#include "targets/outline/outline.hpp"

namespace kinetix::targets {
namespace {

namespace geometry = boost::geometry;
using Point = geometry::model::d2::point_xy<double>;
using Ring = geometry::model::ring<Point>;
using Polygon = geometry::model::polygon<Point>;

Ring ring_of(const std::vector<Eigen::Vector2d>& corners) {
  Ring out;
  for (const Eigen::Vector2d& p : corners) geometry::append(out, Point(p.x(), p.y()));
  geometry::correct(out);
  return out;
}

double shared_part(const std::vector<Eigen::Vector2d>& a, const std::vector<Eigen::Vector2d>& b) {
  const Ring first = ring_of(a), second = ring_of(b);
  if (!geometry::is_valid(first) || !geometry::is_valid(second))
    return std::numeric_limits<double>::quiet_NaN();
  std::vector<Polygon> both;
  geometry::intersection(first, second, both);
  double shared = 0;
  for (const Polygon& piece : both) shared += geometry::area(piece);
  return shared / (geometry::area(first) + geometry::area(second) - shared);
}

}  // namespace

OutlineError outline_error(const Outline& goal, const std::vector<Eigen::Vector2d>& corners) {
  OutlineError error;
  bool finite = true;
  for (const Eigen::Vector2d& corner : corners) {
    const double distance = corner.allFinite() ? goal.nearest(corner).distance : std::nan("");
    finite = finite && std::isfinite(distance);
    error.rms += distance * distance;
    error.max = std::max(error.max, distance);
  }
  error.rms = std::sqrt(error.rms / static_cast<double>(corners.size())) / goal.diagonal();
  error.max = finite ? error.max / goal.diagonal() : std::nan("");
  error.iou = finite ? shared_part(goal.points(), corners) : std::nan("");
  return error;
}

}  // namespace kinetix::targets
