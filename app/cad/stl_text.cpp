#include "app/cad/stl_text.hpp"

#include <Eigen/Geometry>
#include <bit>
#include <cstdint>

namespace kinetix::app {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is little-endian");

constexpr std::size_t header_bytes = 80;    // of binary STL
constexpr std::size_t triangle_bytes = 50;  // normal, three corners and two bytes without a meaning

void add_vector(const Eigen::Vector3f& v, std::string& out) {
  out.append(reinterpret_cast<const char*>(v.data()), 3 * sizeof(float));
}

}  // namespace

std::string stl_text(const std::string& name, const model::Polyhedron& solid) {
  std::string out = "kinetix " + name;  // never "solid", by which readers recognise text files
  out.resize(header_bytes, ' ');
  out.reserve(header_bytes + 4 + triangle_bytes * solid.triangles.size());
  const auto count = static_cast<std::uint32_t>(solid.triangles.size());
  out.append(reinterpret_cast<const char*>(&count), sizeof count);
  for (const auto& [a, b, c] : solid.triangles) {
    // Normal of the corners as written: rounding to float changes the normal of slender triangles.
    const Eigen::Vector3f p = solid.points[a].cast<float>(), q = solid.points[b].cast<float>(),
                          r = solid.points[c].cast<float>();
    add_vector((q - p).cast<double>().cross((r - p).cast<double>()).normalized().cast<float>(), out);
    for (const Eigen::Vector3f* corner : {&p, &q, &r}) add_vector(*corner, out);
    out.append(2, '\0');
  }
  return out;
}

}  // namespace kinetix::app
