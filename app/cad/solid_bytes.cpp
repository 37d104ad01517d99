#include "app/cad/solid_bytes.hpp"

#include "app/io/bytes.hpp"

namespace kinetix::app::cad {
namespace {

FoundSolid read_solid(ByteReader& reader) {
  FoundSolid solid;
  solid.name = reader.extract_all<std::string>();
  solid.colour = reader.extract_all<std::string>();
  solid.points = reader.extract_all<std::vector<Eigen::Vector3d>>();
  solid.triangles = reader.extract_all<std::vector<std::array<int, 3>>>();
  for (const auto& triangle : solid.triangles)
    for (const int corner : triangle)
      if (corner < 0 || static_cast<std::size_t>(corner) >= solid.points.size())
        throw std::runtime_error("a triangle names a point that is not there");
  return solid;
}

}  // namespace

std::string to_bytes(const std::vector<FoundSolid>& solids) {
  std::string bytes;
  put(bytes, solids.size());
  for (const FoundSolid& solid : solids) {
    append_all(bytes, solid.name.data(), solid.name.size());
    append_all(bytes, solid.colour.data(), solid.colour.size());
    append_all(bytes, solid.points.data(), solid.points.size());
    append_all(bytes, solid.triangles.data(), solid.triangles.size());
  }
  return bytes;
}

std::vector<FoundSolid> read_solids(std::string_view bytes) {
  ByteReader reader(bytes);
  std::vector<FoundSolid> solids;
  for (auto count = reader.get<std::size_t>(); count > 0; --count) solids.push_back(read_solid(reader));
  return solids;
}

}  // namespace kinetix::app::cad
