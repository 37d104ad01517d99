#include "targets/surface/surface_patch.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "model/base/angle.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int grid = 40;          // places a side at which diagonal and curvature are taken
constexpr int newton_steps = 20;  // quadratic: five do where the surface is not near its centre of curvature
constexpr double still = 1e-13;   // of the patch: steps that are rounding
constexpr double most_arc = 140 * radians_per_degree;       // of a cap: its corners then rise by 70 deg
constexpr double most_vase_arc = 120 * radians_per_degree;  // rims then rise by 60 deg

template <class Visit>
void for_grid(const SurfacePatch& patch, const Visit& visit) {
  for (int i = 0; i <= grid; ++i)
    for (int j = 0; j <= grid; ++j)
      visit(Vector2d(patch.half.x() * (2.0 * i / grid - 1), patch.half.y() * (2.0 * j / grid - 1)));
}

/// sqrt(q) with its derivatives. Below `least` it continues as a parabola, so that surfaces continue beyond their
/// equator.
struct Root {
  double value, first, second;
};
Root root(double q, double least) {
  const double s = std::sqrt(std::max(q, least));
  const Root at{s, 0.5 / s, -0.25 / (s * s * s)};
  if (q >= least) return at;
  const double d = q - least;
  return {at.value + d * at.first + d * d / 2 * at.second, at.first + d * at.second, at.second};
}

constexpr double equator = 0.02;  // of the squared radius: heights go on as parabolas nearer to the equator
constexpr double most_of_neck =
    0.95;  // of a neck's width, of the front over it: the rims then rise by 72 deg

void require_width(double width) { require("width", width, width > 0 && std::isfinite(width), "above 0 mm"); }

}  // namespace

double SurfacePatch::diagonal() const {
  Eigen::AlignedBox3d box;
  for_grid(*this, [&](const Vector2d& at) { box.extend(Vector3d(at.x(), at.y(), height(at).z)); });
  return box.sizes().norm();
}

ClosestSurfacePoint closest_surface_point(const SurfacePatch& patch, const Vector3d& p) {
  ClosestSurfacePoint out;
  const Vector2d below = p.head<2>();
  out.at = below;
  Height h = patch.height(out.at);
  out.at += (p.z() - h.z) / (1 + h.slope.squaredNorm()) * h.slope;
  const double size = patch.half.norm();
  for (int k = 0; k < newton_steps; ++k) {
    h = patch.height(out.at);
    const double above = h.z - p.z();
    const Vector2d gradient = out.at - below + above * h.slope;
    const Matrix2d hessian = Matrix2d::Identity() + h.slope * h.slope.transpose() + above * h.bending;
    Vector2d step = -hessian.inverse() * gradient;
    if (!(hessian.determinant() > 0)) step = -gradient / (1 + h.slope.squaredNorm());
    out.at += step;
    if (!(step.norm() > still * size)) break;
  }
  h = patch.height(out.at);
  out.normal = Vector3d(-h.slope.x(), -h.slope.y(), 1).normalized();
  out.distance = out.normal.dot(p - Vector3d(out.at.x(), out.at.y(), h.z));
  return out;
}

std::array<double, 2> principal_curvatures(const Height& h) {
  const Matrix2d first = Matrix2d::Identity() + h.slope * h.slope.transpose();
  const Matrix2d shape = first.inverse() * h.bending / std::sqrt(1 + h.slope.squaredNorm());
  const double mean = shape.trace() / 2, gauss = shape.determinant();
  const double root = std::sqrt(std::max(0.0, mean * mean - gauss));
  if (mean < 0) return {mean - root, mean + root};
  return {mean + root, mean - root};
}

SurfaceCurvature curvature_of(const SurfacePatch& patch) {
  SurfaceCurvature out;
  double sum = 0;
  for_grid(patch, [&](const Vector2d& at) {
    const Height h = patch.height(at);
    const auto [larger, smaller] = principal_curvatures(h);
    if (std::abs(larger) > out.most) out.most = std::abs(larger), out.place = at;
    const auto side = [](double x, double half) {
      return std::abs(std::abs(x) - half) < 1e-9 * half ? 0.5 : 1.0;
    };
    sum += side(at.x(), patch.half.x()) * side(at.y(), patch.half.y()) * std::abs(larger * smaller) *
           std::sqrt(1 + h.slope.squaredNorm());
  });
  out.total = sum * 4 * patch.half.x() * patch.half.y() / (grid * grid);
  return out;
}

SurfacePatch cap_patch(double width, double arc) {
  require_width(width);
  require("arc_deg", to_degrees(arc), arc > 0 && arc <= most_arc, "in (0, 140] deg");
  const double half = width / 2, radius = std::sqrt(2) * half / std::sin(arc / 2);
  const double middle = radius * std::cos(arc / 2);
  return {"cap", {half, half}, [radius, middle](const Vector2d& at) {
            const Root r = root(radius * radius - at.squaredNorm(), equator * radius * radius);
            const Matrix2d bending = -2 * r.first * Matrix2d::Identity() + 4 * r.second * at * at.transpose();
            return Height{r.value - middle, -2 * r.first * at, bending};
          }};
}

SurfacePatch saddle_patch(double width, double rise) {
  require_width(width);
  require("rise", rise, rise > 0 && rise <= 1, "in (0, 1]");
  const double k = rise / (width / 2);
  return {"saddle", {width / 2, width / 2}, [k](const Vector2d& at) {
            const Matrix2d bending = Vector2d(2 * k, -2 * k).asDiagonal();
            return Height{k * (at.x() * at.x() - at.y() * at.y()), bending * at, bending};
          }};
}

SurfacePatch vase_patch(double height, double radius, double swell, double arc) {
  require_width(height);
  require("radius", radius, radius > 0 && std::isfinite(radius), "above 0 mm");
  require("swell", swell, swell >= 0 && swell <= radius / 2, "from 0 to half the radius, mm");
  require("arc_deg", to_degrees(arc), arc > 0 && arc <= most_vase_arc, "in (0, 120] deg");
  const double half = height / 2, wave = pi / half, wide = radius * std::sin(arc / 2), neck = radius - swell;
  if (!(wide <= most_of_neck * neck))
    throw InvalidInput("arc_deg is " + number_text(to_degrees(arc)) + ": a front of " +
                       number_text(2 * wide) + " mm is more than 0.95 of the neck's width, " +
                       number_text(2 * neck) + " mm; give a smaller arc_deg or swell_mm");
  return round_patch("vase", {half, wide}, radius, neck, [=](double x) {
    const double s = std::sin(wave * x), c = std::cos(wave * x);
    return std::array{radius + swell * s, swell * wave * c, -swell * wave * wave * s};
  });
}

SurfacePatch round_patch(const std::string& name, const Vector2d& half, double level, double narrowest,
                         const std::function<std::array<double, 3>(double)>& radius) {
  return {name, half, [=](const Vector2d& at) {
            const auto [r, r1, r2] = radius(at.x());
            const Root root_of = root(r * r - at.y() * at.y(), equator * narrowest * narrowest);
            const Vector2d q1(2 * r * r1, -2 * at.y());
            const Matrix2d q2 = Vector2d(2 * (r1 * r1 + r * r2), -2).asDiagonal();
            return Height{root_of.value - level, root_of.first * q1,
                          root_of.first * q2 + root_of.second * q1 * q1.transpose()};
          }};
}

}  // namespace kinetix::targets
