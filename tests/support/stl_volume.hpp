#pragma once

#include <Eigen/Geometry>
#include <cstring>
#include <string>

namespace kinetix::testing {

/// Returns the volume of a binary STL file's bytes, mm^3; in doubles, since slicers add up in floats.
inline double volume_of_stl(const std::string& bytes) {
  constexpr std::size_t header = 84, triangle = 50;  // bytes
  double volume = 0;
  for (std::size_t at = header; at + triangle <= bytes.size(); at += triangle) {
    float n[12];  // normal and three corners
    std::memcpy(n, bytes.data() + at, sizeof n);
    const Eigen::Vector3d a(n[3], n[4], n[5]), b(n[6], n[7], n[8]), c(n[9], n[10], n[11]);
    volume += a.dot(b.cross(c)) / 6;
  }
  return volume;
}

}  // namespace kinetix::testing
