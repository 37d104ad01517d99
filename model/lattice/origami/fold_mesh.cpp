#include "model/lattice/origami/fold_mesh.hpp"

#include <algorithm>

namespace kinetix::model {
namespace {

/// Returns the largest distance of a facet's three other corners from their positions by its first corner and frame.
double corner_gap(const QuadMesh& m, const FoldedMesh& folded, int i, int j) {
  double gap = 0;
  const Eigen::Matrix3d& R = folded.frames[m.facet(i, j)];
  for (const auto& [u, v] : {std::pair(i + 1, j), std::pair(i, j + 1), std::pair(i + 1, j + 1)}) {
    const Eigen::Vector2d edge = m.at(u, v) - m.at(i, j);
    const Eigen::Vector3d carried = folded.vertices[m.vertex(i, j)] + R.leftCols<2>() * edge;
    gap = std::max(gap, (folded.vertices[m.vertex(u, v)] - carried).norm());
  }
  return gap;
}

double frame_gap(const QuadMesh& m, const FoldedMesh& folded, double tau, int i, int j) {
  const Eigen::Vector2d crease = m.at(i, j + 1) - m.at(i, j);
  const Eigen::Matrix3d turned = folded.frames[m.facet(i - 1, j)] *
                                 crease_rotation<double>(crease, -m.rising[m.rising_crease(i, j)] * tau);
  return (folded.frames[m.facet(i, j)] - turned).cwiseAbs().maxCoeff();
}

}  // namespace

double fold_gap(const QuadMesh& m, double theta) {
  const double tau = std::sin(theta), unit = mean_edge(m);
  const FoldedMesh folded = fold_facets(m, tau);
  double gap = 0;
  for (int j = 0; j < m.rows; ++j)
    for (int i = 0; i < m.columns; ++i) {
      gap = std::max(gap, corner_gap(m, folded, i, j) / unit);
      if (i > 0) gap = std::max(gap, frame_gap(m, folded, tau, i, j));
    }
  return gap;
}

}  // namespace kinetix::model
