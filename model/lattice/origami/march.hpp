#pragma once

#include <array>

#include "model/base/geometry.hpp"
#include "model/lattice/origami/quad_mesh.hpp"

namespace kinetix::model {

/// Boundary data that determine a flat-foldable quadrilateral mesh (kinematics.md section 6, "marching"): on its left
/// column and bottom row of inner vertices, and distances from there to the boundary. There are p = columns - 1 by q
/// = rows - 1 inner vertices.
template <class T>
struct MarchDataOf {
  /// The p multipliers of the rising crease lines, where they leave the bottom row upwards
  std::vector<T> rising;
  std::vector<T> level;  ///< q multipliers of the level ones, where they leave the left column to the right
  std::vector<T> left_angle;     ///< q, rad, (0, pi): from the level crease to the rising one, left column
  std::vector<T> bottom_angle;   ///< p, rad, (0, pi): same, bottom row; [0] is left_angle[0], not read
  std::vector<T> bottom_length;  ///< p - 1 lengths between the inner vertices of the bottom row, > 0
  std::vector<T> left_length;    ///< q - 1 lengths between the inner vertices of the left column, > 0
  std::vector<T> west, east;     ///< q lengths each, from the outer inner vertices to the boundary, > 0
  std::vector<T> south, north;   ///< p lengths each, from the outer inner vertices to the boundary, > 0.
  /// Shifts of the corners from those of parallelograms: lower left, lower right, upper left, upper right.
  std::array<Eigen::Matrix<T, 2, 1>, 4> corners = no_corners();

  static std::array<Eigen::Matrix<T, 2, 1>, 4> no_corners() {
    const Eigen::Matrix<T, 2, 1> zero(T(0), T(0));
    return {zero, zero, zero, zero};
  }
};
using MarchData = MarchDataOf<double>;

/// An inner vertex on the march. Its creases point right, up, left and down at phi, phi + a, phi + a + b, phi + pi + b.
template <class T>
struct MarchVertex {
  T a = T(0), b = T(0), phi = T(0);                     ///< rad
  T right = T(0), up = T(0), left = T(0), down = T(0);  ///< multipliers
};

/// The mesh, and the inner vertices of its march.
template <class T>
struct MarchedMesh {
  QuadMeshOf<T> mesh;
  std::vector<MarchVertex<T>> inner;  ///< (columns - 1) x (rows - 1), row by row

  const MarchVertex<T>& at(int i, int j) const {
    return inner[static_cast<std::size_t>(j) * (mesh.columns - 1) + i];
  }
};

namespace march_detail {

template <class T>
Eigen::Matrix<T, 2, 1> direction(const T& angle) {
  using std::cos, std::sin;
  return {cos(angle), sin(angle)};
}

template <class T>
T cross(const Eigen::Matrix<T, 2, 1>& a, const Eigen::Matrix<T, 2, 1>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// One march from the lower left vertex.
template <class T>
class March {
 public:
  using Vector2 = Eigen::Matrix<T, 2, 1>;

  explicit March(const MarchDataOf<T>& data)
      : data_(data), p_(static_cast<int>(data.rising.size())), q_(static_cast<int>(data.level.size())) {
    out_.mesh = empty_mesh<T>(p_ + 1, q_ + 1);
    out_.inner.resize(static_cast<std::size_t>(p_) * q_);
  }

  MarchedMesh<T> run() {
    for (int j = 0; j < q_; ++j)
      for (int i = 0; i < p_; ++i) step(i, j);
    add_boundary();
    add_multipliers();
    return std::move(out_);
  }

 private:
  MarchVertex<T>& vertex(int i, int j) { return out_.inner[static_cast<std::size_t>(j) * p_ + i]; }
  Vector2& point(int i, int j) { return out_.mesh.at(i + 1, j + 1); }

  void step(int i, int j) {
    MarchVertex<T>& v = vertex(i, j);
    set_multipliers(i, j, v);
    v.a = i == 0   ? data_.left_angle[j]
          : j == 0 ? data_.bottom_angle[i]
                   : vertex(i - 1, j - 1).a + vertex(i, j - 1).b - vertex(i - 1, j).b;
    v.b = second_angle(i, j, v);
    if (i == 0 && j == 0) return;
    v.phi =
        j == 0 ? vertex(i - 1, 0).phi + T(pi) - v.a - v.b : vertex(i, j - 1).phi + vertex(i, j - 1).a - v.b;
    place(i, j);
  }

  /// Returns true if the level crease folds less than the rising one. Its sign then flips at the vertex, otherwise
  /// the other's.
  bool level_flips(int i, int j) const {
    using std::abs;
    return abs(data_.level[j]) < abs(data_.rising[i]);
  }

  void set_multipliers(int i, int j, MarchVertex<T>& v) {
    const bool flips = level_flips(i, j);
    if (i == 0) {
      v.right = data_.level[j];
      v.left = flips ? T(-v.right) : v.right;
    } else {
      v.left = vertex(i - 1, j).right;
      v.right = flips ? T(-v.left) : v.left;
    }
    if (j == 0) {
      v.up = data_.rising[i];
      v.down = flips ? v.up : T(-v.up);
    } else {
      v.down = vertex(i, j - 1).up;
      v.up = flips ? v.down : T(-v.down);
    }
  }

  T second_angle(int i, int j, const MarchVertex<T>& v) const {
    using std::atan, std::tan;
    const T half = tan(v.a / T(2));
    if (level_flips(i, j)) {
      const T ratio = v.right / v.up;
      return T(2) * atan(half * (T(1) - ratio) / (T(1) + ratio));
    }
    const T ratio = v.up / v.right;
    return T(2) * atan((T(1) + ratio) / ((T(1) - ratio) * half));
  }

  /// Places a vertex along the row, up the column, or at the intersection of the creases of both neighbours.
  void place(int i, int j) {
    if (j == 0) {
      point(i, 0) = point(i - 1, 0) + data_.bottom_length[i - 1] * direction(vertex(i - 1, 0).phi);
      return;
    }
    const Vector2 up = direction<T>(vertex(i, j - 1).phi + vertex(i, j - 1).a);
    if (i == 0) {
      point(0, j) = point(0, j - 1) + data_.left_length[j - 1] * up;
      return;
    }
    const Vector2 right = direction(vertex(i - 1, j).phi);
    const Vector2 between = point(i - 1, j) - point(i, j - 1);
    point(i, j) = point(i, j - 1) + cross(between, right) / cross(up, right) * up;
  }

  void add_boundary() {
    QuadMeshOf<T>& m = out_.mesh;
    const int n = m.columns, r = m.rows;
    for (int j = 0; j < q_; ++j) {
      const MarchVertex<T>&first = vertex(0, j), &last = vertex(p_ - 1, j);
      m.at(0, j + 1) = point(0, j) + data_.west[j] * direction<T>(first.phi + first.a + first.b);
      m.at(n, j + 1) = point(p_ - 1, j) + data_.east[j] * direction(last.phi);
    }
    for (int i = 0; i < p_; ++i) {
      const MarchVertex<T>&first = vertex(i, 0), &last = vertex(i, q_ - 1);
      m.at(i + 1, 0) = point(i, 0) + data_.south[i] * direction<T>(first.phi + T(pi) + first.b);
      m.at(i + 1, r) = point(i, q_ - 1) + data_.north[i] * direction<T>(last.phi + last.a);
    }
    m.at(0, 0) = m.at(0, 1) + m.at(1, 0) - m.at(1, 1) + data_.corners[0];
    m.at(n, 0) = m.at(n, 1) + m.at(n - 1, 0) - m.at(n - 1, 1) + data_.corners[1];
    m.at(0, r) = m.at(0, r - 1) + m.at(1, r) - m.at(1, r - 1) + data_.corners[2];
    m.at(n, r) = m.at(n, r - 1) + m.at(n - 1, r) - m.at(n - 1, r - 1) + data_.corners[3];
  }

  void add_multipliers() {
    QuadMeshOf<T>& m = out_.mesh;
    for (int i = 0; i < p_; ++i)
      for (int j = 0; j <= q_; ++j)
        m.rising[m.rising_crease(i + 1, j)] = j == 0 ? vertex(i, 0).down : vertex(i, j - 1).up;
    for (int j = 0; j < q_; ++j)
      for (int i = 0; i <= p_; ++i)
        m.level[m.level_crease(i, j + 1)] = i == 0 ? vertex(0, j).left : vertex(i - 1, j).right;
  }

  const MarchDataOf<T>& data_;
  int p_, q_;
  MarchedMesh<T> out_;
};

}  // namespace march_detail

/// Computes the mesh from its boundary data. The lower left inner vertex is at the origin with its level crease along
/// +x. Corners complete parallelograms, plus the shifts in the data. The result is smooth in the data if no |level|
/// passes a |rising|.
/// The data are not checked. If they lead to angles outside (0, pi) or lines that cross, validate() of the mesh
/// reports it.
/// @pre at least one inner vertex, and lists of the sizes in MarchData
template <class T>
MarchedMesh<T> march(const MarchDataOf<T>& data) {
  return march_detail::March<T>(data).run();
}

/// Returns the data of a regular Miura sheet: all edges are 1.
/// @param columns, rows numbers of facets, >= 2   @param angle of its parallelograms, rad, (0, pi / 2)
/// @param multiplier of its rising creases, > 0; the level ones have cos(angle) times it
inline MarchData miura(int columns, int rows, double angle, double multiplier) {
  const int p = columns - 1, q = rows - 1;
  MarchData d;
  for (int i = 0; i < p; ++i) d.rising.push_back(i % 2 == 0 ? multiplier : -multiplier);
  for (int j = 0; j < q; ++j) {
    d.level.push_back((j % 2 == 0 ? -1 : 1) * std::cos(angle) * multiplier);
    d.left_angle.push_back(j % 2 == 0 ? angle : pi - angle);
  }
  for (int i = 0; i < p; ++i) d.bottom_angle.push_back(angle);
  d.bottom_length.assign(p - 1, 1);
  d.left_length.assign(q - 1, 1);
  d.west.assign(q, 1);
  d.east.assign(q, 1);
  d.south.assign(p, 1);
  d.north.assign(p, 1);
  return d;
}

}  // namespace kinetix::model
