#include "targets/mesh/mesh_formats.hpp"

#include "targets/document/wording.hpp"
#include "targets/mesh/mesh_file.hpp"

namespace kinetix::targets {
namespace {

class OffReader {
 public:
  explicit OffReader(const std::string& bytes) : tokens_(bytes) {}

  TriangleMesh read() {
    read_header();
    for (long v = 0; v < vertices_; ++v) read_vertex();
    for (long f = 0; f < faces_; ++f) read_face();
    return std::move(mesh_);
  }

 private:
  /// Moves to the next line with data. @return its first word; empty at the end of the file
  std::string_view first_word() {
    while (tokens_.next_line()) {
      const std::string_view word = tokens_.word();
      if (!word.empty() && word[0] != '#') return word;
    }
    return {};
  }

  std::string_view needed_word(const char* what) {
    const std::string_view word = first_word();
    if (word.empty())
      throw tokens_.error(std::string("ends where ") + what +
                          " is expected: the file is incomplete. Export it again");
    return word;
  }

  void read_header() {
    const std::string keyword(first_word());
    if (!keyword.ends_with("OFF"))
      throw tokens_.error("is not an OFF file: it does not start with `OFF`. Export it again");
    if (keyword.find_first_of("4n") != std::string::npos)
      throw tokens_.error(in_ticks(keyword) +
                          " is a mesh of other than three dimensions. Give x, y and z alone");
    std::string_view word = tokens_.word();
    if (word == "BINARY") throw tokens_.error("is a binary OFF file. Export it as text");
    if (word.empty() || word[0] == '#') word = needed_word("the number of vertices");
    vertices_ = tokens_.integer_in(word, "the number of vertices");
    faces_ = tokens_.integer_in(tokens_.word(), "the number of faces");
    if (vertices_ < 0 || faces_ < 0) throw tokens_.error("the number is negative. Export the file again");
  }

  void read_vertex() {
    constexpr const char* what = "a coordinate of a vertex";
    Eigen::Vector3d& p = mesh_.vertices.emplace_back();
    p.x() = tokens_.number_in(needed_word("a vertex"), what);
    p.y() = tokens_.number(what);
    p.z() = tokens_.number(what);
  }

  void read_face() {
    const long count = tokens_.integer_in(needed_word("a face"), "the number of corners of a face");
    if (count < 0 || count > static_cast<long>(max_face_corners))
      throw tokens_.error("a face of " + std::to_string(count) + " corners; at most " +
                          std::to_string(max_face_corners) + " are allowed. Split the face");
    std::vector<int> corners;
    for (long k = 0; k < count; ++k) corners.push_back(read_corner());
    for (std::size_t k = 2; k < corners.size(); ++k) {
      if (mesh_.triangles.size() == max_mesh_triangles)
        throw tokens_.error("too many triangles; at most " + std::to_string(max_mesh_triangles) +
                            " are allowed. Thin the mesh out");
      mesh_.triangles.push_back({corners[0], corners[k - 1], corners[k]});
    }
  }

  int read_corner() {
    const long corner = tokens_.integer_in(tokens_.word(), "a corner of a face");
    if (corner < 0 || corner >= static_cast<long>(mesh_.vertices.size()))
      throw tokens_.error("the corner " + in_ticks(tokens_.last_word()) +
                          " of a face names a vertex that is not there. Give indices from 0");
    return static_cast<int>(corner);
  }

  MeshTokens tokens_;
  long vertices_ = 0, faces_ = 0;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh parse_off(const std::string& bytes) { return OffReader(bytes).read(); }

}  // namespace kinetix::targets
