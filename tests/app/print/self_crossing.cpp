// self_crossing FILE.stl: counts the faces of a binary STL file, and checks with CGAL whether they close and whether
// any two cross. Only the tests use this program, since CGAL's algorithms are under the GPL.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <cstdint>
#include <fstream>
#include <iostream>
#include <map>

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

struct Corner {
  float x, y, z;
  auto operator<=>(const Corner&) const = default;
};

/// Reads a binary STL file.
/// @return whether all faces could be added, each edge to two of them
bool read(const std::string& file, Mesh& mesh) {
  std::ifstream in(file, std::ios::binary);
  char header[80];
  std::uint32_t count = 0;
  in.read(header, sizeof header).read(reinterpret_cast<char*>(&count), sizeof count);
  std::map<Corner, Mesh::Vertex_index> known;
  for (std::uint32_t k = 0; k < count && in; ++k) {
    float numbers[12];
    char rest[2];
    in.read(reinterpret_cast<char*>(numbers), sizeof numbers).read(rest, sizeof rest);
    std::array<Mesh::Vertex_index, 3> face;
    for (int c = 0; c < 3; ++c) {
      const Corner at{numbers[3 + 3 * c], numbers[4 + 3 * c], numbers[5 + 3 * c]};
      const auto [entry, is_new] = known.try_emplace(at);
      if (is_new) entry->second = mesh.add_vertex({at.x, at.y, at.z});
      face[c] = entry->second;
    }
    if (mesh.add_face(face[0], face[1], face[2]) == Mesh::null_face()) return false;
  }
  return static_cast<bool>(in);
}

}  // namespace

int main(int, char** argv) {
  Mesh mesh;
  const bool fits = read(argv[1], mesh);
  std::cout << "faces " << mesh.number_of_faces() << "\nmanifold " << fits << "\nclosed "
            << CGAL::is_closed(mesh) << "\ncrossing "
            << CGAL::Polygon_mesh_processing::does_self_intersect(mesh) << "\n";
  return 0;
}
