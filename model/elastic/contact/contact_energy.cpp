#include "model/elastic/contact/contact_energy.hpp"

namespace kinetix::model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

}  // namespace

ContactModel::ContactModel(const Linkage& structure, bool planar)
    : search_(structure, planar), weight_(planar ? 1.0 : 1.0 / 3) {}

PointGap ContactModel::gap(const Contact& c, const State& state) const {
  const ContactPlate& plate = all().plates[c.plate];
  const ContactPlate& box = all().plates[c.other];
  const Pose& pose = state[plate.body];
  const Pose& frame = state[box.body];
  PointGap gap;
  gap.n = frame.R * box.face_normal(c.face);
  gap.a = pose.R * plate.place(all().points[c.point]);
  gap.m = (pose.p - frame.p) / all().edge_mm + gap.a;
  gap.value = gap.n.dot(gap.m) - all().face_offset(box, c.face);
  return gap;
}

Element ContactModel::element(const Contact& contact, double stiffness, const State& state) const {
  return gap(contact, state).pressed(weight_ * stiffness);
}

double ContactModel::energy(const std::vector<Contact>& contacts, double stiffness) const {
  double sum = 0;
  for (const Contact& c : contacts) sum += 0.5 * weight_ * stiffness * c.depth * c.depth;
  return sum;
}

Eigen::Vector4d ContactModel::gap_gradient(const PointGap& g, const Contact& c, const State& state) const {
  const ContactPlate& plate = all().plates[c.plate];
  const ContactPlate& box = all().plates[c.other];
  const ContactPoint& point = all().points[c.point];
  const Matrix3d& R = state[plate.body].R;
  return {plate.sign * point.part * plate.length_rate_at(point.high) * g.n.dot(R * plate.edge),
          g.n.dot(R * plate.place_rate(point)), -box.sign * ContactPlates::face_offset_rate(box, c.face),
          g.m.dot(state[box.body].R * box.face_normal_rate(c.face))};
}

Eigen::Vector4d ContactModel::depth_gradient(const Contact& c, const State& state) const {
  return -gap_gradient(gap(c, state), c, state);
}

Eigen::Matrix<double, 12, 4> ContactModel::derivatives(const Contact& c, double stiffness,
                                                       const State& state) const {
  const PointGap g = gap(c, state);
  const ContactPlate& plate = all().plates[c.plate];
  const ContactPlate& box = all().plates[c.other];
  const ContactPoint& point = all().points[c.point];
  const Matrix3d& R = state[plate.body].R;
  const Vector3d by_t = plate.sign * point.part * plate.length_rate_at(point.high) * (R * plate.edge),
                 by_beta = R * plate.place_rate(point);
  const Vector3d normal_by_beta = state[box.body].R * box.face_normal_rate(c.face);
  const Vector3d none = Vector3d::Zero();
  const Eigen::Vector4d value = gap_gradient(g, c, state);
  Eigen::Matrix<double, 12, 4> out;
  out.col(0) = g.gradient_change(none, by_t, by_t);
  out.col(1) = g.gradient_change(none, by_beta, by_beta);
  out.col(2).setZero();
  out.col(3) = g.gradient_change(normal_by_beta, none, none);
  return weight_ * stiffness * (g.value * out + g.gradient() * value.transpose());
}

Vector12 ContactModel::stiffness_rate(const Contact& contact, const State& state) const {
  const PointGap g = gap(contact, state);
  return weight_ * g.value * g.gradient();
}

}  // namespace kinetix::model
