#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <sstream>
#include <string>

#include "targets/mesh/triangle_mesh.hpp"

namespace kinetix::testing {

/// Returns a random point in a cube of twice the size about the origin.
inline Eigen::Vector3d random_point(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> unit(-size, size);
  return {unit(random), unit(random), unit(random)};
}

/// A closed surface round the origin with a vertex on each pole: point(azimuth, polar angle from z) at
/// `around` x (`down` + 1) angles. Wound outward.
inline targets::TriangleMesh globe(const std::function<Eigen::Vector3d(double, double)>& point, int around,
                                   int down) {
  targets::TriangleMesh mesh;
  const auto at = [&](int i, int j) {
    if (j == 0) return 0;
    if (j == down) return 1;
    return 2 + (j - 1) * around + i % around;
  };
  mesh.vertices = {point(0, 0), point(0, std::numbers::pi)};
  for (int j = 1; j < down; ++j)
    for (int i = 0; i < around; ++i)
      mesh.vertices.push_back(point(2 * std::numbers::pi * i / around, std::numbers::pi * j / down));
  for (int j = 0; j < down; ++j)
    for (int i = 0; i < around; ++i) {
      if (j > 0) mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
      if (j + 1 < down) mesh.triangles.push_back({at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
    }
  return mesh;
}

inline targets::TriangleMesh ellipsoid(const Eigen::Vector3d& axes, int around = 48, int down = 24) {
  return globe(
      [axes](double azimuth, double polar) -> Eigen::Vector3d {
        const Eigen::Array3d direction(std::sin(polar) * std::cos(azimuth),
                                       std::sin(polar) * std::sin(azimuth), std::cos(polar));
        return (direction * axes.array()).matrix();
      },
      around, down);
}

inline targets::TriangleMesh tetrahedron(double edge = 100) {
  return {{{0, 0, 0}, {edge, 0, 0}, {0, edge, 0}, {0, 0, edge}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}

/// Adds a moved part.
inline void add_part(targets::TriangleMesh& mesh, const targets::TriangleMesh& part,
                     const Eigen::Vector3d& shift) {
  const int first = static_cast<int>(mesh.vertices.size());
  for (const auto& p : part.vertices) mesh.vertices.push_back(p + shift);
  for (const auto& [a, b, c] : part.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

/// A cube round the origin, wound outward.
inline targets::TriangleMesh cube(double half) {
  targets::TriangleMesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.vertices.push_back(half * Eigen::Vector3d(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// Returns the mesh without the triangles that have a corner for which `is_gone` is true.
inline targets::TriangleMesh cut(targets::TriangleMesh mesh,
                                 const std::function<bool(const Eigen::Vector3d&)>& is_gone) {
  std::erase_if(mesh.triangles, [&](const targets::Triangle& t) {
    return is_gone(mesh.vertices[t[0]]) || is_gone(mesh.vertices[t[1]]) || is_gone(mesh.vertices[t[2]]);
  });
  return mesh;
}

inline std::string obj_text(const targets::TriangleMesh& mesh) {
  std::ostringstream out;
  out.precision(9);
  for (const auto& p : mesh.vertices) out << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  for (const auto& t : mesh.triangles) out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  return out.str();
}

template <class Number>
void append_binary(std::string& bytes, Number value, bool big_endian = false) {
  const auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  for (std::size_t k = 0; k < raw.size(); ++k) bytes += raw[big_endian ? raw.size() - 1 - k : k];
}

inline std::string off_text(const targets::TriangleMesh& mesh) {
  std::ostringstream out;
  out.precision(9);
  out << "OFF\n# a mesh\n" << mesh.vertices.size() << " " << mesh.triangles.size() << " 0\n";
  for (const auto& p : mesh.vertices) out << p.x() << " " << p.y() << " " << p.z() << "\n";
  for (const auto& t : mesh.triangles) out << "3 " << t[0] << " " << t[1] << " " << t[2] << " 255 0 0\n";
  return out.str();
}

inline std::string stl_binary(const targets::TriangleMesh& mesh) {
  std::string bytes(80, 'x');
  append_binary(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    bytes += std::string(12, '\0');
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < 3; ++c) append_binary(bytes, static_cast<float>(mesh.corner(t, k)[c]));
    bytes += std::string(2, '\0');
  }
  return bytes;
}

inline std::string stl_text(const targets::TriangleMesh& mesh) {
  std::ostringstream out;
  out.precision(9);
  out << "solid head of\n";
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    out << " facet normal nan 0 0\n  outer loop\n";
    for (int k = 0; k < 3; ++k) out << "   vertex " << mesh.corner(t, k).transpose() << '\n';
    out << "  endloop\n endfacet\n";
  }
  out << "endsolid head of\n";
  return out.str();
}

inline std::string ply_header(const targets::TriangleMesh& mesh, const std::string& format) {
  return "ply\nformat " + format + " 1.0\ncomment a mesh\nelement vertex " +
         std::to_string(mesh.vertices.size()) +
         "\nproperty float x\nproperty float y\nproperty uchar red\nproperty double z\nelement face " +
         std::to_string(mesh.triangles.size()) +
         "\nproperty uchar flags\nproperty list uchar int vertex_indices\nend_header\n";
}

inline std::string ply_text(const targets::TriangleMesh& mesh) {
  std::ostringstream out;
  out.precision(9);
  out << ply_header(mesh, "ascii");
  for (const auto& p : mesh.vertices) out << p.x() << ' ' << p.y() << " 7 " << p.z() << '\n';
  for (const auto& t : mesh.triangles) out << "0 3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return out.str();
}

inline std::string ply_binary(const targets::TriangleMesh& mesh, bool big_endian = false) {
  std::string bytes = ply_header(mesh, big_endian ? "binary_big_endian" : "binary_little_endian");
  for (const auto& p : mesh.vertices) {
    append_binary(bytes, static_cast<float>(p.x()), big_endian);
    append_binary(bytes, static_cast<float>(p.y()), big_endian);
    bytes += '\7';
    append_binary(bytes, p.z(), big_endian);
  }
  for (const auto& t : mesh.triangles) {
    bytes += std::string("\0\3", 2);
    for (const int corner : t) append_binary(bytes, static_cast<std::int32_t>(corner), big_endian);
  }
  return bytes;
}

}  // namespace kinetix::testing
