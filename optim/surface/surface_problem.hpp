#pragma once

#include "model/lattice/origami/march.hpp"
#include "model/lattice/origami/quad_mesh.hpp"
#include "model/lattice/square/structure.hpp"
#include "optim/solvers/solver.hpp"
#include "targets/surface/surface_patch.hpp"

namespace kinetix::optim {

/// Variables of a search for a surface, in the order of its vector x.
/// - Logarithms of the magnitudes of the fold multipliers times sin(theta).
/// - Angles, rad.
/// - Lengths over `unit`.
/// - Half distance of the two layers of vertices over `unit`.
/// - Pose of the middle facet relative to the start (turn vector, rad, and shift over `unit`).
struct SurfaceVariables {
  int columns = 0, rows = 0;                           ///< of facets, >= 2
  double unit = 1;                                     ///< of lengths, mm
  std::vector<int> rising_sign, level_sign;            ///< of the multipliers
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< of the middle facet at the start
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();     ///< of its lower left corner at the start, mm

  int size() const;
  /// Returns the index of the half distance of the layers. The pose follows it.
  int layer() const { return size() - 7; }
};

/// Returns x of these data. @param layer half distance of the two layers of vertices, mm
Eigen::VectorXd variables_of(const SurfaceVariables& v, const model::MarchData& data, double layer);

/// Returns the march's data at x, lengths in mm, multipliers times sin(theta). @param x of size() entries
template <class T>
model::MarchDataOf<T> march_data(const SurfaceVariables& v, const T* x) {
  using std::exp;
  const int p = v.columns - 1, q = v.rows - 1;
  model::MarchDataOf<T> d;
  const auto logarithms = [&](std::vector<T>& to, const std::vector<int>& signs) {
    for (const int sign : signs) to.push_back(T(sign) * exp(*x++));
  };
  const auto angles = [&](std::vector<T>& to, int count) {
    for (int k = 0; k < count; ++k) to.push_back(*x++);
  };
  const auto lengths = [&](std::vector<T>& to, int count) {
    for (int k = 0; k < count; ++k) to.push_back(*x++ * T(v.unit));
  };
  logarithms(d.rising, v.rising_sign);
  logarithms(d.level, v.level_sign);
  angles(d.left_angle, q);
  d.bottom_angle.push_back(d.left_angle[0]);
  angles(d.bottom_angle, p - 1);
  lengths(d.bottom_length, p - 1);
  lengths(d.left_length, q - 1);
  for (auto* side : {&d.west, &d.east}) lengths(*side, q);
  for (auto* side : {&d.south, &d.north}) lengths(*side, p);
  for (auto& corner : d.corners)
    for (int k = 0; k < 2; ++k) corner[k] = *x++ * T(v.unit);
  return d;
}

/// Miura sheet to start from.
struct MiuraStart {
  double angle = 1.13;  ///< of its parallelograms, rad
  double fold = 0.8;    ///< tan(rho / 2) of its rising creases, dimensionless
  int side = 1;         ///< 1: odd columns of vertices are above, -1: below
  int turn = 1;         ///< sign of the level creases: its zigzags start upwards or downwards
};

/// Sheet as large as the surface's rectangle, in its plane.
struct SurfaceStart {
  SurfaceVariables variables;
  Eigen::VectorXd x;  ///< in the rad and ratios of SurfaceVariables
};
SurfaceStart start_on(const targets::SurfacePatch& patch, int columns, int rows, const MiuraStart& miura);

/// Limits of a mesh. A search aims a little inside.
struct MeshBounds {
  std::array<double, 2> sector = {50 * radians_per_degree,
                                  130 * radians_per_degree};  ///< rad: bodies fit round vertices
  std::array<double, 2> edge = {0.6, 1.5};                    ///< of the mean edge, > 0
  /// Largest tan(rho / 2) of a crease: tan(largest tilt) sin(theta), dimensionless, > 0.
  double multiplier = 1.79;
  /// Smallest tan(rho / 2), dimensionless, < multiplier. Creases that do not fold at all determine nothing.
  double min_fold = 0.03;
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
  double boundary_weight_, diagonal_;
  int residuals_ = 0;
  Eigen::VectorXd lower_, upper_;
};

/// Returns the vertices of the mesh at x, folded and in place, mm.
std::vector<Eigen::Vector3d> placed_vertices(const SurfaceVariables& variables, const Eigen::VectorXd& x);

/// Returns the layer of vertex (i, j): 1 above, -1 below.
inline int layer_of(int i) { return -model::column_sign(i); }

}  // namespace kinetix::optim
