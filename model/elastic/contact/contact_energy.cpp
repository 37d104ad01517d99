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

ContactModel::ByTwoHinges ContactModel::gap_gradient(const PointGap& g, const Contact& c,
                                                     const State& state) const {
  const ContactPlate& plate = all().plates[c.plate];
  const ContactPlate& box = all().plates[c.other];
  const ContactPoint& point = all().points[c.point];
  const Matrix3d &R = state[plate.body].R, &frame = state[box.body].R;
  ByTwoHinges out;
  out << plate.sign * g.n.dot(R * plate.place_length_rate(point)), g.n.dot(R * plate.place_alpha_rate(point)),
      g.n.dot(R * plate.place_rate(point)), -box.sign * ContactPlates::face_offset_rate(box, c.face),
      g.m.dot(frame * box.face_normal_alpha_rate(c.face)) -
          ContactPlates::face_offset_alpha_rate(box, c.face),
      g.m.dot(frame * box.face_normal_rate(c.face));
  return out;
}

ContactModel::ByTwoHinges ContactModel::depth_gradient(const Contact& c, const State& state) const {
  return -gap_gradient(gap(c, state), c, state);
}

Eigen::Matrix<double, 12, 6> ContactModel::derivatives(const Contact& c, double stiffness,
                                                       const State& state) const {
  const PointGap g = gap(c, state);
  const ContactPlate& plate = all().plates[c.plate];
  const ContactPlate& box = all().plates[c.other];
  const ContactPoint& point = all().points[c.point];
  const Matrix3d &R = state[plate.body].R, &frame = state[box.body].R;
  const Vector3d none = Vector3d::Zero();
  const auto by_point = [&](const Vector3d& moved) -> Vector12 {
    return g.gradient_change(none, R * moved, R * moved);
  };
  const auto by_normal = [&](const Vector3d& turned) -> Vector12 {
    return g.gradient_change(frame * turned, none, none);
  };
  Eigen::Matrix<double, 12, 6> out;
  out << by_point(plate.sign * plate.place_length_rate(point)), by_point(plate.place_alpha_rate(point)),
      by_point(plate.place_rate(point)), Vector12::Zero(), by_normal(box.face_normal_alpha_rate(c.face)),
      by_normal(box.face_normal_rate(c.face));
  const ByTwoHinges value = gap_gradient(g, c, state);
  return weight_ * stiffness * (g.value * out + g.gradient() * value.transpose());
}

Vector12 ContactModel::stiffness_rate(const Contact& contact, const State& state) const {
  const PointGap g = gap(contact, state);
  return weight_ * g.value * g.gradient();
}

}  // namespace kinetix::model
