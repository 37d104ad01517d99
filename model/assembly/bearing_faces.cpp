#include "model/assembly/bearing_faces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "model/base/decompositions.hpp"

namespace kinetix::model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Rad: steeper cones are cylinders of rounding, flatter ones are flat faces
constexpr double least_half_angle = 5 * radians_per_degree, most_half_angle = 80 * radians_per_degree;
constexpr double equal_half_angles = 5 * radians_per_degree;  // rad: others touch at one end alone
// Ratio of the spread of normals along the direction in which they spread least: cones have none
constexpr double least_ball_spread = 1e-3;
constexpr double most_ball_lean = 0.9;  // cosine between a facet's normal and its radius
constexpr int least_ball_corners = 12;
constexpr double retaining = 100 * radians_per_degree;  // rad: a socket beyond the half ball

std::vector<int> corners_of(const std::vector<int>& region, const Polyhedron& solid) {
  std::set<int> corners;
  for (const int t : region) corners.insert(solid.triangles[t].begin(), solid.triangles[t].end());
  return {corners.begin(), corners.end()};
}

/// Returns the directions of the spread of normals about their mean, the least first.
PrincipalAxes spread_of_normals(const std::vector<int>& region, const Facets& facets) {
  Vector3d mean = Vector3d::Zero();
  for (const int t : region) mean += facets.normals[t] / static_cast<double>(region.size());
  Matrix3d spread = Matrix3d::Zero();
  for (const int t : region) spread += (facets.normals[t] - mean) * (facets.normals[t] - mean).transpose();
  return principal_axes(spread);
}

/// Returns the point nearest to the planes of all facets, mm.
Vector3d common_point(const std::vector<int>& region, const Facets& facets) {
  Eigen::MatrixX3d rows(region.size(), 3);
  Eigen::VectorXd right(region.size());
  for (Eigen::Index k = 0; k < rows.rows(); ++k) {
    const int t = region[static_cast<std::size_t>(k)];
    rows.row(k) = facets.normals[t].transpose();
    right[k] = facets.normals[t].dot(facets.centers[t]);
  }
  return least_squares(rows, right);
}

std::optional<ConeFace> fitted_cone(const std::vector<int>& region, const Polyhedron& solid,
                                    const Facets& facets, bool hollow) {
  if (static_cast<int>(region.size()) < min_round_facets) return std::nullopt;
  const PrincipalAxes spread = spread_of_normals(region, facets);
  if (!(std::sqrt(std::max(0.0, spread.values[0]) / spread.values[1]) < roundness)) return std::nullopt;
  Vector3d axis = spread.axes.col(0);
  // Normals of a tip lean towards its apex, those of a cup away from it.
  double lean = 0;
  for (const int t : region) lean += facets.normals[t].dot(axis) / static_cast<double>(region.size());
  if ((lean > 0) != hollow) axis = -axis;
  const double half_angle = std::asin(std::min(1.0, std::abs(lean)));
  if (!(half_angle > least_half_angle && half_angle < most_half_angle)) return std::nullopt;
  ConeFace face{hollow, common_point(region, facets), axis};
  face.inner_slope = std::tan(half_angle);
  face.from = std::numeric_limits<double>::infinity();
  face.to = -face.from;
  const Vector3d u = axis.unitOrthogonal(), v = axis.cross(u);
  const std::vector<int> corners = corners_of(region, solid);
  std::vector<Vector2d> all_across, round_about;
  std::vector<double> heights;  // above the apex
  double widest = 0;
  for (const int p : corners) {
    const Vector3d r = solid.points[p] - face.apex;
    all_across.emplace_back(u.dot(r), v.dot(r));
    heights.push_back(axis.dot(r));
    face.from = std::min(face.from, axis.dot(solid.points[p]));
    face.to = std::max(face.to, axis.dot(solid.points[p]));
    widest = std::max(widest, all_across.back().norm());
  }
  // A corner at the apex has no slope.
  for (std::size_t k = 0; k < corners.size(); ++k)
    if (all_across[k].norm() > roundness * widest) {
      round_about.push_back(all_across[k]);
      face.slope = std::max(face.slope, all_across[k].norm() / heights[k]);
    }
  const double slack = roundness * widest + 1e-4;  // mm
  for (std::size_t k = 0; k < corners.size(); ++k)
    if (!(all_across[k].norm() <= face.slope * heights[k] + slack &&
          all_across[k].norm() >= face.inner_slope * heights[k] - slack))
      return std::nullopt;
  if (static_cast<int>(round_about.size()) < min_round_facets ||
      !(covered(round_about, Vector2d::Zero()) > min_round_turn))
    return std::nullopt;
  if (!(face.inner_slope >= flattest_facet * face.slope)) return std::nullopt;
  return face;
}

/// Returns the center of the sphere through points, by |p|^2 = 2 c . p + d, linear in c and d.
Vector3d sphere_center(const std::vector<int>& corners, const Polyhedron& solid) {
  const Vector3d origin = solid.points[corners.front()];
  Eigen::MatrixX4d rows(corners.size(), 4);
  Eigen::VectorXd squares(corners.size());
  for (Eigen::Index k = 0; k < rows.rows(); ++k) {
    const Vector3d p = solid.points[corners[static_cast<std::size_t>(k)]] - origin;
    rows.row(k) << 2 * p.transpose(), 1;
    squares[k] = p.squaredNorm();
  }
  return origin + least_squares(rows, squares).head<3>();
}

std::optional<BallFace> fitted_ball(const std::vector<int>& region, const Polyhedron& solid,
                                    const Facets& facets, bool hollow) {
  const std::vector<int> corners = corners_of(region, solid);
  if (static_cast<int>(corners.size()) < least_ball_corners) return std::nullopt;
  // Normals of cylinders and cones, whose corners may be on a sphere as well, are in one plane.
  const PrincipalAxes spread = spread_of_normals(region, facets);
  if (!(spread.values[0] > least_ball_spread * spread.values[2])) return std::nullopt;
  BallFace face{hollow, sphere_center(corners, solid)};
  Vector3d middle = Vector3d::Zero();
  for (const int p : corners) {
    face.radius_mm = std::max(face.radius_mm, (solid.points[p] - face.center).norm());
    middle += (solid.points[p] - face.center).stableNormalized();
  }
  for (const int p : corners)
    if (!((solid.points[p] - face.center).norm() >= (1 - roundness) * face.radius_mm - 1e-4))
      return std::nullopt;
  face.inner_mm = face.radius_mm;
  for (const int t : region) {
    const Vector3d r = (facets.centers[t] - face.center) * (hollow ? -1 : 1);
    const double away = facets.normals[t].dot(r);
    if (!(away > most_ball_lean * r.norm())) return std::nullopt;
    face.inner_mm = std::min(face.inner_mm, away);
  }
  if (!(face.inner_mm >= flattest_facet * face.radius_mm)) return std::nullopt;
  for (const int p : corners) {
    const Vector3d r = solid.points[p] - face.center;
    face.reach = std::max(face.reach, std::atan2(middle.cross(r).norm(), middle.dot(r)));
  }
  return face;
}

}  // namespace

std::optional<PinFit> cone_fit(const ConeFace& tip, const ConeFace& cup) {
  if (tip.hollow || !cup.hollow || !(tip.axis.dot(cup.axis) > std::cos(parallel_axes))) return std::nullopt;
  const double half_angle = std::atan(tip.slope);
  if (!(std::abs(half_angle - std::atan(cup.inner_slope)) < equal_half_angles)) return std::nullopt;
  const Vector3d axis = (tip.axis + cup.axis).normalized(), between = cup.apex - tip.apex;
  const double from = std::max(tip.from, cup.from), to = std::min(tip.to, cup.to), middle = (from + to) / 2;
  const double tip_apex = axis.dot(tip.apex), cup_apex = axis.dot(cup.apex);
  const auto gap = [&](double at) {
    return (cup.inner_slope * (at - cup_apex) - tip.slope * (at - tip_apex)) * std::cos(half_angle);
  };
  const double radius = tip.slope * (middle - tip_apex), clearance = std::min(gap(from), gap(to));
  if (!(to - from >= min_bearing_overlap * 2 * radius) || !(radius > 0)) return std::nullopt;
  if (!(clearance >= 0) || !(clearance <= max_bearing_play * radius)) return std::nullopt;
  const double aside = (between - between.dot(axis) * axis).norm();
  if (!(aside <= std::max(clearance, roundness * radius))) return std::nullopt;
  Vector3d point = (tip.apex + cup.apex) / 2;
  point += (middle - axis.dot(point)) * axis;
  return PinFit{point, axis, 2 * radius, clearance, to - from};
}

std::optional<BallFit> ball_fit(const BallFace& ball, const BallFace& socket) {
  if (ball.hollow || !socket.hollow) return std::nullopt;
  const double clearance = socket.inner_mm - ball.radius_mm;
  if (!(clearance >= 0) || !(clearance <= max_bearing_play * ball.radius_mm)) return std::nullopt;
  if (!((ball.center - socket.center).norm() <= std::max(clearance, roundness * ball.radius_mm)))
    return std::nullopt;
  return BallFit{(ball.center + socket.center) / 2, 2 * ball.radius_mm, clearance, socket.reach > retaining};
}

PinFit pin_of_balls(const BallFit& first, const BallFit& second) {
  const Vector3d between = second.center - first.center;
  return {(first.center + second.center) / 2, between.normalized(), std::min(first.ball_mm, second.ball_mm),
          std::min(first.clearance_mm, second.clearance_mm),
          between.norm() + (first.ball_mm + second.ball_mm) / 2};
}

namespace {

bool are_coaxial(const PinFit& a, const PinFit& b) {
  const Vector3d between = b.point - a.point;
  return std::abs(a.axis.dot(b.axis)) > 0.9998 &&
         (between - between.dot(a.axis) * a.axis).norm() < a.rod_mm / 4;
}

/// Merges all bearings on one axis into one, in the middle of the outermost ones.
std::vector<PinFit> on_separate_axes(const std::vector<PinFit>& fits) {
  std::vector<PinFit> out;
  for (const PinFit& fit : fits) {
    const auto same =
        std::find_if(out.begin(), out.end(), [&](const PinFit& o) { return are_coaxial(o, fit); });
    if (same == out.end()) {
      out.push_back(fit);
      continue;
    }
    const double shift = (fit.point - same->point).dot(same->axis);
    const double from = std::min(-same->length_mm / 2, shift - fit.length_mm / 2);
    const double to = std::max(same->length_mm / 2, shift + fit.length_mm / 2);
    same->point += (from + to) / 2 * same->axis;
    same->length_mm = to - from;
  }
  return out;
}

/// Adds the pins whose axes have none yet.
void add_new_axes(const std::vector<PinFit>& more, std::vector<PinFit>& pins) {
  for (const PinFit& fit : more)
    if (std::none_of(pins.begin(), pins.end(), [&](const PinFit& o) { return are_coaxial(o, fit); }))
      pins.push_back(fit);
}

template <class Face, class Fit>
void add_fits(const std::vector<Face>& inner, const std::vector<Face>& outer,
              std::optional<Fit> (*fit_of)(const Face&, const Face&), std::vector<Fit>& out) {
  for (const Face& one : inner)
    for (const Face& other : outer)
      if (const auto fit = fit_of(one, other)) out.push_back(*fit);
}

}  // namespace

Bearings bearings_of(const Polyhedron& solid) {
  const BentRegions regions = bent_regions(solid);
  return {cylinder_faces(solid, regions), fit_faces<ConeFace>(solid, regions, fitted_cone),
          fit_faces<BallFace>(solid, regions, fitted_ball)};
}

BearingFits fits_between(const Bearings& first, const Bearings& second) {
  std::vector<PinFit> rods, cones;
  std::vector<BallFit> balls;
  for (const auto& [inner, outer] : {std::pair(&first, &second), std::pair(&second, &first)}) {
    add_fits(inner->cylinders, outer->cylinders, pin_fit, rods);
    add_fits(inner->cones, outer->cones, cone_fit, cones);
    add_fits(inner->balls, outer->balls, ball_fit, balls);
  }
  BearingFits out{on_separate_axes(rods), {}};
  add_new_axes(on_separate_axes(cones), out.pins);
  if (balls.size() == 2) add_new_axes({pin_of_balls(balls[0], balls[1])}, out.pins);
  for (const BallFit& ball : balls) {
    const bool is_on_pin = std::any_of(out.pins.begin(), out.pins.end(), [&](const PinFit& pin) {
      return pin.axis.cross(ball.center - pin.point).norm() < ball.ball_mm / 4;
    });
    if (ball.is_retained && !is_on_pin) out.balls.push_back(ball);
  }
  return out;
}

}  // namespace kinetix::model
