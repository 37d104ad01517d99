#include <bit>
#include <cstdint>

#include "targets/document/wording.hpp"
#include "targets/mesh/mesh_file.hpp"
#include "targets/mesh/mesh_words.hpp"
#include "targets/mesh/strict_mesh.hpp"

namespace kinetix::targets {
namespace {

// Bytes of a binary STL file. The header has 80 of title and 4 for the number of triangles. Each triangle has 12
// floats and 2 bytes of attributes.
constexpr std::size_t header_bytes = 84, triangle_bytes = 50;

std::size_t declared_triangles(const std::string& bytes) {
  std::uint32_t count = 0;
  for (int k = 0; k < 4; ++k)
    count |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[80 + k])) << (8 * k);
  return count;
}

void check_count(std::size_t triangles) {
  if (triangles > max_mesh_triangles)
    throw InvalidInput("has too many triangles: " + std::to_string(triangles) + "; at most " +
                       std::to_string(max_mesh_triangles) + " are allowed; thin the mesh out");
}

void append_bytes(std::string& bytes, std::uint32_t value) {
  for (int k = 0; k < 4; ++k) bytes += static_cast<char>(value >> (8 * k) & 0xff);
}

/// Goes through the grammar of an ASCII file: solid NAME, facets of one loop of three vertices, endsolid
/// NAME.
class StlText {
 public:
  explicit StlText(const std::string& bytes) : words_(bytes) {}

  std::string to_binary() {
    std::string keyword = next();
    while (!keyword.empty()) {
      if (keyword != "solid") refuse("solid");
      skip_name();
      read_solid();
      skip_name();
      keyword = next();
    }
    std::string binary(80, ' ');
    append_bytes(binary, static_cast<std::uint32_t>(triangles_));
    return binary + facets_;
  }

 private:
  std::string next() { return lower_case(words_.word_of_any_line()); }

  void skip_name() {
    while (!words_.word().empty()) continue;
  }

  void read_solid() {
    for (std::string keyword = next(); keyword != "endsolid"; keyword = next()) {
      if (keyword != "facet") refuse("facet or endsolid");
      check_count(++triangles_);
      read_facet();
    }
  }

  void read_facet() {
    expect("normal");
    for (int k = 0; k < 3; ++k) next();  // not used, and not always a number
    expect("outer");
    expect("loop");
    facets_.append(12, '\0');
    for (int corner = 0; corner < 3; ++corner) {
      expect("vertex");
      for (int k = 0; k < 3; ++k) {
        const auto coordinate = static_cast<float>(words_.number_of_any_line("a coordinate of a vertex"));
        append_bytes(facets_, std::bit_cast<std::uint32_t>(coordinate));
      }
    }
    facets_.append(2, '\0');
    expect("endloop");
    expect("endfacet");
  }

  void expect(const std::string& keyword) {
    if (next() != keyword) refuse(keyword);
  }

  [[noreturn]] void refuse(const std::string& wanted) const {
    const std::string_view word = words_.last_word();
    if (word.empty()) throw words_.error("ends where `" + wanted + "` belongs; the file is cut short");
    throw words_.error(in_ticks(word) + " stands where `" + wanted + "` belongs; the file is damaged");
  }

  MeshWords words_;
  std::string facets_;
  std::size_t triangles_ = 0;
};

bool is_text(const std::string& bytes) {
  MeshWords words(bytes);
  return lower_case(words.word_of_any_line()) == "solid" && bytes.find('\0') == std::string::npos;
}

}  // namespace

std::string strict_stl(const std::string& bytes) {
  const std::size_t declared = bytes.size() < header_bytes ? 0 : declared_triangles(bytes);
  const std::size_t length = header_bytes + triangle_bytes * declared;
  if (bytes.size() != length && is_text(bytes)) return StlText(bytes).to_binary();
  if (bytes.size() < length)
    throw InvalidInput("is not an STL file, or is cut short: " + byte_count(bytes.size()) + " for " +
                       std::to_string(declared) + " triangles, which need " + byte_count(length));
  check_count(declared);
  return bytes.substr(0, length);
}

}  // namespace kinetix::targets
