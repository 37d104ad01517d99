#include "targets/mesh/mesh_file.hpp"

#include <bit>
#include <charconv>
#include <cstdint>
#include <filesystem>

#include "model/base/invalid_input.hpp"
#include "model/base/loaded_module.hpp"
#include "targets/document/number.hpp"
#include "targets/document/text_file.hpp"
#include "targets/document/wording.hpp"
#include "targets/mesh/mesh_formats.hpp"

namespace kinetix::targets {
namespace {

/// Returns the end of messages about files without a mesh.
std::string wanted_mesh() { return std::string(". Give a file of triangles or polygons: ") + mesh_formats; }

TriangleMesh parse(const std::string& bytes, const std::string& ending) {
  if (ending == ".ply") return parse_ply(bytes);
  if (ending == ".off") return parse_off(bytes);
  if (ending == ".obj") {
    const std::string strict = strict_obj(bytes);
    return strict.find('f') == std::string::npos ? TriangleMesh() : assimp_mesh(strict, "obj");
  }
  const std::string strict = strict_stl(bytes);
  return strict.size() == empty_stl_bytes ? TriangleMesh() : assimp_mesh(strict, "stl");
}

void check(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw InvalidInput("has no triangles" + wanted_mesh());
  if (mesh.triangles.size() > max_mesh_triangles)
    throw InvalidInput("has too many triangles; at most " + std::to_string(max_mesh_triangles) +
                       " are allowed. Thin the mesh out");
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (!mesh.vertices[v].allFinite())
      throw InvalidInput("vertex " + std::to_string(v + 1) + " has a coordinate that is not a finite number");
}

}  // namespace

TriangleMesh read_mesh(const std::string& file) {
  const std::string ending = lower_case(std::filesystem::path(file).extension().string());
  if (ending != ".obj" && ending != ".stl" && ending != ".ply" && ending != ".off")
    throw InvalidInput("has no known ending of a mesh format" + wanted_mesh(), {file});
  const std::string bytes = read_bytes(file, max_mesh_bytes);
  try {
    const TriangleMesh mesh = parse(bytes, ending);
    check(mesh);
    return joined(mesh);
  } catch (const InvalidInput& e) {
    throw InvalidInput(e.reason(), {file, e.place().line, e.place().column, {}});
  }
}

FileMesh read_mesh_at(const Node& key, const MeshReader& read) {
  const std::string name = key.text(std::string("the path of a mesh: ") + mesh_formats);
  const std::string file = (std::filesystem::path(key.folder()) / name).string();
  const HiddenQuotes hidden(file, key.folder());
  try {
    return read(file);
  } catch (const InvalidInput& e) {
    throw key.error(e.what());
  }
}

TriangleMesh assimp_mesh(const std::string& bytes, const std::string& format) {
  TriangleMesh mesh;
  std::string refusal;
  reinterpret_cast<decltype(&kinetix_assimp_mesh)>(
      model::module_function("kinetix-mesh.so", "kinetix_assimp_mesh"))(bytes, format, mesh, refusal);
  if (!refusal.empty()) throw InvalidInput("is damaged: " + refusal);
  return mesh;
}

namespace {

class ObjReader {
 public:
  explicit ObjReader(const std::string& bytes) : tokens_(bytes, true) { strict_.reserve(bytes.size()); }

  std::string read() {
    while (tokens_.next_line()) {
      const std::string_view keyword = tokens_.word();
      if (keyword == "v") read_vertex();
      if (keyword == "f") read_face();
    }
    if (highest_ > vertices_) throw highest_error_;
    return std::move(strict_);
  }

 private:
  void read_vertex() {
    ++vertices_;
    strict_ += 'v';
    for (int k = 0; k < 3; ++k) add_word(shortest_text(tokens_.number("a coordinate of a vertex")));
    strict_ += '\n';
  }

  void read_face() {
    std::vector<long> corners;
    for (std::string_view word = tokens_.word(); !word.empty() && word[0] != '#'; word = tokens_.word()) {
      corners.push_back(index(word));
      if (corners.size() > max_face_corners)
        throw tokens_.error("a face of more than " + std::to_string(max_face_corners) + " corners");
    }
    if (corners.size() < 3) return;
    triangles_ += corners.size() - 2;
    if (triangles_ > max_mesh_triangles)
      throw tokens_.error("too many triangles; at most " + std::to_string(max_mesh_triangles) +
                          " are allowed. Thin the mesh out");
    strict_ += 'f';
    for (const long corner : corners) add_word(std::to_string(corner));
    strict_ += '\n';
  }

  /// Returns the vertex, from 1, of a corner such as 7, 7/2, 7//3 or -1 (the last vertex so far).
  long index(std::string_view word) {
    const std::string_view text = word.substr(0, word.find('/'));
    long value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value == 0)
      throw tokens_.error(in_ticks(word) + " is not a corner of a face. Give vertex indices");
    if (value < 0) value += vertices_ + 1;
    if (value < 1) throw missing_vertex(word);
    if (value > highest_) {
      highest_ = value;
      highest_error_ = missing_vertex(word);
    }
    return value;
  }

  InvalidInput missing_vertex(std::string_view word) const {
    return tokens_.error("the corner " + in_ticks(word) + " of a face names a vertex that is not there");
  }

  void add_word(std::string_view word) {
    strict_ += ' ';
    strict_ += word;
  }

  MeshTokens tokens_;
  std::string strict_;
  long vertices_ = 0, highest_ = 0;
  std::size_t triangles_ = 0;
  InvalidInput highest_error_{""};
};

}  // namespace

std::string strict_obj(const std::string& bytes) { return ObjReader(bytes).read(); }

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
                       std::to_string(max_mesh_triangles) + " are allowed. Thin the mesh out");
}

void append_bytes(std::string& bytes, std::uint32_t value) {
  for (int k = 0; k < 4; ++k) bytes += static_cast<char>(value >> (8 * k) & 0xff);
}

/// Goes through the grammar of an ASCII file: solid NAME, facets of one loop of three vertices, endsolid
/// NAME.
class StlText {
 public:
  explicit StlText(const std::string& bytes) : tokens_(bytes) {}

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
  std::string next() { return lower_case(tokens_.word_of_any_line()); }

  void skip_name() {
    while (!tokens_.word().empty()) continue;
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
        const auto coordinate = static_cast<float>(tokens_.number_of_any_line("a coordinate of a vertex"));
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
    const std::string_view word = tokens_.last_word();
    if (word.empty())
      throw tokens_.error("ends where `" + wanted + "` is expected: the file is incomplete. Export it again");
    throw tokens_.error(in_ticks(word) + " is found instead of `" + wanted +
                        "`: the file is damaged. Export it again");
  }

  MeshTokens tokens_;
  std::string facets_;
  std::size_t triangles_ = 0;
};

bool is_text(const std::string& bytes) {
  MeshTokens words(bytes);
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
