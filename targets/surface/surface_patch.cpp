#include "targets/surface/surface_patch.hpp"

#include <Eigen/LU>
#include <cmath>
#include <map>
#include <new>

#include "model/base/decompositions.hpp"
#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"
#include "targets/outline/outline.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int grid = 40;          // places a side at which diagonal and curvature are taken
constexpr int newton_steps = 20;  // quadratic: five do where the surface is not near its centre of curvature
constexpr double still = 1e-13;   // of the patch: steps that are rounding
constexpr double max_arc = 140 * radians_per_degree;       // of a cap: its corners then rise by 70 deg
constexpr double max_vase_arc = 120 * radians_per_degree;  // rims then rise by 60 deg

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
  require("arc_deg", to_degrees(arc), arc > 0 && arc <= max_arc, "in (0, 140] deg");
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
  require("arc_deg", to_degrees(arc), arc > 0 && arc <= max_vase_arc, "in (0, 120] deg");
  const double half = height / 2, wave = pi / half, wide = radius * std::sin(arc / 2), neck = radius - swell;
  if (!(wide <= most_of_neck * neck))
    throw InvalidInput("arc_deg is " + number_text(to_degrees(arc)) + ": a front of " +
                       number_text(2 * wide) + " mm is more than 0.95 of the neck's width, " +
                       number_text(2 * neck) + " mm. Give a smaller arc_deg or swell_mm");
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

namespace {

constexpr int degree = 8;       // of the heights: 45 terms follow a wave and a half a side
constexpr double ridge = 1e-8;  // of the mean squared term: keeps few vertices from swinging
constexpr double max_miss =
    0.01;  // of the mesh's size: rms of vertices from the polynomial, above it is not smooth
constexpr double max_slope = 80;    // deg from the mean normal: steeper, a height over the plane says little
constexpr double same_area = 1e-3;  // ratio: of triangles and of the loop round them, seen along the normal

/// Removes triangles that have a corner twice, such as those at the pole of a dome made of quadrilaterals.
TriangleMesh with_three_corners(TriangleMesh mesh) {
  std::erase_if(mesh.triangles,
                [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  return mesh;
}

/// Returns the only loop of edges that have a single triangle.
std::vector<int> boundary_of(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> uses;
  std::map<int, int> next;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++uses[std::minmax(t[k], t[(k + 1) % 3])];
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const int from = t[k], to = t[(k + 1) % 3], count = uses[std::minmax(from, to)];
      if (count > 2)
        throw InvalidInput("an edge of the mesh has more than two triangles. Give a single open surface");
      if (count == 1 && !next.try_emplace(from, to).second)
        throw InvalidInput(
            "two parts of the mesh share a single vertex, or its triangles have different orientations. Give "
            "a single open surface");
    }
  if (next.empty()) throw InvalidInput("the mesh is closed. Give an open surface, such as a part of it");
  std::vector<int> rim;
  for (int at = next.begin()->first; rim.empty() || at != rim.front();) {
    rim.push_back(at);
    const auto found = next.find(at);
    if (found == next.end() || rim.size() > next.size())
      throw InvalidInput("the triangles of the mesh have different orientations. Give a single open surface");
    at = found->second;
  }
  if (rim.size() != next.size())
    throw InvalidInput("the mesh has holes or several pieces. Give a single open surface without holes");
  return rim;
}

/// Returns the rotation whose rows are x, y and z of the mesh's frame; x is still to be chosen.
Eigen::Matrix3d upright(const TriangleMesh& mesh) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) sum += area_normal(mesh, t);
  return rotation_between(sum.normalized(), Vector3d::UnitZ());
}

void check_slope(const TriangleMesh& mesh, const Vector3d& z) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3d normal = area_normal(mesh, t);
    if (normal.norm() > 0 && !(normal.normalized().dot(z) > std::cos(max_slope * radians_per_degree)))
      throw InvalidInput("the surface curves too much: triangle " + std::to_string(t + 1) +
                         " turns by 80 deg or more from the mean normal. Cut it into flatter parts");
  }
}

double seen_area(const TriangleMesh& mesh, const Vector3d& z) {
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += area_normal(mesh, t).dot(z) / 2;
  return area;
}

double loop_area(const std::vector<Vector2d>& loop) {
  return signed_area(loop.size(), [&](std::size_t k) { return loop[k]; });
}

/// Least rectangle round a loop: the direction of its first side, and its box there.
struct Rectangle {
  double angle = 0, area = INFINITY;
  Eigen::AlignedBox2d box;
};
Rectangle min_rectangle(const std::vector<Vector2d>& loop) {
  Rectangle best;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vector2d side = loop[(k + 1) % loop.size()] - loop[k];
    double angle = std::remainder(std::atan2(side.y(), side.x()), pi / 2);
    const Eigen::Rotation2Dd back(-angle);
    Eigen::AlignedBox2d box;
    for (const Vector2d& p : loop) box.extend(back * p);
    const double area = box.sizes().prod();
    if (area < best.area * (1 - 1e-9)) best = {angle, area, box};
  }
  return best;
}

/// Chebyshev polynomials of x up to the degree, with their derivatives.
struct Powers {
  std::array<double, degree + 1> value, first, second;
};
Powers powers(double x) {
  Powers p;
  p.value[0] = 1, p.first[0] = p.second[0] = 0;
  p.value[1] = x, p.first[1] = 1, p.second[1] = 0;
  for (int k = 2; k <= degree; ++k) {
    p.value[k] = 2 * x * p.value[k - 1] - p.value[k - 2];
    p.first[k] = 2 * p.value[k - 1] + 2 * x * p.first[k - 1] - p.first[k - 2];
    p.second[k] = 4 * p.first[k - 1] + 2 * x * p.second[k - 1] - p.second[k - 2];
  }
  return p;
}

template <class Visit>
void for_terms(const Visit& visit) {
  int term = 0;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j) visit(term++, i, j);
}
// Number of terms of the polynomial: all products of degree up to that.
constexpr int terms = (degree + 1) * (degree + 2) / 2;

Height height_at(const Eigen::VectorXd& weight, const Vector2d& half, const Vector2d& at) {
  const Powers x = powers(at.x() / half.x()), y = powers(at.y() / half.y());
  Height out;
  for_terms([&](int k, int i, int j) {
    out.z += weight[k] * x.value[i] * y.value[j];
    out.slope += weight[k] * Vector2d(x.first[i] * y.value[j] / half.x(), x.value[i] * y.first[j] / half.y());
    const double mixed = x.first[i] * y.first[j] / (half.x() * half.y());
    Eigen::Matrix2d bend;
    bend << x.second[i] * y.value[j] / (half.x() * half.x()), mixed, mixed,
        x.value[i] * y.second[j] / (half.y() * half.y());
    out.bending += weight[k] * bend;
  });
  return out;
}

Eigen::VectorXd fitted(const std::vector<Vector3d>& points, const Vector2d& half) {
  Eigen::MatrixXd A(points.size() + terms, terms);
  Eigen::VectorXd z = Eigen::VectorXd::Zero(A.rows());
  A.setZero();
  for (std::size_t r = 0; r < points.size(); ++r) {
    const Powers x = powers(points[r].x() / half.x()), y = powers(points[r].y() / half.y());
    for_terms([&](int k, int i, int j) { A(static_cast<int>(r), k) = x.value[i] * y.value[j]; });
    z[static_cast<int>(r)] = points[r].z();
  }
  const double keep = std::sqrt(ridge * static_cast<double>(points.size()));
  for_terms(
      [&](int k, int i, int j) { A(static_cast<int>(points.size()) + k, k) = keep * (1 + i * i + j * j); });
  return least_squares(A, z);
}

}  // namespace

SurfacePatch mesh_patch(const TriangleMesh& given) {
  const TriangleMesh mesh = with_three_corners(joined(given));
  const std::vector<int> rim = boundary_of(mesh);
  Eigen::Matrix3d frame = upright(mesh);
  const Vector3d z = frame.row(2);
  check_slope(mesh, z);
  std::vector<Vector2d> loop;
  for (const int v : rim) loop.push_back((frame * mesh.vertices[v]).head<2>());
  try {
    Outline outline(loop);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    throw InvalidInput("the surface covers itself: its rim crosses itself as seen along the mean normal");
  }
  const double area = seen_area(mesh, z);
  if (!(std::abs(area - loop_area(loop)) <= same_area * area))
    throw InvalidInput("the surface covers itself as seen along its mean normal. Cut it into flatter parts");
  const Rectangle rectangle = min_rectangle(loop);
  frame = Eigen::AngleAxisd(-rectangle.angle, Vector3d::UnitZ()).toRotationMatrix() * frame;
  const Vector2d middle = rectangle.box.center();
  std::vector<Vector3d> points;
  double mean = 0;
  for (const Vector3d& vertex : mesh.vertices) {
    points.push_back(frame * vertex - Vector3d(middle.x(), middle.y(), 0));
    mean += points.back().z() / static_cast<double>(mesh.vertices.size());
  }
  for (Vector3d& point : points) point.z() -= mean;
  const Vector2d round = rectangle.box.sizes() / 2;
  const Eigen::VectorXd weight = fitted(points, round);
  double miss = 0;
  for (const Vector3d& p : points) miss += std::pow(height_at(weight, round, p.head<2>()).z - p.z(), 2);
  miss = std::sqrt(miss / static_cast<double>(points.size()));
  if (!(miss <= max_miss * rectangle.box.sizes().norm()))
    throw InvalidInput("the surface is not smooth: the nearest smooth one is " +
                       number_text(100 * miss / rectangle.box.sizes().norm()) +
                       " % of its size off, and the limit is 1 %");
  return {"mesh", round * std::sqrt(std::min(1.0, area / rectangle.area)),
          [weight, round](const Vector2d& at) { return height_at(weight, round, at); }};
}

}  // namespace kinetix::targets
