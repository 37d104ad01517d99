#pragma once

#include "model/lattice/origami/fold_mesh.hpp"
#include "model/lattice/square/numbering.hpp"
#include "optim/solvers/least_squares.hpp"
#include "optim/surface/surface_variables.hpp"
#include "targets/surface/surface_patch.hpp"

namespace kinetix::optim {

/// Limits of a mesh. A search aims a little inside.
struct MeshBounds {
  std::array<double, 2> sector = {50 * radians_per_degree,
                                  130 * radians_per_degree};  ///< rad: bodies fit round vertices
  std::array<double, 2> edge = {0.6, 1.5};                    ///< of the mean edge, > 0
  /// Largest tan(rho / 2) of a crease: tan(largest tilt) sin(theta), dimensionless, > 0.
  double multiplier = 1.79;
  /// Smallest tan(rho / 2), dimensionless, < multiplier. Creases that do not fold at all determine nothing.
  double least_fold = 0.03;
};

/// Fit of a folded mesh to a surface. The residuals are the distances of its vertices from the surface's two
/// layers, the distance of its rim from the surface's, and the violations of bounds. The distances from the
/// layers are over the diagonal and the root of their number.
class SurfaceProblem final : public LeastSquaresProblem {
 public:
  /// @param rim weight of the rim's distances relative to those from the layers
  SurfaceProblem(const targets::SurfacePatch& patch, const SurfaceVariables& variables,
                 const MeshBounds& bounds, double rim);

  int variables() const override { return variables_.size(); }
  int residuals() const override { return residuals_; }
  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  bool evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* J) const override;

 private:
  template <class T>
  void fill(const T* x, T* r) const;
  template <class T, class Out>
  void add_extent(const std::vector<Eigen::Matrix<T, 3, 1>>& vertices, Out& out) const;

  targets::SurfacePatch patch_;
  const SurfaceVariables& variables_;
  MeshBounds bounds_;
  double rim_, diagonal_;
  int residuals_ = 0;
  Eigen::VectorXd lower_, upper_;
};

/// Returns the vertices of the mesh at x, folded and in place, mm.
std::vector<Eigen::Vector3d> placed_vertices(const SurfaceVariables& variables, const Eigen::VectorXd& x);

/// Returns the layer of vertex (i, j): 1 above, -1 below.
inline int layer_of(int i) { return -model::column_sign(i); }

}  // namespace kinetix::optim
