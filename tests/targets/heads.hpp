#pragma once

#include <random>

#include "tests/targets/meshes.hpp"

/// Stand-ins for scans of heads, mm, z up, y to the front. Bumps represent ears and nose.
namespace kinetix::testing {

/// How far a bump of height 1 lifts a place, 1 at its centre and 0 beyond its radius.
inline double bump(const Eigen::Vector3d& p, const Eigen::Vector3d& centre, double radius) {
  const double f = (p - centre).norm() / radius;
  return f < 1 ? std::pow(1 - f * f, 2) : 0;
}

/// mm: half of the breadth and length of a man's head; upwards more, so that a neck can be cut off.
inline const Eigen::Vector3d head_axes{77, 98, 115};

/// An ellipsoid with two ears 22 mm and a nose 25 mm proud of it, cut off at the neck.
inline targets::TriangleMesh head_with_ears(int around = 180, int down = 120) {
  targets::TriangleMesh mesh = ellipsoid(head_axes, around, down);
  for (Eigen::Vector3d& p : mesh.vertices) {
    const double ears = bump(p, {77, -5, -15}, 30) + bump(p, {-77, -5, -15}, 30);
    const double nose = bump(p, {0, 96, -20}, 25);
    p += (22 * ears + 25 * nose) * p.normalized();
  }
  std::erase_if(mesh.triangles, [&](const targets::Triangle& t) { return mesh.vertices[t[0]].z() < -100; });
  return mesh;
}

/// mm: half axes of a thin ear, and its middle beside the head, so that a part of it is inside.
inline const Eigen::Vector3d ear_axes{30, 3, 25}, ear_centre{85, -5, 40};

/// Returns an ellipsoid with two ears that stand out sideways, 38 mm long and at most 6 mm thick. The ears are separate
/// closed shells that reach into the head.
inline targets::TriangleMesh head_with_thin_ears(int around = 120, int down = 80) {
  targets::TriangleMesh mesh = ellipsoid(head_axes, around, down);
  for (const double side : {-1.0, 1.0})
    add_part(mesh, ellipsoid(ear_axes, 40, 30), {side * ear_centre.x(), ear_centre.y(), ear_centre.z()});
  return mesh;
}

/// Returns how far out a point is from the middle of the ellipsoid, 1 on it.
inline double level(const Eigen::Vector3d& p, const Eigen::Vector3d& axes) {
  return p.cwiseQuotient(axes).norm();
}

/// Returns whether the head with thin ears contains p, by the equations of its parts.
inline bool is_in_head_or_ear(const Eigen::Vector3d& p) {
  const Eigen::Vector3d mirrored(std::abs(p.x()), p.y(), p.z());
  return level(p, head_axes) < 1 || level(mirrored - ear_centre, ear_axes) < 1;
}

/// Returns a cone cut off at both ends, open there, its upper edge at z = 0.
inline targets::TriangleMesh lampshade(double top = 45, double bottom = 110, double height = 170) {
  targets::TriangleMesh mesh;
  constexpr int around = 96, down = 40;
  for (int j = 0; j <= down; ++j)
    for (int i = 0; i < around; ++i) {
      const double r = top + (bottom - top) * j / down, angle = 2 * std::numbers::pi * i / around;
      mesh.vertices.push_back({r * std::cos(angle), r * std::sin(angle), -height * j / down});
    }
  for (int j = 0; j < down; ++j)
    for (int i = 0; i < around; ++i) {
      const int a = j * around + i, b = j * around + (i + 1) % around;
      mesh.triangles.push_back({a, a + around, b});
      mesh.triangles.push_back({b, a + around, b + around});
    }
  return mesh;
}

/// Returns head_with_ears() with the defects of scans. Noise of `noise` mm (standard deviation) acts along the normal,
/// and there are `holes` round holes of 4 to 10 mm radius. It has doubled, flipped and degenerate triangles, flaps on
/// an edge, an inner shell, and a speck next to the head.
inline targets::TriangleMesh scanned_head(unsigned seed, double noise = 0.2, int holes = 8) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0, 1);
  targets::TriangleMesh mesh = head_with_ears();
  const targets::TriangleMesh inner = ellipsoid(0.9 * head_axes, 40, 30);
  for (Eigen::Vector3d& p : mesh.vertices) p += noise * normal(random) * p.normalized();
  for (int hole = 0; hole < holes; ++hole) {
    const Eigen::Vector3d centre = mesh.vertices[random() % mesh.vertices.size()];
    const double radius = 4 + 6 * unit(random);
    std::erase_if(mesh.triangles,
                  [&](const targets::Triangle& t) { return (mesh.vertices[t[0]] - centre).norm() < radius; });
  }
  const std::size_t count = mesh.triangles.size();
  for (std::size_t k = 0; k < count; k += 50) {
    const auto [a, b, c] = mesh.triangles[k];
    mesh.vertices.push_back(0.97 * mesh.vertices[c]);
    const int flap = static_cast<int>(mesh.vertices.size()) - 1;
    for (const targets::Triangle& t : {targets::Triangle{a, c, b}, {a, b, b}, {a, b, flap}})
      mesh.triangles.push_back(t);
  }
  for (std::size_t k = 0; k < count; ++k)
    if (random() % 3 == 0) std::swap(mesh.triangles[k][0], mesh.triangles[k][1]);
  add_part(mesh, inner, Eigen::Vector3d::Zero());
  add_part(mesh, tetrahedron(5), {30, 20, 160});
  return mesh;
}

}  // namespace kinetix::testing
