#include "app/cad/cad_formats.hpp"

#include <bit>
#include <cstdint>
#include <filesystem>

#include "app/io/reader_program.hpp"
#include "model/base/invalid_input.hpp"
#include "model/base/loaded_module.hpp"

namespace kinetix::app::cad {
namespace {

// CPU time limit in s. Files of this program take 1 s per MiB. Damaged files that crash the reader do so at once.
constexpr unsigned long min_s = 20, s_per_mebibyte = 10;
constexpr unsigned long most_bytes = 4ul << 30;  // bytes: 4 GiB of address space, libraries included

void* cad_function(const char* name) { return model::module_function("kinetix-cad.so", name); }

}  // namespace

void load() { cad_function("kinetix_write_step"); }

std::string step_text(const Product& product) {
  std::string text;
  reinterpret_cast<decltype(&kinetix_write_step)>(cad_function("kinetix_write_step"))(product, text);
  return text;
}

std::vector<FoundSolid> solids_of_step(const std::string& file) {
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(file, unknown);
  const unsigned long mebibytes = unknown ? 0 : static_cast<unsigned long>(size >> 20);
  const std::string bytes =
      run_reader("kinetix-read-step", {file}, {min_s + s_per_mebibyte * mebibytes, most_bytes});
  try {
    return read_solids(bytes);
  } catch (const std::runtime_error& e) {
    throw InvalidInput(std::string("is damaged: ") + e.what());
  }
}

}  // namespace kinetix::app::cad

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
