#include <charconv>
#include <vector>

#include "targets/document/number.hpp"
#include "targets/document/wording.hpp"
#include "targets/mesh/mesh_file.hpp"
#include "targets/mesh/mesh_words.hpp"
#include "targets/mesh/strict_mesh.hpp"

namespace kinetix::targets {
namespace {

class ObjReader {
 public:
  explicit ObjReader(const std::string& bytes) : words_(bytes, true) { strict_.reserve(bytes.size()); }

  std::string read() {
    while (words_.next_line()) {
      const std::string_view keyword = words_.word();
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
    for (int k = 0; k < 3; ++k) add_word(shortest_text(words_.number("a coordinate of a vertex")));
    strict_ += '\n';
  }

  void read_face() {
    std::vector<long> corners;
    for (std::string_view word = words_.word(); !word.empty() && word[0] != '#'; word = words_.word()) {
      corners.push_back(index(word));
      if (corners.size() > max_face_corners)
        throw words_.error("a face of more than " + std::to_string(max_face_corners) + " corners");
    }
    if (corners.size() < 3) return;
    triangles_ += corners.size() - 2;
    if (triangles_ > max_mesh_triangles)
      throw words_.error("too many triangles; at most " + std::to_string(max_mesh_triangles) +
                         " are allowed; thin the mesh out");
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
      throw words_.error(in_ticks(word) + " stands where a corner of a face belongs; give vertex indices");
    if (value < 0) value += vertices_ + 1;
    if (value < 1) throw missing_vertex(word);
    if (value > highest_) {
      highest_ = value;
      highest_error_ = missing_vertex(word);
    }
    return value;
  }

  InvalidInput missing_vertex(std::string_view word) const {
    return words_.error("the corner " + in_ticks(word) + " of a face names a vertex that is not there");
  }

  void add_word(std::string_view word) {
    strict_ += ' ';
    strict_ += word;
  }

  MeshWords words_;
  std::string strict_;
  long vertices_ = 0, highest_ = 0;
  std::size_t triangles_ = 0;
  InvalidInput highest_error_{""};
};

}  // namespace

std::string strict_obj(const std::string& bytes) { return ObjReader(bytes).read(); }

}  // namespace kinetix::targets
