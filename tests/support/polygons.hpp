#pragma once

#include <Eigen/Geometry>
#include <complex>
#include <numbers>
#include <vector>

#include "model/linkage/exact_motion.hpp"

namespace kinetix::testing {

using Complex = std::complex<double>;

/// Cell of any even number of walls, all hinges upright: the smallest structure of a user-defined lattice, made without
/// model/lattice. Its closed form is the theorem of kinematics.md section 5.
struct Polygon {
  std::vector<Complex>
      corners;            ///< counter-clockwise, cell edges; bodies turn by +theta, -theta, +theta, ...
  std::vector<double> s;  ///< of each wall, 2 tA - 1; the sum of s times the walked walls is 0

  int walls() const { return static_cast<int>(corners.size()); }
  Complex wall(int k) const { return corners[(k + 1) % walls()] - corners[k]; }
  int sense(int k) const { return k % 2 == 0 ? 1 : -1; }
  /// Fraction of wall k that belongs to its first body.
  double t(int k) const { return (1 + sense(k) * s[k]) / 2; }
};

inline Eigen::Vector3d flat(Complex z) { return {z.real(), z.imag(), 0}; }

inline model::RestHinge rest_hinge(const Polygon& polygon, int k) {
  model::RestHinge hinge;
  hinge.lower = k;
  hinge.upper = (k + 1) % polygon.walls();
  hinge.edge = flat(polygon.wall(k));
  hinge.across = Eigen::Vector3d::UnitZ().cross(hinge.edge.normalized());
  hinge.lower_arm = polygon.t(k) * hinge.edge;
  hinge.upper_arm = (polygon.t(k) - 1) * hinge.edge;
  hinge.axis = Eigen::Vector3d::UnitZ();
  hinge.axis_alpha = -hinge.edge.normalized();
  hinge.axis_beta = hinge.edge.normalized().cross(Eigen::Vector3d::UnitZ());
  return hinge;
}

inline model::Plate plate(const Polygon& polygon, int k, bool lower) {
  const Eigen::Vector3d edge = flat(polygon.wall(k));
  model::Plate plate;
  plate.body = lower ? k : (k + 1) % polygon.walls();
  plate.hinge = k;
  plate.edge = (lower ? 1 : -1) * edge.normalized();
  plate.up = Eigen::Vector3d::UnitZ();
  plate.up_beta = edge.normalized().cross(plate.up);
  plate.length = (lower ? polygon.t(k) : 1 - polygon.t(k)) * edge.norm();
  plate.length_t = (lower ? 1 : -1) * edge.norm();
  return plate;
}

inline model::Linkage linkage_of(const Polygon& polygon) {
  model::Linkage linkage;
  linkage.cells.emplace_back();
  for (int k = 0; k < polygon.walls(); ++k) {
    linkage.bodies.push_back({flat(polygon.corners[k]), polygon.sense(k)});
    linkage.hinges.push_back(rest_hinge(polygon, k));
    for (const bool lower : {true, false}) linkage.plates.push_back(plate(polygon, k, lower));
    linkage.cells[0].bodies.push_back(k);
    linkage.cells[0].hinges.push_back(k);
  }
  linkage.wall_name = [](int hinge) { return "wall " + std::to_string(hinge); };
  linkage.vertex_name = [](int body) { return "corner " + std::to_string(body); };
  return linkage;
}

/// X(theta) = cos(theta) x + i sin(theta) y, y the parallel redrawing of x by s.
inline model::State folded(const Polygon& polygon, double edge_mm, double theta) {
  model::State state;
  Complex y = 0;
  for (int k = 0; k < polygon.walls(); ++k) {
    const Complex X = std::cos(theta) * polygon.corners[k] + Complex(0, std::sin(theta)) * y;
    state.push_back({Eigen::AngleAxisd(polygon.sense(k) * theta, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
                     edge_mm * flat(X)});
    y += polygon.s[k] * polygon.wall(k);
  }
  return state;
}

inline model::ExactMotion exact_motion(const Polygon& polygon, double edge_mm) {
  return {[=](double theta) { return folded(polygon, edge_mm, theta); }, "polygon",
          "planar cell of any shape"};
}

/// Returns the drive that turns the first hinge so that all bodies turn by theta.
inline model::DrivenLinkage driven(const Polygon& polygon, double theta) {
  model::DrivenLinkage out{linkage_of(polygon), {}, {}};
  out.exact = exact_motion(polygon, out.linkage.size.edge_mm);
  out.drive.kind = model::LinkageDrive::Kind::hinge;
  out.drive.hinge = 0;
  out.drive.angle = -2 * theta;
  return out;
}

inline Polygon hexagon(double s0 = 0, double s1 = 0, double s2 = 0) {
  Polygon polygon{{}, {s0, s1, s2, s0, s1, s2}};
  for (int k = 0; k < 6; ++k) polygon.corners.push_back(std::polar(1.0, std::numbers::pi * k / 3));
  return polygon;
}

/// @param angle of its first corner, rad
inline Polygon rhombus(double angle, double s0 = 0, double s1 = 0) {
  const Complex slanted = std::polar(1.0, angle);
  return {{0, 1, 1.0 + slanted, slanted}, {s0, s1, s0, s1}};
}

}  // namespace kinetix::testing
