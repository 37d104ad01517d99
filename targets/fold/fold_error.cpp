#include "targets/fold/fold_error.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace kinetix::targets {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

/// Distance of the last vertices of two faces across a fold, in pitches.
double chord(double angle, int columns) {
  if (std::abs(angle) < 1e-12) return columns;
  return std::sin(angle / 2) / std::tan(angle / (2 * columns));
}

/// A plane with the lattice on it: columns of `axes` are the lattice's x and y and the normal.
struct FacePlane {
  Matrix3d axes = Matrix3d::Identity();
  Vector3d origin = Vector3d::Zero();  ///< of lattice vertex (0, 0)

  /// @param place cell edges   @param pitch mm
  Vector3d at(const Vector3d& place, double pitch) const {
    return origin + pitch * (place.x() * axes.col(0) + place.y() * axes.col(1));
  }
};

/// Returns the plane beyond a crease. @param side of the crease towards it
FacePlane beyond(const FacePlane& from, const PlacedCrease& crease, double angle, Side side, double pitch) {
  const int along = crease.axis == model::Axis::x ? 0 : 1;
  const double sign = is_upper(side) ? 1 : -1;
  const Vector3d e = sign * from.axes.col(along), n = from.axes.col(2);
  FacePlane to = from;
  to.axes.col(along) = sign * (std::cos(angle) * e + std::sin(angle) * n);
  to.axes.col(2) = std::cos(angle) * n - std::sin(angle) * e;
  const Vector3d across = std::cos(angle / 2) * e + std::sin(angle / 2) * n;
  const Vector3d near = rest_place(crease.cells.corner(opposite(side))),
                 far = rest_place(crease.cells.corner(side));
  to.origin += from.at(near, pitch) + pitch * chord(angle, crease.columns()) * across - to.at(far, pitch);
  return to;
}

std::vector<FacePlane> face_planes(const FoldNet& net, const NetLayout& layout, double pitch) {
  std::vector<FacePlane> planes(net.faces.size());
  std::vector<bool> placed(net.faces.size(), false);
  placed[0] = true;
  for (std::size_t round = 1; round < planes.size(); ++round)
    for (std::size_t k = 0; k < net.creases.size(); ++k) {
      const FoldCrease& c = net.creases[k];
      if (placed[c.first] == placed[c.second]) continue;
      const bool along = placed[c.first];
      const int from = along ? c.first : c.second, to = along ? c.second : c.first;
      const Side side = along ? c.side : opposite(c.side);
      planes[to] = beyond(planes[from], layout.creases[k], c.angle, side, pitch);
      placed[to] = true;
    }
  return planes;
}

Matrix3Xd positions(const std::vector<int>& bodies, const model::State& state) {
  Matrix3Xd out(3, bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) out.col(static_cast<Eigen::Index>(k)) = state[bodies[k]].p;
  return out;
}

/// Returns the mean directions of a face's lattice lines, and the normal.
Matrix3d mean_axes(const model::CellRectangle& face, const Matrix3Xd& p) {
  Vector3d ex = Vector3d::Zero(), ey = Vector3d::Zero();
  for (const auto& [first, last] : line_ends(face, model::Axis::x)) ex += p.col(last) - p.col(first);
  for (const auto& [first, last] : line_ends(face, model::Axis::y)) ey += p.col(last) - p.col(first);
  Matrix3d axes;
  axes << ex.normalized(), ey.normalized(), ex.cross(ey).normalized();
  return axes;
}

/// Adds full turns to the angle, so that it is nearest to `wanted`.
double nearest_turn(double angle, double wanted) {
  return angle + 2 * pi * std::round((wanted - angle) / (2 * pi));
}

double fold_angle(const FoldCrease& crease, const Matrix3d& first, const Matrix3d& second) {
  const bool along_x = across(crease.side) == model::Axis::x;
  const Vector3d line =
      along_x ? Vector3d(-(first.col(1) + second.col(1))) : Vector3d(first.col(0) + second.col(0));
  const double sign = is_upper(crease.side) ? 1 : -1;
  const double angle = std::atan2(sign * first.col(2).cross(second.col(2)).dot(line.normalized()),
                                  first.col(2).dot(second.col(2)));
  return nearest_turn(angle, crease.angle);
}

}  // namespace

double edge_inset(double angle, int columns) {
  if (std::abs(angle) < 1e-12) return columns / 2.0;
  return std::tan(angle / 2) / std::tan(angle / (2 * columns)) / 2;
}

std::vector<Matrix3Xd> ideal_faces(const FoldNet& net, const NetLayout& layout, double pitch) {
  const std::vector<FacePlane> planes = face_planes(net, layout, pitch);
  std::vector<Matrix3Xd> faces;
  for (std::size_t f = 0; f < planes.size(); ++f) {
    const auto vertices = layout.faces[f].rows_of_vertices();
    Matrix3Xd& p = faces.emplace_back(3, vertices.size());
    Eigen::Index k = 0;
    for (const auto& vertex : vertices) p.col(k++) = planes[f].at(rest_place(vertex), pitch);
  }
  return faces;
}

int open_crease(const FoldNet& net, const NetLayout& layout) {
  constexpr double closed = 1e-9;
  for (const double share : {0.5, 1.0}) {
    FoldNet folding = net;
    for (FoldCrease& crease : folding.creases) crease.angle *= share;
    const std::vector<FacePlane> planes = face_planes(folding, layout, 1.0);
    for (std::size_t k = 0; k < net.creases.size(); ++k) {
      const FoldCrease& c = folding.creases[k];
      const FacePlane asked = beyond(planes[c.first], layout.creases[k], c.angle, c.side, 1.0);
      const FacePlane& placed = planes[c.second];
      if ((asked.axes - placed.axes).norm() + (asked.origin - placed.origin).norm() >
          closed * static_cast<double>(layout.cells.size()))
        return static_cast<int>(k);
    }
  }
  return -1;
}

std::vector<IdealPoint> ideal_vertices(const FoldNet& net, const NetLayout& layout,
                                       const model::Structure& structure, const model::State& state,
                                       double theta) {
  const std::vector<Matrix3Xd> ideal = ideal_faces(net, layout, structure.size.edge_mm * std::cos(theta));
  std::vector<IdealPoint> vertices;
  for (std::size_t f = 0; f < ideal.size(); ++f) {
    const std::vector<int> bodies = bodies_of(layout.faces[f], structure);
    for (std::size_t k = 0; k < bodies.size(); ++k)
      vertices.push_back({bodies[k], ideal[f].col(static_cast<Eigen::Index>(k))});
  }
  Matrix3Xd from(3, vertices.size()), to(3, vertices.size());
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    from.col(static_cast<Eigen::Index>(k)) = vertices[k].place;
    to.col(static_cast<Eigen::Index>(k)) = state[vertices[k].body].p;
  }
  const Eigen::Matrix4d motion = rigid_fit(from, to);
  for (IdealPoint& v : vertices)
    v.place = motion.topLeftCorner<3, 3>() * v.place + motion.topRightCorner<3, 1>();
  return vertices;
}

FoldError fold_error(const FoldNet& net, const NetLayout& layout, const model::Structure& structure,
                     const model::State& state, double theta) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double pitch = structure.size.edge_mm * std::cos(theta);
  const std::size_t count = net.faces.size();
  if (!is_finite(state))
    return {std::vector<double>(net.creases.size(), nan), std::vector<double>(count, nan), nan};
  const std::vector<Matrix3Xd> ideal = ideal_faces(net, layout, pitch);
  std::vector<Matrix3Xd> actual;
  std::vector<Matrix3d> axes;
  Eigen::Index vertices = 0;
  for (const model::CellRectangle& face : layout.faces) {
    actual.push_back(positions(bodies_of(face, structure), state));
    axes.push_back(mean_axes(face, actual.back()));
    vertices += actual.back().cols();
  }
  Matrix3Xd from(3, vertices), to(3, vertices);
  for (Eigen::Index f = 0, at = 0; f < static_cast<Eigen::Index>(count); at += actual[f].cols(), ++f) {
    from.middleCols(at, actual[f].cols()) = actual[f];
    to.middleCols(at, actual[f].cols()) = ideal[f];
  }
  const Eigen::Matrix4d motion = rigid_fit(from, to);
  FoldError error;
  for (const FoldCrease& c : net.creases) error.fold.push_back(fold_angle(c, axes[c.first], axes[c.second]));
  double sum = 0;
  for (std::size_t f = 0; f < count; ++f) {
    const Matrix3Xd moved =
        (motion.topLeftCorner<3, 3>() * actual[f]).colwise() + motion.topRightCorner<3, 1>();
    const double side = pitch * (layout.faces[f].width + layout.faces[f].height) / 2.0;
    const double mean = (moved - ideal[f]).colwise().squaredNorm().mean() / (side * side);
    error.face_rms.push_back(std::sqrt(mean));
    sum += mean * static_cast<double>(actual[f].cols());
  }
  error.rms = std::sqrt(sum / static_cast<double>(vertices));
  return error;
}

}  // namespace kinetix::targets
