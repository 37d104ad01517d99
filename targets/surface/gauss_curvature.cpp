#include "targets/surface/gauss_curvature.hpp"

#include <cmath>
#include <limits>

#include "model/base/geometry.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double angle_between(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// K dA over dx dy, 1 / mm^2: det H / (1 + |slope|^2)^(3/2).
double gauss_density(const Height& h) {
  const double g = 1 + h.slope.squaredNorm();
  return h.bending.determinant() / (g * std::sqrt(g));
}

bool is_over(const SurfacePatch& patch, const Vector2d& at) {
  constexpr double rim = 1 + 1e-9;  // of the half side: points on the rim belong to the surface
  return std::abs(at.x()) <= rim * patch.half.x() && std::abs(at.y()) <= rim * patch.half.y();
}

/// Integrals over one sign of the surface's curvature, sr.
struct SignSum {
  double sheet = 0, surface = 0;
  double share() const { return std::clamp(sheet / surface, 0.0, 1.0); }
};

}  // namespace

std::vector<double> angle_defects(const PointGrid& grid) {
  std::vector<double> out;
  for (int j = 1; j < grid.rows; ++j)
    for (int i = 1; i < grid.columns; ++i) {
      const Vector3d& p = grid.at(i, j);
      const Vector3d arms[] = {grid.at(i + 1, j) - p, grid.at(i, j + 1) - p, grid.at(i - 1, j) - p,
                               grid.at(i, j - 1) - p};
      double defect = 2 * pi;
      for (int k = 0; k < 4; ++k) defect -= angle_between(arms[k], arms[(k + 1) % 4]);
      out.push_back(defect);
    }
  return out;
}

double gauss_integral(const SurfacePatch& patch, const std::array<Vector2d, 4>& c) {
  // Three points of Gauss and Legendre along each side of the unit square.
  static const double at[] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
  constexpr double weight[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  double sum = 0;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      const double u = at[a], v = at[b];
      const Vector2d p = (1 - v) * ((1 - u) * c[0] + u * c[1]) + v * ((1 - u) * c[3] + u * c[2]);
      const Vector2d by_u = (1 - v) * (c[1] - c[0]) + v * (c[2] - c[3]);
      const Vector2d by_v = (1 - u) * (c[3] - c[0]) + u * (c[2] - c[1]);
      const double area = by_u.x() * by_v.y() - by_u.y() * by_v.x();
      sum += weight[a] * weight[b] * area * gauss_density(patch.height(p));
    }
  return sum;
}

GaussShare gauss_share(const SurfacePatch& surface, const PointGrid& middle) {
  std::vector<Vector2d> below;
  for (const Vector3d& p : middle.points) below.push_back(closest_surface_point(surface, p).at);
  const auto at = [&](int i, int j) { return below[static_cast<std::size_t>(j) * (middle.columns + 1) + i]; };
  const auto centre = [&](int i, int j) -> Vector2d {
    return (at(i, j) + at(i + 1, j) + at(i + 1, j + 1) + at(i, j + 1)) / 4;
  };
  const std::vector<double> defects = angle_defects(middle);
  SignSum bowl, saddle;
  bool has_inner = false;
  std::size_t k = 0;
  for (int j = 1; j < middle.rows; ++j)
    for (int i = 1; i < middle.columns; ++i, ++k) {
      if (!is_over(surface, at(i, j))) continue;
      const double wanted =
          gauss_integral(surface, {centre(i - 1, j - 1), centre(i, j - 1), centre(i, j), centre(i - 1, j)});
      SignSum& sum = wanted > 0 ? bowl : saddle;
      has_inner = true;
      sum.surface += wanted;
      sum.sheet += defects[k];
    }
  GaussShare out{curvature_of(surface).total, std::numeric_limits<double>::quiet_NaN()};
  if (!has_inner) out.share = out.wanted > 0 ? 0 : out.share;
  const double larger = std::max(bowl.surface, -saddle.surface);
  for (const SignSum& sum : {bowl, saddle}) {
    const double size = std::abs(sum.surface);
    if (!(size > 0) || (size < larger && size <= double_curvature_threshold / 2)) continue;
    out.share = std::isnan(out.share) ? sum.share() : std::min(out.share, sum.share());
  }
  return out;
}

}  // namespace kinetix::targets
