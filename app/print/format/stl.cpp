#include <Eigen/Geometry>
#include <bit>
#include <cstdint>
#include <cstring>

#include "app/print/format/formats.hpp"
#include "app/print/format/parts.hpp"
#include "app/print/format/stl_text.hpp"

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
  std::string out = "kinetix " + name;  // never "solid", by which readers know text
  out.resize(header_bytes, ' ');
  out.reserve(header_bytes + 4 + triangle_bytes * solid.triangles.size());
  const auto count = static_cast<std::uint32_t>(solid.triangles.size());
  out.append(reinterpret_cast<const char*>(&count), sizeof count);
  for (const auto& [a, b, c] : solid.triangles) {
    // The normal of the corners as they are written: of slender triangles that of the exact ones is another.
    const Eigen::Vector3f p = solid.points[a].cast<float>(), q = solid.points[b].cast<float>(),
                          r = solid.points[c].cast<float>();
    add_vector((q - p).cast<double>().cross((r - p).cast<double>()).normalized().cast<float>(), out);
    for (const Eigen::Vector3f* corner : {&p, &q, &r}) add_vector(*corner, out);
    out.append(2, '\0');
  }
  return out;
}

namespace {

void add_tile(const PrintJob& job, int tile, std::vector<NamedContent>& files) {
  const TileParts parts = tile_parts(job, tile);
  const std::string name = "tile_" + std::to_string(tile + 1);
  files.push_back({name + ".stl", stl_text(job.sheet.name + " " + name, parts.hard)});
  if (!parts.soft.points.empty())
    files.push_back({name + "_soft.stl", stl_text(job.sheet.name + " " + name + " soft", parts.soft)});
}

std::vector<NamedContent> write_stl(const PrintJob& job) {
  const model::Polyhedron hard = hard_part(job), soft = soft_part(job);
  std::vector<NamedContent> files{{"hard.stl", stl_text(job.sheet.name + " hard", hard)}};
  files.push_back({"all.stl", stl_text(job.sheet.name, joined(hard, soft))});
  if (!soft.points.empty()) files.push_back({"soft.stl", stl_text(job.sheet.name + " soft", soft)});
  if (job.sheet.loose_rods() > 0)
    files.push_back({"rods.stl", stl_text(job.sheet.name + " rods", laid_out_rods(job.sheet))});
  if (job.sheet.tiles.count() > 1)
    for (int tile = 0; tile < job.sheet.tiles.count(); ++tile) add_tile(job, tile, files);
  return files;
}

}  // namespace

// Name, meaning and how it is written: stl.
const PrintFormat stl_format = {
    .name = "stl", .meaning = "triangles for any slicer", .write = write_stl, .lies_on_bed = true};

}  // namespace kinetix::app
