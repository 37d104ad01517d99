#include "model/hinge/element.hpp"

namespace kinetix::model {

using Eigen::Matrix3d;

void add_turning(const Mismatch& m, double weight, Element& e) {
  const Matrix3d a = cross_matrix(m.lower), b = cross_matrix(m.upper);
  e.energy += weight * m.gap.squaredNorm();
  e.gradient.segment<3>(0) += 2 * weight * m.lower.cross(m.gap);
  e.gradient.segment<3>(6) -= 2 * weight * m.upper.cross(m.gap);
  e.hessian.block<3, 3>(0, 0) += 2 * weight * (turning_hessian(m.gap, m.lower) - a * a);
  e.hessian.block<3, 3>(6, 6) -= 2 * weight * (turning_hessian(m.gap, m.upper) + b * b);
  const Matrix3d coupling = 2 * weight * (a * b);
  e.hessian.block<3, 3>(0, 6) += coupling;
  e.hessian.block<3, 3>(6, 0) += coupling.transpose();
}

void add_shifts(const Mismatch& m, double weight, Element& e) {
  const double twice = 2 * weight;
  const Matrix3d a = twice * cross_matrix(m.lower), b = twice * cross_matrix(m.upper);
  e.gradient.segment<3>(3) += twice * m.gap;
  e.gradient.segment<3>(9) -= twice * m.gap;
  e.hessian.block<3, 3>(0, 3) += a;
  e.hessian.block<3, 3>(3, 0) -= a;
  e.hessian.block<3, 3>(0, 9) -= a;
  e.hessian.block<3, 3>(9, 0) += a;
  e.hessian.block<3, 3>(6, 3) -= b;
  e.hessian.block<3, 3>(3, 6) += b;
  e.hessian.block<3, 3>(6, 9) += b;
  e.hessian.block<3, 3>(9, 6) -= b;
  for (int k = 0; k < 3; ++k) {
    e.hessian(3 + k, 3 + k) += twice;
    e.hessian(9 + k, 9 + k) += twice;
    e.hessian(3 + k, 9 + k) -= twice;
    e.hessian(9 + k, 3 + k) -= twice;
  }
}

using Eigen::Vector3d;

Vector3d wall_direction(const RestHinge& h) { return (h.edge - h.edge.dot(h.axis) * h.axis).normalized(); }

Vector3d wall_direction_rate(const RestHinge& h, const Vector3d& axis_rate) {
  const Vector3d across = h.edge - h.edge.dot(h.axis) * h.axis, unit = across.normalized();
  const Vector3d rate = -h.edge.dot(axis_rate) * h.axis - h.edge.dot(h.axis) * axis_rate;
  return (rate - unit.dot(rate) * unit) / across.norm();
}

DirectedSquare::DirectedSquare(const Mismatch& mismatch, const Vector3d& w0, const Pose& lower,
                               const Pose& upper)
    : g_(mismatch), lower_(lower.R * w0), upper_(upper.R * w0), w_(lower_ + upper_) {
  s_ = g_.gap.dot(w_);
  n_ = w_.squaredNorm();
  m_ = s_ / n_;
}

Vector12 DirectedSquare::s_rate(bool shifts) const {
  Vector12 rate = Vector12::Zero();
  rate.segment<3>(0) = g_.lower.cross(w_) + lower_.cross(g_.gap);
  rate.segment<3>(6) = upper_.cross(g_.gap) - g_.upper.cross(w_);
  if (!shifts) return rate;
  rate.segment<3>(3) = w_;
  rate.segment<3>(9) = -w_;
  return rate;
}

Vector12 DirectedSquare::n_rate() const {
  Vector12 rate = Vector12::Zero();
  rate.segment<3>(0) = 2 * lower_.cross(upper_);
  rate.segment<3>(6) = -rate.segment<3>(0);
  return rate;
}

void DirectedSquare::add_s_hessian(Matrix12& h, double weight, bool shifts) const {
  const Matrix3d l = cross_matrix(g_.lower), u = cross_matrix(g_.upper), p = cross_matrix(lower_),
                 q = cross_matrix(upper_);
  h.block<3, 3>(0, 0) +=
      weight * (turning_hessian(w_, g_.lower) + turning_hessian(g_.gap, lower_) - l * p - p * l);
  h.block<3, 3>(6, 6) +=
      weight * (turning_hessian(g_.gap, upper_) - turning_hessian(w_, g_.upper) + u * q + q * u);
  const Matrix3d coupling = weight * (p * u - l * q);
  h.block<3, 3>(0, 6) += coupling;
  h.block<3, 3>(6, 0) += coupling.transpose();
  if (!shifts) return;
  const Matrix3d a = weight * p, b = weight * q;
  h.block<3, 3>(3, 0) -= a;
  h.block<3, 3>(0, 3) += a;
  h.block<3, 3>(9, 0) += a;
  h.block<3, 3>(0, 9) -= a;
  h.block<3, 3>(3, 6) -= b;
  h.block<3, 3>(6, 3) += b;
  h.block<3, 3>(9, 6) += b;
  h.block<3, 3>(6, 9) -= b;
}

void DirectedSquare::add_n_hessian(Matrix12& h, double weight) const {
  h.block<3, 3>(0, 0) += 2 * weight * turning_hessian(upper_, lower_);
  h.block<3, 3>(6, 6) += 2 * weight * turning_hessian(lower_, upper_);
  const Matrix3d coupling = -2 * weight * (cross_matrix(lower_) * cross_matrix(upper_));
  h.block<3, 3>(0, 6) += coupling;
  h.block<3, 3>(6, 0) += coupling.transpose();
}

Vector12 DirectedSquare::gradient(bool shifts) const { return 2 * m_ * s_rate(shifts) - m_ * m_ * n_rate(); }

void DirectedSquare::add_to(Element& e, double weight, bool shifts) const {
  const Vector12 s = s_rate(shifts), n = n_rate(), stretch = s - m_ * n;
  e.energy += weight * value();
  e.gradient += weight * m_ * (2 * s - m_ * n);
  e.hessian += (2 * weight / n_) * stretch * stretch.transpose();
  add_s_hessian(e.hessian, 2 * weight * m_, shifts);
  add_n_hessian(e.hessian, -weight * m_ * m_);
}

double DirectedSquare::rate(const DirectedChange& c) const {
  return 2 * m_ * (c.gap.dot(w_) + g_.gap.dot(c.w)) - 2 * m_ * m_ * w_.dot(c.w);
}

double DirectedSquare::rate(const DirectedChange& along, const DirectedChange& by,
                            const DirectedChange& mixed) const {
  const double s_along = along.gap.dot(w_) + g_.gap.dot(along.w), n_along = 2 * w_.dot(along.w);
  const double s_by = by.gap.dot(w_) + g_.gap.dot(by.w), n_by = 2 * w_.dot(by.w);
  const double s_both = mixed.gap.dot(w_) + along.gap.dot(by.w) + by.gap.dot(along.w) + g_.gap.dot(mixed.w);
  const double n_both = 2 * (by.w.dot(along.w) + w_.dot(mixed.w));
  const double m_by = (s_by - m_ * n_by) / n_;
  return 2 * (m_by * s_along + m_ * s_both) - 2 * m_ * m_by * n_along - m_ * m_ * n_both;
}

}  // namespace kinetix::model
