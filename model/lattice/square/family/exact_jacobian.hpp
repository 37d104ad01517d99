#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/lattice/square/family/exact_family.hpp"

namespace kinetix::model {

/// Derivatives of fold() with respect to beta_0.., t_0.., s_0.., gamma, theta, in this order.
class ExactJacobian {
 public:
  int parameters() const { return 2 * columns_ + rows_ + 2; }
  int bodies() const { return (columns_ + 1) * (rows_ + 1); }

  int beta(int c) const { return c; }
  int t(int c) const { return columns_ + c; }
  int s(int r) const { return 2 * columns_ + r; }
  int gamma() const { return 2 * columns_ + rows_; }
  int theta() const { return 2 * columns_ + rows_ + 1; }

  /// Returns the twist of lattice body i * (rows + 1) + j with respect to one parameter, rad and mm per its unit.
  const Twist& twist(int parameter, int body) const { return twists_[index(parameter, body)]; }

 private:
  friend void fold_with_jacobian(const ExactDesign<double>&, double, State&, ExactJacobian&);

  std::size_t index(int parameter, int body) const {
    return static_cast<std::size_t>(parameter) * bodies() + body;
  }
  Twist* row(int parameter) { return &twists_[index(parameter, 0)]; }
  void resize(int columns, int rows);

  int columns_ = 0, rows_ = 0;
  std::vector<Twist> twists_;  // entries of bodies before the parameter's hinge stay zero
};

/// Computes fold() of exact_family.hpp with its analytic Jacobian. A tilt turns all later columns rigidly about the
/// line through its hinges along y, an offset shifts them. Each entry therefore costs a few operations. Buffers are
/// reused. @param L cell edge, mm
void fold_with_jacobian(const ExactDesign<double>& design, double L, State& poses, ExactJacobian& jacobian);

}  // namespace kinetix::model
