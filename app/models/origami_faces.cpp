#include <cmath>
#include <nlohmann/json.hpp>

#include "app/models/model_file.hpp"
#include "targets/document/text_file.hpp"

namespace kinetix::app {
namespace {

using FacesJson = nlohmann::json;

/// Faces of a frame of a FOLD file.
class ListedFaces {
 public:
  ListedFaces(const FacesJson& frame, const std::string& file) : file_(file) {
    for (const FacesJson& point : list(frame, "vertices_coords")) add_vertex(point);
    for (const FacesJson& face : list(frame, "faces_vertices")) add_face(face);
  }

  targets::TriangleMesh mesh;

 private:
  [[noreturn]] void refuse(const std::string& reason) const { throw InvalidInput(reason, {file_}); }

  const FacesJson& list(const FacesJson& map, const char* key) const {
    const auto found = map.is_object() ? map.find(key) : map.end();
    if (!map.is_object() || found == map.end() || !found->is_array())
      refuse(std::string("this FOLD file has no `") + key + "`. Give vertices_coords and faces_vertices");
    return *found;
  }

  void add_vertex(const FacesJson& point) {
    Eigen::Vector3d& p = mesh.vertices.emplace_back(Eigen::Vector3d::Zero());
    if (!point.is_array() || point.size() < 2 || point.size() > 3)
      refuse("a vertex has other than 2 or 3 coordinates");
    for (std::size_t k = 0; k < point.size(); ++k) {
      if (!point[k].is_number() || !std::isfinite(point[k].get<double>()))
        refuse("a coordinate of a vertex is not a finite number");
      p[static_cast<int>(k)] = point[k].get<double>();
    }
  }

  void add_face(const FacesJson& face) {
    if (!face.is_array() || face.size() > targets::max_face_corners)
      refuse("a face is not a list of corners");
    for (const FacesJson& corner : face)
      if (!corner.is_number_unsigned() || corner.get<std::size_t>() >= mesh.vertices.size())
        refuse("a face names a vertex that is not there");
    for (std::size_t k = 2; k < face.size(); ++k)
      mesh.triangles.push_back({face[0].get<int>(), face[k - 1].get<int>(), face[k].get<int>()});
    if (mesh.triangles.size() > max_model_triangles) refuse("has too many faces. Simplify the model");
  }

  const std::string& file_;
};

}  // namespace

targets::TriangleMesh read_origami_faces(const std::string& bytes, const std::string& file) {
  if (targets::find_too_deep(bytes)) throw InvalidInput("has lists in one another, over 64 deep", {file});
  const FacesJson root = FacesJson::parse(bytes, nullptr, false);
  if (!root.is_object())
    throw InvalidInput("is not a FOLD file: its JSON cannot be read. Export it again", {file});
  targets::TriangleMesh mesh = ListedFaces(root, file).mesh;
  if (mesh.triangles.empty())
    throw InvalidInput("has no faces. Give a FOLD file with faces_vertices", {file});
  return joined(mesh);
}

}  // namespace kinetix::app
