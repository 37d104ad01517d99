#include "targets/outline/outline.hpp"

#include <Eigen/Geometry>
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
#include <complex>

#include "model/base/geometry.hpp"
#include "targets/curve/polyline.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;

double cross_product(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

Outline::Outline(std::vector<Vector2d> points) : points_(std::move(points)) {
  if (points_.size() > 1 && points_.front() == points_.back()) points_.pop_back();
  check_points(points_);
  std::vector<Vector2d> loop = points_;
  loop.push_back(points_.front());
  check_crossing(loop);
  double twice = 0;
  for (std::size_t k = 0; k + 1 < loop.size(); ++k)
    twice += cross_product(loop[k] - loop[0], loop[k + 1] - loop[0]);
  if (twice < 0) {
    std::reverse(points_.begin(), points_.end());
    loop = points_;
    loop.push_back(points_.front());
  }
  area_ = std::abs(twice) / 2;
  arc_.push_back(0);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Vector2d &a = loop[k], &b = loop[k + 1];
    arc_.push_back(arc_.back() + (b - a).norm());
    middle_ += cross_product(a - loop[0], b - loop[0]) * ((a - loop[0]) + (b - loop[0]));
  }
  middle_ = loop[0] + middle_ / (6 * area_);
  diagonal_ = smallest_diagonal(*this);
}

Vector2d Outline::at(double s) const {
  s -= perimeter() * std::floor(s / perimeter());
  const auto it = std::upper_bound(arc_.begin() + 1, arc_.end() - 1, s);
  const auto k = static_cast<std::size_t>(it - arc_.begin()) - 1;
  const Vector2d &a = points_[k], &b = points_[(k + 1) % points_.size()];
  return a + (s - arc_[k]) / (arc_[k + 1] - arc_[k]) * (b - a);
}

Outline::Nearest Outline::nearest(const Vector2d& p) const {
  double best = std::numeric_limits<double>::infinity(), part = 0;
  std::size_t side = 0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Vector2d &a = points_[k], along = points_[(k + 1) % points_.size()] - a;
    const double at = fraction_along(a, along, p);
    const double square = (p - a - at * along).squaredNorm();
    if (!(square < best)) continue;
    best = square;
    part = at;
    side = k;
  }
  const Vector2d &a = points_[side], along = points_[(side + 1) % points_.size()] - a;
  Nearest out;
  out.point = a + part * along;
  out.arc = arc_[side] + part * (arc_[side + 1] - arc_[side]);
  out.distance = std::sqrt(best);
  out.normal = Vector2d(along.y(), -along.x()).normalized();
  const bool is_corner = (part == 0 || part == 1) && out.distance > 0;
  if (is_corner) out.normal = (contains(p) ? -1 : 1) * (p - out.point) / out.distance;
  return out;
}

bool Outline::contains(const Vector2d& p) const {
  bool inside = false;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Vector2d &a = points_[k], &b = points_[(k + 1) % points_.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

std::vector<Vector2d> Outline::corners(double turn) const {
  std::vector<Vector2d> out;
  const std::size_t count = points_.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Vector2d in = points_[k] - points_[(k + count - 1) % count],
                   on = points_[(k + 1) % count] - points_[k];
    if (std::abs(std::atan2(cross_product(in, on), in.dot(on))) > turn) out.push_back(points_[k]);
  }
  return out;
}

namespace {

using Complex = std::complex<double>;

constexpr int max_folds =
    6;  // largest order of a rotational symmetry that still has a direction: a hexagon's sides.
// Least moment, as a fraction of the moment of |z|^n. Below it, turning leaves an outline as good as unchanged, as it
// does a disc of 24 points.
constexpr double vanishing = 1e-3;
constexpr double same_reach = 1e-9;  // fraction of the moment of |z|^3: rounding
constexpr double aside =
    0.3;  // rad: first points that lie between two directions of a shape seldom lie so far off

/// Moments of the area within an outline about its middle, mm^(n + 2).
struct AreaMoments {
  std::array<Complex, max_folds + 1> of_power = {};  ///< integral z^n dA
  std::array<double, max_folds + 1> of_size = {};    ///< integral |z|^n dA
  Complex lopsided = 0;                              ///< integral |z|^2 z dA
};

/// Integrates over triangles from the middle to each side: z = r s, s on the side, dA = |middle, a, b| r dr du.
AreaMoments moments_of(const Outline& outline) {
  // The rule is Gauss-Legendre with four points per side, exact to degree 7.
  const double inner = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(1.2)),
               outer = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(1.2));
  const double heavy = (18 + std::sqrt(30.0)) / 72, light = (18 - std::sqrt(30.0)) / 72;
  const std::pair<double, double> points[] = {
      {(1 - outer) / 2, light}, {(1 - inner) / 2, heavy}, {(1 + inner) / 2, heavy}, {(1 + outer) / 2, light}};
  AreaMoments out;
  const auto& corners = outline.points();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector2d a = corners[k] - outline.middle(),
                   b = corners[(k + 1) % corners.size()] - outline.middle();
    const double twice = a.x() * b.y() - a.y() * b.x();
    for (const auto& [u, weight] : points) {
      const Vector2d p = a + u * (b - a);
      const Complex z(p.x(), p.y());
      for (int n = 2; n <= max_folds; ++n) {
        out.of_power[n] += weight * twice / (n + 2) * std::pow(z, n);
        out.of_size[n] += weight * twice / (n + 2) * std::pow(std::abs(z), n);
      }
      out.lopsided += weight * twice / 5 * std::norm(z) * z;
    }
  }
  return out;
}

}  // namespace

std::optional<double> direction_of(const Outline& outline) {
  const AreaMoments moments = moments_of(outline);
  const Vector2d first = outline.points().front() - outline.middle();
  const Complex from_middle(first.x(), first.y());
  for (int n = 2; n <= max_folds; ++n) {
    if (!(std::abs(moments.of_power[n]) > vanishing * std::abs(moments.of_size[n]))) continue;
    double best = 0, most = -INFINITY, nearest = -INFINITY;
    for (int k = 0; k < n; ++k) {
      const double angle = (std::arg(moments.of_power[n]) + 2 * pi * k) / n;
      const double far = (moments.lopsided * std::polar(1.0, -angle)).real();
      const double near = (from_middle * std::polar(1.0, aside - angle)).real();
      const double same = same_reach * moments.of_size[3];
      if (far < most - same || (far <= most + same && near <= nearest)) continue;
      best = angle, most = far, nearest = near;
    }
    return std::remainder(best, 2 * pi);
  }
  return std::nullopt;
}

double smallest_diagonal(const Outline& outline) {
  const auto diagonal = [&](double angle) {
    const Eigen::Rotation2Dd turn(angle);
    Eigen::AlignedBox2d box;
    for (const Vector2d& p : outline.points()) box.extend(turn * p);
    return box.sizes().norm();
  };
  const std::optional<double> direction = direction_of(outline);
  if (!direction) return diagonal(0);
  // A quarter of a turn more gives the same boxes.
  return std::min(diagonal(-*direction), diagonal(pi / 4 - *direction));
}

Outline turned(const Outline& outline, double angle) {
  if (angle == 0) return outline;
  const Eigen::Rotation2Dd turn(angle);
  std::vector<Vector2d> points;
  for (const Vector2d& p : outline.points()) points.push_back(turn * p);
  return Outline(std::move(points));
}

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

namespace {

const std::string second_axis = "y";

}  // namespace

const KeyTable& outline_target_keys() {
  static const KeyTable keys({
      goal_kind_key("outline"),
      {"points", points_type(second_axis, true), needed,
       "outline of the pressed panel, in mm: closed, not crossing itself. A table has one point per row, and "
       "may start "
       "with the header `x,y`. A drawing has one path, and a picture a dark shape. The last point may repeat "
       "the "
       "first"},
      point_keys()[0],
      point_keys()[1],
      {"flat", points_type(second_axis, true), otherwise("the panel's own"),
       "outline of the flat panel, in mm, in the same form. Lengths of walls follow from it"},
  });
  return keys;
}

Outline read_outline(const Section& target, std::string_view key, bool checks_size,
                     std::vector<std::string>& notes) {
  PlanePoints read = read_points(target, key, {{{"x", second_axis}, max_curve_points, true}, checks_size});
  notes.insert(notes.end(), read.notes.begin(), read.notes.end());
  return make_from_points(std::move(read),
                          [](std::vector<Eigen::Vector2d> p) { return Outline(std::move(p)); });
}

Outline read_outline(const Node& points) {
  return make_from_points(read_points(points, second_axis),
                          [](std::vector<Eigen::Vector2d> read) { return Outline(std::move(read)); });
}

}  // namespace kinetix::targets
