#pragma once

#include <cmath>
#include <type_traits>

#include "model/lattice/square/structure.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::model {

/// Design of a structure that moves exactly (families F1, F2, F3 of kinematics.md section 2), by lattice columns and
/// rows. Signs and sublattices alternate over the sheet as the families require; the functions below apply this.
///
/// F1: beta and gamma 0, any t, s.   F2: gamma 0, s 1/2, in each column beta 0 or t 1/2.   F3: t, s 1/2.
template <class T>
struct ExactDesign {
  std::vector<T> beta;  ///< tilt of column c in row 0, rad; row j has (-1)^j beta
  /// The fraction tA of the x-walls of column c: it belongs to the vertex of sublattice A, (0, 1).
  std::vector<T> t;
  std::vector<T> s;  ///< tA of the y-walls of row r, (0, 1)
  T gamma = T(0);    ///< tilt of the y-walls on vertex column 0, rad; column i has (-1)^i gamma
  T theta = T(0);    ///< fold parameter, rad

  int columns() const { return static_cast<int>(beta.size()); }
  int rows() const { return static_cast<int>(s.size()); }

  /// Returns a flat design of basic hinges. @throws InvalidInput unless both are at least 1
  static ExactDesign basic(int columns, int rows) {
    check_extent(columns, rows);
    return {std::vector<T>(columns, T(0)), std::vector<T>(columns, T(0.5)), std::vector<T>(rows, T(0.5)),
            T(0), T(0)};
  }
};

/// Returns the fraction from the lower-index vertex, given tA and the sublattice of that vertex.
template <class T>
T fraction_from_lower(const T& t_of_sublattice_a, Vertex lower) {
  return lower.is_in_sublattice_a() ? t_of_sublattice_a : T(1) - t_of_sublattice_a;
}

/// Returns the pose of body (0,0): turned by theta about the axis of its y-wall, position at the origin.
template <class T>
PoseOf<T> first_pose(const ExactDesign<T>& design) {
  using std::cos;
  using std::sin;
  const T c = cos(design.theta), s = sin(design.theta), v = T(1) - c;
  const T wx = sin(design.gamma), wz = cos(design.gamma);
  PoseOf<T> pose;
  pose.R << c + v * wx * wx, -s * wz, v * wx * wz,  //
      s * wz, c, -s * wx,                           //
      v * wx * wz, s * wx, c + v * wz * wz;
  pose.p.setZero();
  return pose;
}

/// Mirror plane between a body and its x-neighbour. It contains the carried hinge axis and the direction y.
template <class T>
struct MirrorPlane {
  T nx, nz;  ///< unit normal (nx, 0, nz)

  /// @param axis the carried hinge axis; its part normal to y must not vanish
  explicit MirrorPlane(const Eigen::Matrix<T, 3, 1>& axis) {
    using std::sqrt;
    const T scale = T(1) / sqrt(axis.x() * axis.x() + axis.z() * axis.z());
    nx = axis.z() * scale;
    nz = -axis.x() * scale;
  }

  Eigen::Matrix<T, 3, 1> reflect(const Eigen::Matrix<T, 3, 1>& v) const {
    const T twice = T(2) * (nx * v.x() + nz * v.z());
    return {v.x() - twice * nx, v.y(), v.z() - twice * nz};
  }
};

/// Returns the unit axis of an x-wall hinge with tilt beta, carried by orientation R: R (cos(beta) z - sin(beta) y).
template <class T>
Eigen::Matrix<T, 3, 1> carried_axis(const Eigen::Matrix<T, 3, 3>& R, const T& cos_beta, const T& sin_beta) {
  return cos_beta * R.col(2) - sin_beta * R.col(1);
}

/// Returns the x-neighbour of a body: its mirror image in the plane, placed so that the hinge points coincide.
/// @param t hinge fraction from the body; @param L cell edge, mm
template <class T>
PoseOf<T> neighbour_x(const PoseOf<T>& pose, const MirrorPlane<T>& mirror, const T& t, double L) {
  PoseOf<T> next;
  next.R.col(0) = -mirror.reflect(pose.R.col(0));
  next.R.col(1) = mirror.reflect(pose.R.col(1));
  next.R.col(2) = mirror.reflect(pose.R.col(2));
  next.p = pose.p + L * (t * pose.R.col(0) + (T(1) - t) * next.R.col(0));
  return next;
}

/// Returns the y-neighbour of a body: its mirror image in the plane normal to y through the hinge point.
/// @param s hinge fraction from the body; @param L cell edge, mm
template <class T>
PoseOf<T> neighbour_y(const PoseOf<T>& pose, const T& s, double L) {
  PoseOf<T> next;
  next.R << pose.R(0, 0), -pose.R(0, 1), pose.R(0, 2),  //
      -pose.R(1, 0), pose.R(1, 1), -pose.R(1, 2),       //
      pose.R(2, 0), -pose.R(2, 1), pose.R(2, 2);
  next.p = pose.p + L * (s * pose.R.col(1) + (T(1) - s) * next.R.col(1));
  return next;
}

/// Computes fold() without its checks, for searches: NaN in, NaN out. @pre at least one column and one row
template <class T>
void fold_unchecked(const ExactDesign<T>& design, double L, std::vector<PoseOf<T>>& poses) {
  using std::cos;
  using std::sin;
  const int columns = design.columns(), rows = design.rows();
  poses.resize(static_cast<std::size_t>(columns + 1) * (rows + 1));
  poses[0] = first_pose(design);
  for (int i = 0; i <= columns; ++i) {
    PoseOf<T>* column = &poses[static_cast<std::size_t>(i) * (rows + 1)];
    for (int j = 0; j < rows; ++j)
      column[j + 1] = neighbour_y(column[j], fraction_from_lower(design.s[j], {i, j}), L);
    if (i == columns) break;
    const MirrorPlane<T> mirror(carried_axis(column[0].R, cos(design.beta[i]), sin(design.beta[i])));
    column[rows + 1] = neighbour_x(column[0], mirror, fraction_from_lower(design.t[i], {i, 0}), L);
  }
}

/// Checks the arguments of fold(). @throws InvalidInput unless the cell edge is positive, theta is within (-pi/2,
/// pi/2), every number is finite and there is a t for each column
void check_fold(const ExactDesign<double>& design, double L);

/// Computes the poses of all lattice vertices (i, j) of columns x rows cells, at index i * (rows + 1) + j. It
/// reflects from body to body: O(bodies), no solver. `poses` is resized, so that a caller's buffer is reused.
/// @param L cell edge, mm; positions are in mm   @throws InvalidInput as check_fold(), for numbers of type double
template <class T>
void fold(const ExactDesign<T>& design, double L, std::vector<PoseOf<T>>& poses) {
  if constexpr (std::is_same_v<T, double>) check_fold(design, L);
  fold_unchecked(design, L, poses);
}

/// Writes the design's hinges into a structure whose cells lie within columns x rows from (0, 0).
/// @pre the structure's lattice fits the design
void apply(const ExactDesign<double>& design, Structure& structure);

/// Returns the whole sheet of columns x rows cells, with the design's hinges.
Structure sheet_of(const ExactDesign<double>& design, const CellSize& size);

/// Returns true if a structure is that whole sheet, so that its bodies are the lattice's in the lattice's order.
/// @pre as for apply
bool is_whole_sheet(const ExactDesign<double>& design, const Structure& structure);

/// Returns the state (mm) of the bodies of a structure (any subset of the lattice of the design). @pre as for apply
/// @throws InvalidInput as check_fold()
State fold(const ExactDesign<double>& design, const Structure& structure);
/// Returns the state of fold() without its checks.
State fold_unchecked(const ExactDesign<double>& design, const Structure& structure);

/// Reads the exact design from a sheet's hinges, as classify() does, but repeatedly for one set of cells: a
/// microsecond for a strip. It supports only families F1, F2 and F3 along x.
class SheetReader {
 public:
  /// @param structure provides the cells; its hinges' parameters do not matter
  explicit SheetReader(const Structure& structure);

  /// Reads the design of the hinges, each column and row from its first hinge; theta does not change.
  /// @param structure the same cells; @param tolerance on fractions (absolute) and angles (rad)
  /// @return false if the hinges satisfy none of the three families' rules; `design` is then invalid
  bool read(const Structure& structure, ExactDesign<double>& design, double tolerance = 1e-9) const;

  int columns() const { return columns_; }
  int rows() const { return rows_; }

 private:
  int columns_ = 0, rows_ = 0;
};

}  // namespace kinetix::model
