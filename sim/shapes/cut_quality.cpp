#include "sim/shapes/cut_quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace kinetix::sim {
namespace {

using Eigen::Vector3d;
using model::Polyhedron;

constexpr double watched_places =
    1200;                     // approximate number over the surface: with 36 x 36 a thirtieth of a side
                              // apart
constexpr int levels = 4;     // of watch points over a place, each three times as far away as the one before
constexpr int max_rows = 24;  // over a triangle, and places in a row: more would only crowd large faces
constexpr std::size_t max_watched = 3000;  // points in all: each is checked against every face of a hull

/// Returns the squared distance to a triangle: inside it that of its plane, otherwise of its nearest side.
double squared_distance(const Vector3d& p, const std::array<Vector3d, 3>& t) {
  const Vector3d n = (t[1] - t[0]).cross(t[2] - t[0]);
  bool inside = n.squaredNorm() > 0;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Vector3d side = t[(k + 1) % 3] - t[k], arm = p - t[k];
    if (n.cross(side).dot(arm) < 0) inside = false;
    const double length = side.squaredNorm();
    const double along = length > 0 ? std::clamp(arm.dot(side) / length, 0.0, 1.0) : 0.0;
    least = std::min(least, (arm - along * side).squaredNorm());
  }
  if (!inside) return least;
  const double off = n.dot(p - t[0]);
  return off * off / n.squaredNorm();
}

double area_of(const Polyhedron& solid) {
  double area = 0;
  for (int t = 0; t < static_cast<int>(solid.triangles.size()); ++t) {
    const auto c = corners_of(solid, t);
    area += (c[1] - c[0]).cross(c[2] - c[0]).norm() / 2;
  }
  return area;
}

bool is_in(const CutPiece& piece, const Vector3d& p) {
  for (Eigen::Index f = 0; f < piece.faces.rows(); ++f)
    if (piece.faces.row(f).head<3>().dot(p) > piece.faces(f, 3)) return false;
  return true;
}

/// Returns element k of the van der Corput sequence of a base.
double radical_inverse(int k, int base) {
  double out = 0, digit = 1.0 / base;
  for (; k > 0; k /= base, digit /= base) out += digit * (k % base);
  return out;
}

}  // namespace

std::array<Vector3d, 3> corners_of(const Polyhedron& solid, int t) {
  const auto& [a, b, c] = solid.triangles[t];
  return {solid.points[a], solid.points[b], solid.points[c]};
}

NearSolid::NearSolid(const Polyhedron& solid) : solid_(solid) {
  for (int t = 0; t < static_cast<int>(solid.triangles.size()); ++t) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& p : corners_of(solid, t)) box.extend(p);
    boxes_.push_back(box);
    by_x_.push_back(t);
  }
  std::stable_sort(by_x_.begin(), by_x_.end(),
                   [&](int s, int t) { return boxes_[s].min().x() < boxes_[t].min().x(); });
}

bool NearSolid::is_farther_than(const Vector3d& p, double distance) const {
  const double square = distance * distance;
  for (const int t : by_x_) {
    if (boxes_[t].min().x() > p.x() + distance) break;
    if (boxes_[t].squaredExteriorDistance(p) < square && squared_distance(p, corners_of(solid_, t)) < square)
      return false;
  }
  return true;
}

int NearSolid::nearest(const Vector3d& p) const {
  double least = std::numeric_limits<double>::infinity();
  int out = 0;
  for (std::size_t t = 0; t < boxes_.size(); ++t)
    if (const double d = boxes_[t].squaredExteriorDistance(p) < least
                             ? squared_distance(p, corners_of(solid_, static_cast<int>(t)))
                             : least;
        d < least) {
      least = d;
      out = static_cast<int>(t);
    }
  return out;
}

double NearSolid::distance(const Vector3d& p) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < boxes_.size(); ++t)
    if (boxes_[t].squaredExteriorDistance(p) < least)
      least = std::min(least, squared_distance(p, corners_of(solid_, static_cast<int>(t))));
  return std::sqrt(least);
}

bool NearSolid::holds(const Vector3d& p) const {
  double sum = 0;
  for (int t = 0; t < static_cast<int>(boxes_.size()); ++t) {
    const auto [a, b, c] = corners_of(solid_, t);
    const Vector3d u = a - p, v = b - p, w = c - p;
    const double lu = u.norm(), lv = v.norm(), lw = w.norm();
    sum += std::atan2(u.dot(v.cross(w)), lu * lv * lw + u.dot(v) * lw + v.dot(w) * lu + w.dot(u) * lv);
  }
  return sum > 3.14159;  // half of 2 pi, the sum of half angles inside
}

void add_over(const std::array<Vector3d, 3>& t, double spacing, std::vector<Vector3d>& out) {
  int k = 0;
  for (int l = 1; l < 3; ++l)
    if ((t[(l + 1) % 3] - t[l]).norm() > (t[(k + 1) % 3] - t[k]).norm()) k = l;
  const Vector3d from = t[k], side = t[(k + 1) % 3] - t[k], apex = t[(k + 2) % 3] - t[k];
  const double height = side.cross(apex).norm() / side.norm();
  const int rows = std::clamp(static_cast<int>(std::ceil(height / spacing)), 1, max_rows);
  for (int r = 0; r < rows; ++r) {
    const double v = rows == 1 ? 1.0 / 3 : (r + 0.5) / rows;
    const int places = std::clamp(static_cast<int>(std::ceil((1 - v) * side.norm() / spacing)), 1, max_rows);
    for (int i = 0; i < places; ++i) out.emplace_back(from + v * apex + (1 - v) * (i + 0.5) / places * side);
  }
}

std::vector<WatchPoint> watch_points(const Polyhedron& solid, const NearSolid& near, double off) {
  const double spacing = std::sqrt(area_of(solid) / watched_places);
  std::vector<std::pair<Vector3d, int>> all;
  for (int t = 0; t < static_cast<int>(solid.triangles.size()); ++t) {
    std::vector<Vector3d> places;
    add_over(corners_of(solid, t), spacing, places);
    for (const Vector3d& p : places) all.emplace_back(p, t);
  }
  const std::size_t stride = all.size() / max_watched + 1;
  std::vector<WatchPoint> out;
  for (std::size_t k = 0; k < all.size(); k += stride) {
    const auto& [place, t] = all[k];
    const auto c = corners_of(solid, t);
    const Vector3d normal = (c[1] - c[0]).cross(c[2] - c[0]).stableNormalized();
    double depth = 1;
    for (int level = 0; level < levels; ++level, depth *= 3) {
      const Vector3d at = place + depth * off * normal;
      if (!near.is_farther_than(at, 0.999 * depth * off)) break;
      out.push_back({at, t, depth});
    }
  }
  return out;
}

CutQuality measured(const std::vector<CutPiece>& pieces, const Polyhedron& solid, int points) {
  Eigen::AlignedBox3d box;
  for (const CutPiece& piece : pieces)
    for (const Vector3d& p : piece.corners) box.extend(p);
  const NearSolid near(solid);
  int inside = 0, covered = 0, in_pieces = 0, in_several = 0;
  CutQuality out;
  for (int k = 1; k <= points; ++k) {
    const Vector3d u(radical_inverse(k, 2), radical_inverse(k, 3), radical_inverse(k, 5));
    const Vector3d p = box.min() + u.cwiseProduct(box.sizes());
    const auto held =
        std::count_if(pieces.begin(), pieces.end(), [&](const CutPiece& piece) { return is_in(piece, p); });
    const bool is_inside = near.holds(p);
    inside += is_inside;
    covered += is_inside && held > 0;
    in_pieces += held > 0;
    in_several += held > 1;
    if (held > 0 && !is_inside) out.sticks_out_mm = std::max(out.sticks_out_mm, near.distance(p));
  }
  out.coverage = inside > 0 ? static_cast<double>(covered) / inside : 1;
  out.overlap = in_pieces > 0 ? static_cast<double>(in_several) / in_pieces : 0;
  return out;
}

}  // namespace kinetix::sim
