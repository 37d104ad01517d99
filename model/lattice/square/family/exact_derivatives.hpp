#pragma once

#include "model/lattice/square/family/exact_family.hpp"

namespace kinetix::model {

/// Two numbers for two designs that are computed at once with vector instructions. Every 64-bit processor has
/// these 16-byte instructions. Each lane has exactly the bits that `double` gives.
class Lanes {
 public:
  static constexpr int count = 2;  ///< lanes: two doubles fill the 16 bytes of such an instruction

  Lanes() = default;
  Lanes(double both) : v_{both, both} {}

  double operator[](int lane) const { return v_[lane]; }
  void set(int lane, double value) { v_[lane] = value; }

  Lanes& operator+=(const Lanes& o) { return *this = *this + o; }
  Lanes& operator-=(const Lanes& o) { return *this = *this - o; }
  Lanes& operator*=(const Lanes& o) { return *this = *this * o; }
  friend Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a.v_ + b.v_); }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a.v_ - b.v_); }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a.v_ * b.v_); }
  friend Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(a.v_ / b.v_); }
  friend Lanes operator-(const Lanes& a) { return Lanes(-a.v_); }
  friend Lanes sin(const Lanes& a) { return {std::sin(a[0]), std::sin(a[1])}; }
  friend Lanes cos(const Lanes& a) { return {std::cos(a[0]), std::cos(a[1])}; }
  friend Lanes sqrt(const Lanes& a) { return {std::sqrt(a[0]), std::sqrt(a[1])}; }

 private:
  using Vector = double __attribute__((vector_size(count * sizeof(double))));

  explicit Lanes(const Vector& v) : v_(v) {}
  Lanes(double first, double second) : v_{first, second} {}

  Vector v_;
};

}  // namespace kinetix::model

/// Makes Lanes usable as the entries of Eigen matrices.
template <>
struct Eigen::NumTraits<kinetix::model::Lanes> : Eigen::GenericNumTraits<double> {
  using Real = kinetix::model::Lanes;
  using NonInteger = kinetix::model::Lanes;
  using Nested = kinetix::model::Lanes;
  using Literal = kinetix::model::Lanes;
  enum { RequireInitialization = 0, ReadCost = 1, AddCost = 1, MulCost = 1 };
};

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

/// Computes the derivatives of a function of the state by every parameter of an exact design. They have the form of a
/// design. The method is one backward pass over the bodies, the adjoint of fold()'s recursion. ExactJacobian has a
/// column per parameter instead.
/// @tparam T double, or Lanes for two designs at once.
/// @param L cell edge, mm   @param poses result of fold(), mm.
/// @param by_state derivative of the function, 6 per body in the order of `poses`. The first three are by a turn
/// about the world's axes through its position (per rad), the others by a shift (per mm).
/// @param gradient is set to the derivatives: per rad, or per unit of a fraction. Buffers are reused
template <class T>
void fold_gradient(const ExactDesign<T>& design, double L, const std::vector<PoseOf<T>>& poses,
                   const Eigen::Matrix<T, Eigen::Dynamic, 1>& by_state, ExactDesign<T>& gradient);

extern template void fold_gradient(const ExactDesign<double>&, double, const State&, const Eigen::VectorXd&,
                                   ExactDesign<double>&);
extern template void fold_gradient(const ExactDesign<Lanes>&, double, const std::vector<PoseOf<Lanes>>&,
                                   const Eigen::Matrix<Lanes, Eigen::Dynamic, 1>&, ExactDesign<Lanes>&);

}  // namespace kinetix::model
