#pragma once

#include <Eigen/Core>
#include <cmath>

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
