#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>

#include "model/lattice/square/family/classification.hpp"
#include "model/lattice/square/structure.hpp"
#include "model/lattice/square/unit_laws.hpp"
#include "tests/support/free_linkage_run.hpp"

/// Mechanisms with known answers. Lengths m, masses kg, rods uniform unless a mechanism says otherwise.
namespace kinetix::testing {

using Eigen::Vector3d;

/// Linkage, and the difference of a motion of it from the known answer: 0 in exact arithmetic.
struct Mechanism {
  std::string name;
  FreeLinkage linkage = {};
  double seconds = 1;
  double energy_scale = 1;  ///< J: reference for its energy drift
  std::string relation;     ///< in words
  std::function<double(double simulated_s, const std::vector<model::Pose>& poses)> miss = {};
};

inline const Vector3d down{0, -9.81, 0};  ///< m/s^2, gravity: mechanisms here are in metres

/// Turn of a hinge since the start, of b against a about its axis, (-pi, pi].
inline double hinge_turn(const FreeLinkage& linkage, int hinge, const std::vector<model::Pose>& poses) {
  const FreeLinkageHinge& h = linkage.hinges[hinge];
  const auto turned = [&](int body) -> Eigen::Matrix3d {
    if (body < 0) return Eigen::Matrix3d::Identity();
    return poses[body].R * linkage.bodies[body].pose.R.transpose();
  };
  const Eigen::Matrix3d R = turned(h.a).transpose() * turned(h.b);
  const Vector3d twice_sine(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  return std::atan2(h.axis.dot(twice_sine), R.trace() - 1);
}

/// Angle and its rate along a one-dimensional motion phi'' = a(phi), by steps of 20 us of Runge and Kutta.
inline std::function<double(double)> integrated(double angle, double rate,
                                                std::function<double(double)> acceleration) {
  constexpr double step = 2e-5;
  double time = 0;
  return [=](double until) mutable {
    while (time < until - step / 2) {
      const double k1 = acceleration(angle), k2 = acceleration(angle + step / 2 * rate),
                   k3 = acceleration(angle + step / 2 * (rate + step / 2 * k1)),
                   k4 = acceleration(angle + step * (rate + step / 2 * k2));
      angle += step * (rate + step / 6 * (k1 + k2 + k3));
      rate += step / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      time += step;
    }
    return angle;
  };
}

inline double wrapped(double angle) { return std::remainder(angle, 2 * pi); }

/// A rod that falls from level about its end. Angle phi from hanging: phi'' = -(3 g / 2 L) sin(phi).
inline Mechanism pendulum() {
  Mechanism m{.name = "pendulum",
              .seconds = 1.5,
              .energy_scale = 9.81 / 2,
              .relation = "angle against its closed form"};
  m.linkage.gravity = down;
  m.linkage.bodies = {rod({0, 0, 0}, {1, 0, 0}, 1)};
  m.linkage.hinges = {{-1, 0, {0, 0, 0}, {0, 0, 1}}};
  auto angle = integrated(pi / 2, 0, [](double phi) { return -1.5 * 9.81 * std::sin(phi); });
  m.miss = [angle, linkage = m.linkage](double t, const std::vector<model::Pose>& poses) mutable {
    return std::abs(wrapped(pi / 2 + hinge_turn(linkage, 0, poses) - angle(t)));
  };
  return m;
}

/// Returns the planar N-four-bar of the IFToMM library of benchmark problems: N + 1 uprights and N bars of 1 m and 1
/// kg, tips at 1 m/s. All bars are on one line twice a turn, where each loop may leave the parallelogram. The closed
/// form is that of the parallelogram, a pendulum of angle phi from upright:
/// (N m + (N + 1) m / 3) phi'' = g m (N + (N + 1) / 2) sin(phi).
inline Mechanism four_bars(int loops) {
  Mechanism m{.name = std::to_string(loops) + "-four-bar",
              .seconds = 3,
              .relation = "angle of the uprights against the parallelogram's closed form"};
  FreeLinkage& l = m.linkage;
  l.gravity = down;
  for (int k = 0; k <= loops; ++k) {
    l.bodies.push_back(rod({1.0 * k, 0, 0}, {1.0 * k, 1, 0}, 1));
    l.bodies.back().motion = {{0, 0, -1}, {0.5, 0, 0}};
    l.hinges.push_back({-1, k, {1.0 * k, 0, 0}, {0, 0, 1}});
  }
  for (int k = 0; k < loops; ++k) {
    const int bar = static_cast<int>(l.bodies.size());
    l.bodies.push_back(rod({1.0 * k, 1, 0}, {1.0 * k + 1, 1, 0}, 1));
    l.bodies.back().motion = {{0, 0, 0}, {1, 0, 0}};
    l.hinges.push_back({k, bar, {1.0 * k, 1, 0}, {0, 0, 1}});
    l.hinges.push_back({bar, k + 1, {1.0 * k + 1, 1, 0}, {0, 0, 1}});
  }
  const double inertia = loops + (loops + 1) / 3.0, weight = 9.81 * (loops + (loops + 1) / 2.0);
  m.energy_scale = 2 * weight;
  auto angle = integrated(0, 1, [=](double phi) { return weight / inertia * std::sin(phi); });
  m.miss = [angle, loops, l](double t, const std::vector<model::Pose>& poses) mutable {
    const double phi = angle(t);
    double worst = 0;
    for (int k = 0; k <= loops; ++k) {
      const Eigen::Matrix3d R = poses[k].R * l.bodies[k].pose.R.transpose();
      worst = std::max(worst, std::abs(wrapped(std::atan2(-R(1, 0), R(0, 0)) - phi)));
    }
    return worst;
  };
  return m;
}

/// Bricard's linkage of the IFToMM library: six hinges at right angles, five rods of 1 m and 1 kg along the
/// edges of a cube, the sixth edge the ground. Mobile though Gruebler counts none. Cosines of neighbouring
/// hinge angles: c + d + c d = 0 (trihedral, Bricard 1927).
inline Mechanism bricard() {
  Mechanism m{.name = "Bricard's linkage",
              .seconds = 3,
              .energy_scale = 9.81,
              .relation = "cosines of neighbouring hinge angles, c + d + c d = 0"};
  FreeLinkage& l = m.linkage;
  l.gravity = down;
  const Vector3d corners[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}, {0, 0, 1}};
  const Vector3d axes[] = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
  for (int k = 1; k < 6; ++k) l.bodies.push_back(rod(corners[k], corners[(k + 1) % 6], 1));
  for (int k = 0; k < 6; ++k)
    l.hinges.push_back({k == 1 ? -1 : (k + 4) % 6, k == 0 ? -1 : k - 1, corners[k], axes[k]});
  m.miss = [](double, const std::vector<model::Pose>& poses) {
    std::array<Vector3d, 6> along = {Vector3d::UnitX()};
    for (int k = 0; k < 5; ++k) along[k + 1] = poses[k].R.col(2);
    double worst = 0;
    for (int k = 0; k < 6; ++k) {
      const double c = along[k].dot(along[(k + 1) % 6]), d = along[(k + 1) % 6].dot(along[(k + 2) % 6]);
      worst = std::max(worst, std::abs(c + d + c * d));
    }
    return worst;
  };
  return m;
}

/// Bennett's linkage, free of forces: sides a, b, a, b twisted by alpha, beta with sin(alpha) / a = sin(beta)
/// / b. Hinge angles: tan(theta / 2) tan(phi / 2) = sin((beta + alpha) / 2) / sin((beta - alpha) / 2).
struct Bennett {
  double a = 1, alpha = 0.5, beta = 1.1;
  double b() const { return a * std::sin(beta) / std::sin(alpha); }
  double phi(double theta) const {
    return 2 * std::atan2(std::sin((beta + alpha) / 2) * std::cos(theta / 2),
                          std::sin((beta - alpha) / 2) * std::sin(theta / 2));
  }
  /// Frames of the ground and the three moving sides: z the axis of the next hinge, origin on it.
  std::array<Eigen::Isometry3d, 4> frames(double theta) const {
    const double turn[] = {theta, phi(theta), 2 * pi - theta}, side[] = {a, b(), a},
                 twist[] = {alpha, beta, alpha};
    std::array<Eigen::Isometry3d, 4> out;
    out[0].setIdentity();
    for (int k = 0; k < 3; ++k)
      out[k + 1] = out[k] * Eigen::AngleAxisd(turn[k], Vector3d::UnitZ()) *
                   Eigen::Translation3d(side[k], 0, 0) * Eigen::AngleAxisd(twist[k], Vector3d::UnitX());
    return out;
  }
};

inline Mechanism bennett() {
  Mechanism m{.name = "Bennett's linkage",
              .seconds = 3,
              .relation = "tangents of half the hinge angles, as Bennett's law has them"};
  const Bennett law;
  constexpr double start = 1, rate = 2, small = 1e-6;
  const auto at = law.frames(start), before = law.frames(start - small), after = law.frames(start + small);
  FreeLinkage& l = m.linkage;
  for (int k = 0; k < 3; ++k) {
    l.bodies.push_back(rod(at[k].translation(), at[k + 1].translation(), 1));
    const Eigen::Isometry3d motion = after[k + 1] * before[k + 1].inverse();
    const Eigen::AngleAxisd turn(motion.rotation());
    const Vector3d middle = (after[k].translation() + after[k + 1].translation() - before[k].translation() -
                             before[k + 1].translation()) /
                            2;
    l.bodies.back().motion = {rate / (2 * small) * turn.angle() * turn.axis(), rate / (2 * small) * middle};
  }
  for (int k = 0; k < 4; ++k)
    l.hinges.push_back({k - 1, k == 3 ? -1 : k, at[k].translation(), at[k].linear().col(2)});
  std::vector<model::Pose> poses;
  std::vector<model::Twist> motion;
  for (const FreeLinkageBody& body : l.bodies) poses.push_back(body.pose), motion.push_back(body.motion);
  m.energy_scale = linkage_energy(l, poses, motion);
  m.miss = [law, l](double, const std::vector<model::Pose>& now) {
    const double theta = start + hinge_turn(l, 0, now), phi = law.phi(start) + hinge_turn(l, 1, now);
    return std::abs(std::sin(theta / 2) * std::sin(phi / 2) * std::sin((law.beta - law.alpha) / 2) -
                    std::cos(theta / 2) * std::cos(phi / 2) * std::sin((law.beta + law.alpha) / 2));
  };
  return m;
}

/// Returns the doubly mirrored unit (beta_m, -beta_n, beta_m, -beta_n) of kinematics.md, with cell edge 1 and parts of
/// mass 1, free of forces. Half the angles u, v between the axes of opposite hinges follow cos(u) cos(v) = cos(beta_m)
/// cos(beta_n).
inline Mechanism mirrored_unit() {
  constexpr double tilt_m = 0.5, tilt_n = 0.8, start = 0.3, rate = 0.5, small = 1e-6;
  Mechanism m{
      .name = "doubly mirrored unit", .seconds = 1, .relation = "cos(u) cos(v) = cos(beta_m) cos(beta_n)"};
  model::Structure cell = make_structure(model::rectangle(1, 1), {1, 0.1, 0.6});
  apply_pattern(cell, bend_unit(model::BendUnit::B, tilt_m, tilt_n),
                bend_unit(model::BendUnit::B, tilt_m, tilt_n), model::SharedWalls::must_agree);
  const model::Classification family = classify(cell);
  const model::State at = fold(family, cell, start), before = fold(family, cell, start - small),
                     after = fold(family, cell, start + small);
  FreeLinkage& l = m.linkage;
  for (std::size_t k = 0; k < at.size(); ++k) {
    const Eigen::AngleAxisd turn(after[k].R * before[k].R.transpose());
    const double per = rate / (2 * small);
    l.bodies.push_back(
        {at[k], 1, {0.1, 0.1, 0.1}, {per * turn.angle() * turn.axis(), per * (after[k].p - before[k].p)}});
  }
  for (const model::Hinge& hinge : cell.hinges) {
    const model::Pose& lower = at[hinge.lower];
    l.hinges.push_back({hinge.lower, hinge.upper,
                        lower.p + lower.R * (hinge.parameters.t * edge_direction(hinge.wall.axis)),
                        lower.R * hinge_axis(hinge.wall.axis, hinge.parameters)});
  }
  std::vector<model::Twist> motion;
  for (const FreeLinkageBody& body : l.bodies) motion.push_back(body.motion);
  m.energy_scale = linkage_energy(l, at, motion);
  const model::CellHinges order = cell.cell_members[0];
  m.miss = [l, order](double, const std::vector<model::Pose>& poses) {
    std::array<Vector3d, 4> axis;
    for (int k = 0; k < 4; ++k) {
      const FreeLinkageHinge& h = l.hinges[order.hinges[k]];
      axis[k] = poses[h.a].R * l.bodies[h.a].pose.R.transpose() * h.axis;
    }
    const auto half = [](const Vector3d& p, const Vector3d& q) {
      return std::atan2(p.cross(q).norm(), p.dot(q)) / 2;
    };
    return std::abs(std::cos(half(axis[0], axis[2])) * std::cos(half(axis[1], axis[3])) -
                    std::cos(tilt_m) * std::cos(tilt_n));
  };
  return m;
}

/// Result of a run of a mechanism.
struct MechanismRun {
  FreeLinkageResult result;
  double miss = 0;   ///< largest at any time
  double drift = 0;  ///< of the energy, over its scale
};

inline MechanismRun run_mechanism(Mechanism mechanism, FreeLinkageOptions options) {
  options.seconds = mechanism.seconds;
  MechanismRun run;
  run.result =
      run_linkage(mechanism.linkage, options,
                  [&](double t, const std::vector<model::Pose>& poses, const std::vector<model::Twist>&) {
                    const double miss = mechanism.miss(t, poses);
                    if (!(miss <= run.miss)) run.miss = miss;
                  });
  run.drift = run.result.energy_drift / mechanism.energy_scale;
  return run;
}

}  // namespace kinetix::testing
