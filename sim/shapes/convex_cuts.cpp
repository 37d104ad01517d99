#include "sim/shapes/convex_cuts.hpp"

#include <LinearMath/btConvexHullComputer.h>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "model/assembly/cylinder_faces.hpp"
#include "model/assembly/shells.hpp"
#include "model/base/box.hpp"
#include "model/base/decompositions.hpp"
#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"
#include "sim/shapes/cut_quality.hpp"

namespace kinetix::sim {
namespace {

using Eigen::Vector3d;
using model::Polyhedron;
using CutPolygon = std::vector<Vector3d>;

constexpr double min_tolerance_mm = 0.1;  // mm: the tolerance of printers
constexpr double tolerance_share = 0.01;  // of the longest side
constexpr double watched_share =
    0.8;  // of the tolerance: points are on a grid, and places between them may protrude further
constexpr double looked_at = 3;             // times the tolerance, between checked places on a hull
constexpr std::size_t max_candidates = 10;  // planes tried for a cut: of the faces below most watch points
constexpr double large_bore = 0.1;          // of the longest side: smaller ones are cut as other faces
constexpr double same_plane =
    1e-3;  // rad, and offset over the longest side: cuts that differ by less are equal
constexpr double on_plane =
    2e-5;  // of the longest side: corners this near to a cut are on it, as in files of six digits
constexpr double thinnest = 1e-4;  // of the longest side: thinner parts are no pieces

struct CutPlane {
  Vector3d normal;
  double offset = 0;  // normal . p
};

double longest_side(const Polyhedron& solid) { return model::box_of(solid.points).sizes().maxCoeff(); }

/// Returns twice the area of a polygon, along its normal.
Vector3d area_of(const CutPolygon& polygon) {
  Vector3d out = Vector3d::Zero();
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
    out += (polygon[k] - polygon[0]).cross(polygon[k + 1] - polygon[0]);
  return out;
}

/// Returns the part of a polygon on the inner side, n . p <= offset.
CutPolygon clipped(const CutPolygon& polygon, const CutPlane& plane, double tolerance) {
  CutPolygon out;
  const auto off = [&](const Vector3d& p) {
    const double d = plane.normal.dot(p) - plane.offset;
    return std::abs(d) <= tolerance ? 0 : d;
  };
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector3d &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const double a = off(p), b = off(q);
    if (a <= 0) out.push_back(p);
    if ((a < 0 && b > 0) || (a > 0 && b < 0)) out.push_back(p + a / (a - b) * (q - p));
  }
  if (out.size() < 3) return {};
  // A face in the plane bounds the side of the solid.
  const bool lies_in_it =
      std::all_of(polygon.begin(), polygon.end(), [&](const Vector3d& p) { return off(p) == 0; });
  return lies_in_it && !(area_of(polygon).dot(plane.normal) > 0) ? CutPolygon{} : out;
}

/// @param skin output: its faces as triangles
CutPiece hull_of(const std::vector<Vector3d>& points, double min_size,
                 std::vector<std::array<Vector3d, 3>>& skin) {
  CutPiece out;
  btConvexHullComputer hull;
  hull.compute(points.front().data(), sizeof(Vector3d), static_cast<int>(points.size()), 0, 0);
  // The library rounds to a grid, so its corners are replaced by the points themselves.
  for (int v = 0; v < hull.vertices.size(); ++v) out.corners.push_back(points[hull.original_vertex_index[v]]);
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : out.corners) middle += p / static_cast<double>(out.corners.size());
  std::vector<Eigen::RowVector4d> rows;
  for (int f = 0; f < hull.faces.size(); ++f) {
    const btConvexHullComputer::Edge* const first = &hull.edges[hull.faces[f]];
    Vector3d area = Vector3d::Zero();
    const Vector3d origin = out.corners[first->getSourceVertex()];
    const btConvexHullComputer::Edge* edge = first;
    do {
      area += (out.corners[edge->getSourceVertex()] - origin)
                  .cross(out.corners[edge->getTargetVertex()] - origin);
      skin.push_back({origin, out.corners[edge->getSourceVertex()], out.corners[edge->getTargetVertex()]});
      edge = edge->getNextEdgeOfFace();
    } while (edge != first);
    Vector3d normal = area.stableNormalized();
    if (!(area.norm() > 1e-3 * min_size * min_size)) continue;  // the direction of a sliver is rounding
    if (normal.dot(origin - middle) < 0) normal = -normal;
    double offset = -std::numeric_limits<double>::infinity();
    for (const Vector3d& p : points) offset = std::max(offset, normal.dot(p));
    rows.emplace_back(normal.x(), normal.y(), normal.z(), offset);
  }
  // The omitted slivers bound it too, so at least its box is added.
  for (int k = 0; k < 3; ++k)
    for (const double sign : {-1.0, 1.0}) {
      const Vector3d normal = sign * Vector3d::Unit(k);
      double offset = -std::numeric_limits<double>::infinity();
      for (const Vector3d& p : points) offset = std::max(offset, normal.dot(p));
      rows.emplace_back(normal.x(), normal.y(), normal.z(), offset);
    }
  out.faces.resize(static_cast<Eigen::Index>(rows.size()), 4);
  for (std::size_t f = 0; f < rows.size(); ++f) out.faces.row(static_cast<Eigen::Index>(f)) = rows[f];
  return out;
}

/// Part of the solid in a cell.
struct CutCell {
  std::vector<CutPlane> planes;     // boundary of the cell
  std::vector<CutPolygon> surface;  // surface of the solid inside the cell
  std::vector<Vector3d> inner;      // corners of the cell inside the solid
  CutPiece hull;
  std::vector<std::array<Vector3d, 3>> skin;  // of the hull
  std::vector<int> watched;                   // watch points in the hull
  double weight = 0;                          // sum of their depths
  bool is_final = false;                      // no cut helps
};

bool is_within(const FilledBore& bore, const Vector3d& p) {
  const double along = bore.axis.dot(p - bore.point);
  return std::abs(along) <= bore.half_mm && (p - bore.point - along * bore.axis).norm() <= bore.radius_mm;
}

class Cutter {
 public:
  Cutter(const Polyhedron& solid, const CutOptions& options)
      : solid_(solid), options_(options), near_(solid), side_(longest_side(solid)) {
    tolerance_ =
        options.tolerance_mm > 0 ? options.tolerance_mm : std::max(min_tolerance_mm, tolerance_share * side_);
    watch_ = watch_points(solid, near_, watched_share * tolerance_);
    find_bores();
    std::erase_if(watch_, [&](const WatchPoint& w) { return is_ignored(w.at); });
  }

  std::vector<CutPiece> run() {
    std::vector<CutCell> cells{whole()};
    look_over(cells.front());
    while (static_cast<int>(cells.size()) < options_.max_pieces) {
      const auto worst = std::max_element(cells.begin(), cells.end(), [](const CutCell& a, const CutCell& b) {
        return weight(a) < weight(b);
      });
      if (weight(*worst) == 0) break;
      auto parts = best_cut(*worst);
      if (!parts) {
        worst->is_final = true;
        continue;
      }
      for (CutCell& part : *parts) look_over(part);
      *worst = std::move((*parts)[0]);
      cells.push_back(std::move((*parts)[1]));
    }
    std::vector<CutPiece> out;
    for (CutCell& cell : cells) out.push_back(std::move(cell.hull));
    return out;
  }

 private:
  /// Finds round hollows that are large for the solid, and their triangles.
  void find_bores() {
    for (const model::CylinderFace& face : model::cylinder_faces(solid_, model::bent_regions(solid_)))
      if (face.hollow && face.radius_mm > large_bore * side_) bores_.push_back(face);
    bore_of_.assign(solid_.triangles.size(), -1);
    for (std::size_t t = 0; t < bore_of_.size(); ++t) {
      const auto c = corners_of(solid_, static_cast<int>(t));
      for (std::size_t b = 0; b < bores_.size(); ++b)
        if (std::all_of(c.begin(), c.end(), [&](const Vector3d& p) { return lies_on(bores_[b], p); }))
          bore_of_[t] = static_cast<int>(b);
    }
  }

  static bool lies_on(const model::CylinderFace& bore, const Vector3d& p) {
    const Vector3d arm = p - bore.point;
    const double along = bore.axis.dot(arm), off = (arm - along * bore.axis).norm(),
                 slack = 0.01 * bore.radius_mm;
    const double at = bore.axis.dot(p);
    return at >= bore.from - slack && at <= bore.to + slack && off >= bore.inner_mm - slack &&
           off <= bore.radius_mm + slack;
  }

  static double weight(const CutCell& cell) { return cell.is_final ? 0 : cell.weight; }

  /// Adds watch points to a cell that has none: places on its hull that protrude.
  void look_over(CutCell& cell) {
    if (!cell.watched.empty()) return;
    Vector3d center = Vector3d::Zero();
    for (const Vector3d& p : cell.hull.corners) center += p / static_cast<double>(cell.hull.corners.size());
    for (const auto& face : cell.skin) {
      if (!((face[1] - face[0]).cross(face[2] - face[0]).norm() > tolerance_ * tolerance_)) continue;
      std::vector<Vector3d> places;
      add_over(face, looked_at * tolerance_, places);
      for (const Vector3d& place : places) {
        const Vector3d p = place + thinnest * (center - place);
        if (is_ignored(p) || !near_.is_farther_than(p, watched_share * tolerance_) || is_inside(solid_, p))
          continue;
        cell.watched.push_back(static_cast<int>(watch_.size()));
        cell.weight += 1;
        watch_.push_back({p, near_.nearest(p), 1});
      }
    }
  }

  bool is_ignored(const Vector3d& p) const {
    return std::any_of(options_.filled.begin(), options_.filled.end(),
                       [&](const FilledBore& bore) { return is_within(bore, p); });
  }

  CutCell whole() const {
    CutCell cell;
    for (int t = 0; t < static_cast<int>(solid_.triangles.size()); ++t) {
      const auto corners = corners_of(solid_, t);
      cell.surface.emplace_back(corners.begin(), corners.end());
    }
    std::vector<int> all(watch_.size());
    std::iota(all.begin(), all.end(), 0);
    close(cell, all);
    return cell;
  }

  /// Computes the hull of a cell and the watch points in it. @param among candidates for these
  void close(CutCell& cell, const std::vector<int>& among) const {
    std::vector<Vector3d> points = cell.inner;
    for (const CutPolygon& polygon : cell.surface)
      points.insert(points.end(), polygon.begin(), polygon.end());
    const auto key = [](const Vector3d& p) { return std::tuple(p.x(), p.y(), p.z()); };
    std::sort(points.begin(), points.end(),
              [&](const Vector3d& p, const Vector3d& q) { return key(p) < key(q); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    cell.skin.clear();
    cell.hull = hull_of(points, thinnest * side_, cell.skin);
    cell.watched = held(cell.hull, among);
    for (const int w : cell.watched) cell.weight += watch_[w].depth;
  }

  /// Returns the watch points inside a piece. Each face checks only those that passed the faces before it,
  /// since most points fail early.
  std::vector<int> held(const CutPiece& piece, std::vector<int> among) const {
    for (Eigen::Index f = 0; f < piece.faces.rows(); ++f) {
      const Vector3d normal = piece.faces.row(f).head<3>();
      const double offset = piece.faces(f, 3);
      std::erase_if(among, [&](int w) { return normal.dot(watch_[w].at) > offset; });
    }
    return among;
  }

  /// Adds corners of the cell inside the solid: intersections of three planes, one of them the last.
  void add_inner_corners(CutCell& cell) const {
    const std::size_t n = cell.planes.size();
    for (std::size_t i = 0; i + 1 < n; ++i)
      for (std::size_t j = i + 1; j + 1 < n; ++j) {
        Eigen::Matrix3d normals;
        normals << cell.planes[i].normal.transpose(), cell.planes[j].normal.transpose(),
            cell.planes[n - 1].normal.transpose();
        if (!(std::abs(normals.determinant()) > 1e-6)) continue;
        const Vector3d p = normals.inverse() *
                           Vector3d(cell.planes[i].offset, cell.planes[j].offset, cell.planes[n - 1].offset);
        const Vector3d inwards = -(cell.planes[i].normal + cell.planes[j].normal + cell.planes[n - 1].normal);
        if (keeps(cell, p) && near_.holds(p + 0.5 * thinnest * side_ * inwards)) cell.inner.push_back(p);
      }
  }

  bool keeps(const CutCell& cell, const Vector3d& p) const {
    return std::all_of(cell.planes.begin(), cell.planes.end(), [&](const CutPlane& plane) {
      return plane.normal.dot(p) <= plane.offset + on_plane * side_;
    });
  }

  bool has_room(const CutCell& cell, const CutPlane& plane) const {
    double least = std::numeric_limits<double>::infinity();
    for (const CutPolygon& polygon : cell.surface)
      for (const Vector3d& p : polygon) least = std::min(least, plane.normal.dot(p) - plane.offset);
    return least < -thinnest * side_;
  }

  std::optional<CutCell> half(const CutCell& cell, const CutPlane& plane) const {
    CutCell out;
    out.planes = cell.planes;
    out.planes.push_back(plane);
    for (const CutPolygon& polygon : cell.surface)
      if (CutPolygon part = clipped(polygon, plane, on_plane * side_); !part.empty())
        out.surface.push_back(std::move(part));
    for (const Vector3d& p : cell.inner)
      if (plane.normal.dot(p) <= plane.offset + on_plane * side_) out.inner.push_back(p);
    if (out.surface.empty() || !has_room(out, plane)) return std::nullopt;
    add_inner_corners(out);
    close(out, cell.watched);
    return out;
  }

  /// Returns planes of the faces below most watch points of a cell, and planes perpendicular to them.
  std::vector<CutPlane> candidates(const CutCell& cell) const {
    std::vector<std::pair<int, CutPlane>> faces;
    for (const int w : cell.watched) {
      const auto t = corners_of(solid_, watch_[w].triangle);
      const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
      const CutPlane plane{normal, normal.dot(t[0])};
      const auto known =
          std::find_if(faces.begin(), faces.end(), [&](const auto& f) { return is_same(f.second, plane); });
      if (known == faces.end())
        faces.push_back({1, plane});
      else
        ++known->first;
    }
    std::stable_sort(faces.begin(), faces.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<CutPlane> out;
    for (std::size_t k = 0; k < std::min(faces.size(), max_candidates / 2); ++k)
      out.push_back(faces[k].second);
    add_square_ones(cell, out);
    return out;
  }

  /// Adds planes through the middle of the cell's watch points and of its hull. They are perpendicular to the
  /// axes and the normals of the two fullest faces, or contain the direction of a fold.
  void add_square_ones(const CutCell& cell, std::vector<CutPlane>& out) const {
    Vector3d middle = Vector3d::Zero();
    for (const int w : cell.watched) middle += watch_[w].at / static_cast<double>(cell.watched.size());
    Vector3d center = Vector3d::Zero();
    for (const Vector3d& p : cell.hull.corners) center += p / static_cast<double>(cell.hull.corners.size());
    const std::size_t faces = out.size();
    std::vector<Vector3d> normals;
    for (std::size_t k = 0; k < std::min<std::size_t>(faces, 2); ++k) normals.push_back(out[k].normal);
    for (int k = 0; k < 3; ++k) normals.emplace_back(Vector3d::Unit(k));
    if (normals.size() >= 2 && faces >= 1) {
      const Vector3d along = fold_direction(cell);
      if (along.norm() > 0) normals.push_back(along.cross(normals[0]).normalized());
    }
    for (const Vector3d& n : normals)
      for (const Vector3d& through : {middle, center}) {
        const CutPlane plane{n, n.dot(through)};
        if (n.allFinite() &&
            std::none_of(out.begin(), out.end(), [&](const CutPlane& p) { return is_same(p, plane); }))
          out.push_back(plane);
      }
  }

  /// Returns the direction most nearly perpendicular to the normals below the watch points: along a bore.
  Vector3d fold_direction(const CutCell& cell) const {
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const int w : cell.watched) {
      const auto t = corners_of(solid_, watch_[w].triangle);
      const Vector3d n = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
      spread += n * n.transpose();
    }
    return principal_axes(spread).axes.col(0);
  }

  bool is_same(const CutPlane& a, const CutPlane& b) const {
    const double sign = a.normal.dot(b.normal) > 0 ? 1 : -1;
    return (a.normal - sign * b.normal).norm() < same_plane &&
           std::abs(a.offset - sign * b.offset) < same_plane * side_;
  }

  /// Returns a cut at a bore if that has most of the cell's watch weight. It is first at an end of the bore,
  /// then through its axis and the middle of its points.
  std::optional<CutPlane> cut_at_bore(const CutCell& cell) const {
    std::vector<double> weights(bores_.size(), 0);
    for (const int w : cell.watched)
      if (const int b = bore_of_[watch_[w].triangle]; b >= 0) weights[b] += watch_[w].depth;
    for (std::size_t b = 0; b < bores_.size(); ++b)
      if (weights[b] > cell.weight / 2) {
        if (const auto end = cut_at_end(cell, bores_[b])) return end;
        return cut_along(cell, static_cast<int>(b));
      }
    return std::nullopt;
  }

  std::optional<CutPlane> cut_at_end(const CutCell& cell, const model::CylinderFace& bore) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vector3d& p : cell.hull.corners) {
      low = std::min(low, bore.axis.dot(p));
      high = std::max(high, bore.axis.dot(p));
    }
    if (low < bore.from - tolerance_) return CutPlane{bore.axis, bore.from};
    if (high > bore.to + tolerance_) return CutPlane{bore.axis, bore.to};
    return std::nullopt;
  }

  std::optional<CutPlane> cut_along(const CutCell& cell, int bore) const {
    const model::CylinderFace& face = bores_[bore];
    const Vector3d u = face.axis.unitOrthogonal(), v = face.axis.cross(u);
    std::vector<double> angles;
    for (const int w : cell.watched)
      if (bore_of_[watch_[w].triangle] == bore) {
        const Vector3d arm = watch_[w].at - face.point;
        angles.push_back(std::atan2(v.dot(arm), u.dot(arm)));
      }
    std::sort(angles.begin(), angles.end());
    std::size_t first = 0;  // after the widest gap
    double gap = angles.front() + 2 * pi - angles.back();
    for (std::size_t k = 1; k < angles.size(); ++k)
      if (angles[k] - angles[k - 1] > gap) {
        gap = angles[k] - angles[k - 1];
        first = k;
      }
    const double middle = angles[first] + (2 * pi - gap) / 2;
    const Vector3d normal = -std::sin(middle) * u + std::cos(middle) * v;
    return CutPlane{normal, normal.dot(face.point)};
  }

  std::optional<std::array<CutCell, 2>> halves(const CutCell& cell, const CutPlane& plane) const {
    auto below = half(cell, plane), above = half(cell, {-plane.normal, -plane.offset});
    if (!below || !above) return std::nullopt;
    return std::array<CutCell, 2>{std::move(*below), std::move(*above)};
  }

  std::optional<std::array<CutCell, 2>> best_cut(const CutCell& cell) const {
    if (const auto plane = cut_at_bore(cell))
      if (auto parts = halves(cell, *plane)) return parts;
    std::optional<std::array<CutCell, 2>> best;
    double least = cell.weight;
    for (const CutPlane& plane : candidates(cell)) {
      auto below = half(cell, plane);
      if (!below || below->weight > least) continue;
      auto above = half(cell, {-plane.normal, -plane.offset});
      if (!above) continue;
      const double left = below->weight + above->weight;
      if (left > least || (left == least && best)) continue;
      least = left;
      best = {std::move(*below), std::move(*above)};
    }
    return best;
  }

  const Polyhedron& solid_;
  const CutOptions options_;
  const NearSolid near_;
  const double side_;
  double tolerance_ = 0;
  std::vector<WatchPoint> watch_;
  std::vector<model::CylinderFace> bores_;
  std::vector<int> bore_of_;  // by triangle; -1: none
};

}  // namespace

std::vector<CutPiece> convex_cuts(const Polyhedron& solid, const CutOptions& options) {
  require("tolerance_mm", options.tolerance_mm, options.tolerance_mm >= 0, "at least 0, mm");
  require("most_pieces", options.max_pieces, options.max_pieces >= 1, "at least 1");
  return Cutter(solid, options).run();
}

}  // namespace kinetix::sim
