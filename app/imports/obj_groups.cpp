#include <charconv>

#include "app/imports/model_file.hpp"
#include "model/base/invalid_input.hpp"
#include "targets/mesh/mesh_file.hpp"
#include "targets/mesh/mesh_words.hpp"

namespace kinetix::app {
namespace {

/// Vertices and faces of an OBJ file by its objects, groups and materials.
class ObjGroups {
 public:
  ObjGroups(const std::string& bytes, const std::string& file) : words_(bytes, true), out_{file, {}} {}

  ModelFile read() {
    while (words_.next_line()) {
      const std::string key(words_.word());
      if (key == "v") read_vertex();
      if (key == "o" || key == "g") name_ = rest();
      if (key == "usemtl") material_ = rest();
      if (key == "f") read_face();
    }
    return std::move(out_);
  }

 private:
  std::string rest() {
    std::string out;
    for (std::string_view word = words_.word(); !word.empty(); word = words_.word())
      out += (out.empty() ? "" : " ") + std::string(word);
    return out;
  }

  void read_vertex() {
    Eigen::Vector3d p;
    for (double& x : p) x = words_.number("a coordinate of a vertex");
    points_.push_back(p);
  }

  int index(std::string_view word) const {
    int k = 0;
    const std::string_view digits = word.substr(0, word.find('/'));
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), k);
    const int count = static_cast<int>(points_.size());
    const int place = k > 0 ? k - 1 : count + k;
    if (error != std::errc() || end != digits.data() + digits.size() || k == 0 || place < 0 || place >= count)
      throw words_.error("is not a vertex of the file");
    return place;
  }

  void read_face() {
    std::vector<int> corners;
    for (std::string_view word = words_.word(); !word.empty(); word = words_.word())
      corners.push_back(index(word));
    if (corners.size() < 3) return;
    if (corners.size() > targets::max_face_corners) throw words_.error("a face of too many corners");
    Indexed& mesh = mesh_of(name_, material_);
    for (int& c : corners) {
      const auto [found, is_new] =
          mesh.own.try_emplace(c, static_cast<int>(out_.meshes[mesh.at].soup.points.size()));
      if (is_new) out_.meshes[mesh.at].soup.points.push_back(points_[c]);
      c = found->second;
    }
    out_.meshes[mesh.at].soup.add_face(corners);
  }

  struct Indexed {
    std::size_t at;
    std::map<int, int> own;
  };

  Indexed& mesh_of(const std::string& name, const std::string& material) {
    const auto [found, is_new] = meshes_.try_emplace({name, material}, Indexed{out_.meshes.size(), {}});
    if (is_new) out_.meshes.push_back({name, material, {}});
    return found->second;
  }

  targets::MeshWords words_;
  std::vector<Eigen::Vector3d> points_;
  std::string name_, material_;
  std::map<std::pair<std::string, std::string>, Indexed> meshes_;
  ModelFile out_;
};

}  // namespace

ModelFile read_groups_of_obj(const std::string& bytes, const std::string& file) {
  try {
    return ObjGroups(bytes, file).read();
  } catch (const InvalidInput& e) {
    throw InvalidInput(e.reason(), {file, e.place().line, e.place().column, {}});
  }
}

}  // namespace kinetix::app
