#pragma once

#include <Eigen/Core>
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

}  // namespace kinetix::model
