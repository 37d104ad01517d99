#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <vector>

namespace kinetix::model {

/// A flat crease pattern of columns x rows quadrilateral facets, with the fold of each crease. At theta a crease
/// folds by rho with tan(rho / 2) = c sin(theta). Its fold multiplier c is positive if the facets next to it rise (a
/// valley seen from above). The unit of length is that of its source. T: double, or dual numbers.
template <class T>
struct QuadMeshOf {
  using Vector2 = Eigen::Matrix<T, 2, 1>;

  int columns = 0, rows = 0;      ///< numbers of facets, >= 1
  std::vector<Vector2> vertices;  ///< (columns + 1) x (rows + 1), row by row: vertex (i, j) at vertex(i, j)
  std::vector<T> rising;  ///< multipliers of (i, j) - (i, j + 1), 0 < i < columns: at rising_crease(i, j)
  std::vector<T> level;   ///< multipliers of (i, j) - (i + 1, j), 0 < j < rows: at level_crease(i, j)

  std::size_t vertex(int i, int j) const { return static_cast<std::size_t>(j) * (columns + 1) + i; }
  std::size_t facet(int i, int j) const { return static_cast<std::size_t>(j) * columns + i; }
  std::size_t rising_crease(int i, int j) const {
    return static_cast<std::size_t>(j) * (columns - 1) + i - 1;
  }
  std::size_t level_crease(int i, int j) const { return static_cast<std::size_t>(j - 1) * columns + i; }

  const Vector2& at(int i, int j) const { return vertices[vertex(i, j)]; }
  Vector2& at(int i, int j) { return vertices[vertex(i, j)]; }
};
using QuadMesh = QuadMeshOf<double>;

/// Returns the number of edges of a mesh of columns x rows facets.
inline int mesh_edges(int columns, int rows) { return columns * (rows + 1) + rows * (columns + 1); }

/// Returns a mesh of columns x rows facets, all zero.
template <class T>
QuadMeshOf<T> empty_mesh(int columns, int rows) {
  QuadMeshOf<T> mesh;
  mesh.columns = columns;
  mesh.rows = rows;
  mesh.vertices.assign(static_cast<std::size_t>(columns + 1) * (rows + 1), QuadMeshOf<T>::Vector2::Zero());
  mesh.rising.assign(static_cast<std::size_t>(columns - 1) * rows, T(0));
  mesh.level.assign(static_cast<std::size_t>(columns) * (rows - 1), T(0));
  return mesh;
}

/// Returns the four angles between the creases of an inner vertex, rad. They are counter-clockwise from the one
/// between the level crease to the right and the rising crease above. @pre 0 < i < columns, 0 < j < rows
Eigen::Vector4d sectors(const QuadMesh& mesh, int i, int j);

/// Checks that a mesh is rigidly and flat-foldable with its multipliers.
/// @throws InvalidInput, naming vertex or facet. Sectors must be in (0, pi), and opposite ones must add up to pi.
/// Facets must be convex and not turned over. Multipliers must close around each vertex. All numbers must be finite
void validate(const QuadMesh& mesh);

/// Returns the mean length of all edges.
double mean_edge(const QuadMesh& mesh);

/// A folded mesh: its vertices and the rotations of its facets. Facet (0, 0) does not move.
template <class T>
struct FoldedMeshOf {
  std::vector<Eigen::Matrix<T, 3, 1>> vertices;  ///< in the order and unit of the mesh
  std::vector<Eigen::Matrix<T, 3, 3>> frames;    ///< rotation of each facet from flat
};
using FoldedMesh = FoldedMeshOf<double>;

/// Returns the rotation by rho about a direction in the plane. @param half tan(rho / 2)
template <class T>
Eigen::Matrix<T, 3, 3> crease_rotation(const Eigen::Matrix<T, 2, 1>& along, const T& half) {
  using std::sqrt;
  const T length = sqrt(along.squaredNorm());
  const T x = along.x() / length, y = along.y() / length;
  const T c = (T(1) - half * half) / (T(1) + half * half), s = T(2) * half / (T(1) + half * half);
  const T o = T(1) - c;
  Eigen::Matrix<T, 3, 3> R;
  R << c + x * x * o, x * y * o, y * s, x * y * o, c + y * y * o, -x * s, -y * s, x * s, c;
  return R;
}

namespace fold_detail {

template <class T>
std::vector<Eigen::Matrix<T, 3, 3>> frames(const QuadMeshOf<T>& m, const T& tau) {
  std::vector<Eigen::Matrix<T, 3, 3>> R(static_cast<std::size_t>(m.columns) * m.rows);
  R[0].setIdentity();
  for (int i = 1; i < m.columns; ++i)
    R[m.facet(i, 0)] = R[m.facet(i - 1, 0)] *
                       crease_rotation<T>(m.at(i, 1) - m.at(i, 0), -m.rising[m.rising_crease(i, 0)] * tau);
  for (int j = 1; j < m.rows; ++j)
    for (int i = 0; i < m.columns; ++i)
      R[m.facet(i, j)] = R[m.facet(i, j - 1)] *
                         crease_rotation<T>(m.at(i + 1, j) - m.at(i, j), m.level[m.level_crease(i, j)] * tau);
  return R;
}

}  // namespace fold_detail

/// Folds a mesh. Facets turn about the creases of the first column and of all rows: exact if the mesh is
/// flat-foldable.
/// @param tau sin(theta)
template <class T>
FoldedMeshOf<T> fold_facets(const QuadMeshOf<T>& m, const T& tau) {
  FoldedMeshOf<T> out;
  out.frames = fold_detail::frames(m, tau);
  out.vertices.assign(m.vertices.size(), Eigen::Matrix<T, 3, 1>::Zero());
  const auto carry = [&](int facet_i, int facet_j, int i, int j, int to_i, int to_j) {
    const Eigen::Matrix<T, 2, 1> edge = m.at(to_i, to_j) - m.at(i, j);
    const auto& R = out.frames[m.facet(facet_i, facet_j)];
    out.vertices[m.vertex(to_i, to_j)] =
        out.vertices[m.vertex(i, j)] + R.col(0) * edge.x() + R.col(1) * edge.y();
  };
  out.vertices[0] = {m.vertices[0].x(), m.vertices[0].y(), T(0)};
  for (int i = 0; i < m.columns; ++i) carry(i, 0, i, 0, i + 1, 0);
  for (int j = 0; j < m.rows; ++j) {
    for (int i = 0; i < m.columns; ++i) carry(i, j, i, j, i, j + 1);
    carry(m.columns - 1, j, m.columns, j, m.columns, j + 1);
  }
  return out;
}

/// Returns the largest disagreement of facets about shared corners and creases: distance over the mean edge, or entry
/// of the difference of rotations.
double fold_gap(const QuadMesh& mesh, double theta);

}  // namespace kinetix::model
