#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace kinetix::model {

/// A crease pattern of columns x rows quadrilateral facets, flat, and how far each crease folds: at theta by rho with
/// tan(rho / 2) = c sin(theta), c its fold multiplier, positive where the facets beside it rise (a valley seen from
/// above). Lengths in whatever unit its maker says. T: double, or dual numbers.
template <class T>
struct QuadMeshOf {
  using Vector2 = Eigen::Matrix<T, 2, 1>;

  int columns = 0, rows = 0;      ///< of facets, >= 1
  std::vector<Vector2> vertices;  ///< (columns + 1) x (rows + 1), row by row: vertex (i, j) at vertex(i, j)
  std::vector<T>
      rising;  ///< multipliers of the creases (i, j) - (i, j + 1), 0 < i < columns: at rising_crease(i, j)
  std::vector<T> level;  ///< likewise of (i, j) - (i + 1, j), 0 < j < rows: at level_crease(i, j)

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

/// Edges of a mesh of columns x rows facets.
inline int mesh_edges(int columns, int rows) { return columns * (rows + 1) + rows * (columns + 1); }

/// Room for columns x rows facets, all zero.
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

/// The four angles between the creases of an inner vertex, rad, counter-clockwise from the one between the level
/// crease to the right and the rising crease above. @pre 0 < i < columns, 0 < j < rows
Eigen::Vector4d sectors(const QuadMesh& mesh, int i, int j);

/// @throws InvalidInput, naming vertex or facet, for a mesh that is not rigidly and flat-foldable as its multipliers
/// say: sectors outside (0, pi) or whose opposite ones do not add up to pi, facets that are turned over or not convex,
/// multipliers that do not close round a vertex; and for numbers that are not finite
void validate(const QuadMesh& mesh);

/// Mean length of all edges.
double mean_edge(const QuadMesh& mesh);

}  // namespace kinetix::model
