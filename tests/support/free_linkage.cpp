#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/base/geometry.hpp"
#include "model/base/invalid_input.hpp"
#include "tests/support/free_linkage.hpp"

namespace kinetix::testing {
namespace {

using Eigen::Vector3d;

// Thickness over length: thin, but with a moment of inertia about the rod's axis.
constexpr double rod_thickness = 1e-2;

/// Hinge point and axis as a body carries them, in the world frame.
struct Carried {
  Vector3d point, axis;
};

Carried carried(const FreeLinkage& linkage, const FreeLinkageHinge& hinge, int body,
                const std::vector<model::Pose>& poses) {
  if (body < 0) return {hinge.point, hinge.axis};
  const model::Pose &from = linkage.bodies[body].pose, &to = poses[body];
  const Eigen::Matrix3d turn = to.R * from.R.transpose();
  return {to.p + turn * (hinge.point - from.p), turn * hinge.axis};
}

void validate(const FreeLinkageBody& body, std::size_t k) {
  if (!(body.mass > 0 && std::isfinite(body.mass)))
    throw InvalidInput(fmt::format("mass of body {} is {}, must be positive", k, body.mass));
  if (!((body.inertia.array() > 0).all() && body.inertia.allFinite()))
    throw InvalidInput(fmt::format("inertia of body {} must be positive about every axis", k));
}

void validate(const FreeLinkageHinge& hinge, int bodies, std::size_t k) {
  for (const int body : {hinge.a, hinge.b})
    if (body < -1 || body >= bodies)
      throw InvalidInput(fmt::format("hinge {} is of body {}, and there are {}", k, body, bodies));
  if (hinge.a == hinge.b) throw InvalidInput(fmt::format("hinge {} has the same body on both sides", k));
  if (!(std::abs(hinge.axis.norm() - 1) <= 1e-9) || !hinge.point.allFinite())
    throw InvalidInput(fmt::format("hinge {} needs a point and an axis of unit length", k));
}

}  // namespace

void FreeLinkage::validate() const {
  for (std::size_t k = 0; k < bodies.size(); ++k) testing::validate(bodies[k], k);
  for (std::size_t k = 0; k < hinges.size(); ++k)
    testing::validate(hinges[k], static_cast<int>(bodies.size()), k);
}

FreeLinkageGap linkage_gap(const FreeLinkage& linkage, const std::vector<model::Pose>& poses) {
  FreeLinkageGap gap;
  for (const FreeLinkageHinge& hinge : linkage.hinges) {
    const Carried a = carried(linkage, hinge, hinge.a, poses), b = carried(linkage, hinge, hinge.b, poses);
    const double apart = (a.point - b.point).norm();
    const double turned = std::atan2(a.axis.cross(b.axis).norm(), a.axis.dot(b.axis));
    if (!(apart <= gap.point)) gap.point = apart;
    if (!(turned <= gap.axis)) gap.axis = turned;
  }
  return gap;
}

double linkage_energy(const FreeLinkage& linkage, const std::vector<model::Pose>& poses,
                      const std::vector<model::Twist>& motion) {
  double energy = 0;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const FreeLinkageBody& body = linkage.bodies[k];
    const Vector3d spin = poses[k].R.transpose() * motion[k].omega;
    energy += body.mass * (0.5 * motion[k].v.squaredNorm() - linkage.gravity.dot(poses[k].p));
    energy += 0.5 * spin.dot(body.inertia.cwiseProduct(spin));
  }
  return energy;
}

FreeLinkageBody rod(const Vector3d& from, const Vector3d& to, double mass) {
  const double length = (to - from).norm(), across = mass * length * length / 12;
  FreeLinkageBody body;
  body.pose.p = (from + to) / 2;
  body.pose.R = rotation_between(Vector3d::UnitZ(), to - from);
  body.mass = mass;
  body.inertia = {across, across, rod_thickness * rod_thickness * across};
  return body;
}

}  // namespace kinetix::testing
