#include "app/models/model_file.hpp"

#include <fmt/format.h>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <set>

#include "app/cad/cad_formats.hpp"
#include "model/base/algorithms.hpp"
#include "targets/document/text_file.hpp"
#include "targets/document/wording.hpp"
#include "targets/mesh/mesh_formats.hpp"

namespace kinetix::app {
namespace {

constexpr double max_coordinate =
    1e9;  // of a point, in the file's unit: a thousand kilometres of millimetres

ModelFile one_mesh(const std::string& file) {
  const targets::TriangleMesh mesh = targets::read_mesh(file);
  ModelFile out{file, {}};
  FoundMesh& found = out.meshes.emplace_back();
  found.soup.points = mesh.vertices;
  found.soup.triangles = mesh.triangles;
  return out;
}

ModelFile read_by_ending(const std::string& file) {
  const std::string ending = targets::lower_case(std::filesystem::path(file).extension().string());
  if (ending == ".step" || ending == ".stp") return read_step(file);
  if (ending == ".stl" || ending == ".ply" || ending == ".off") return one_mesh(file);
  const auto bytes = [&] { return targets::read_bytes(file, targets::max_mesh_bytes); };
  if (ending == ".3mf") return read_threemf(bytes(), file);
  if (ending == ".obj") return read_groups_of_obj(bytes(), file);
  if (ending == ".glb") return read_glb(bytes(), file);
  std::error_code failure;  // set for names that no file can have: such a file does not exist
  if (!std::filesystem::exists(file, failure)) throw InvalidInput("no such file", {file});
  if (std::filesystem::is_directory(file, failure))
    throw InvalidInput(
        std::string("this is a folder without vertices.txt. Give a folder of tiles, or a file: ") +
            targets::mesh_formats,
        {file});
  throw InvalidInput(std::string("the ending is not that of a model. Give a file: ") + targets::mesh_formats,
                     {file});
}

/// Vertices and faces of an OBJ file by its objects, groups and materials.
class ObjGroups {
 public:
  ObjGroups(const std::string& bytes, const std::string& file) : tokens_(bytes, true), out_{file, {}} {}

  ModelFile read() {
    while (tokens_.next_line()) {
      const std::string key(tokens_.word());
      if (key == "v") read_vertex();
      if (key == "o" || key == "g") name_ = rest();
      if (key == "usemtl") material_ = rest();
      if (key == "f") read_face();
    }
    return std::move(out_);
  }

  /// Returns the faces as tiles (read_tiles_of_obj). @pre read()
  std::optional<model::TileSheet> tiles() const {
    std::set<std::pair<int, int>> edges;
    std::map<int, std::pair<int, int>> first;  // tile and corner by vertex
    model::TileSheet out;
    for (const std::vector<int>& face : faces_) {
      const int tile = static_cast<int>(out.tiles.size());
      std::vector<Eigen::Vector3d>& corners = out.tiles.emplace_back();
      for (std::size_t k = 0; k < face.size(); ++k) {
        if (!edges.insert(std::minmax(face[k], face[(k + 1) % face.size()])).second) return std::nullopt;
        corners.push_back(points_[face[k]]);
        const auto [at, is_new] = first.try_emplace(face[k], tile, static_cast<int>(k));
        if (!is_new)
          out.joints.push_back({at->second.first, at->second.second, tile, static_cast<int>(k), true});
      }
    }
    return out.joints.empty() ? std::nullopt : std::optional(std::move(out));
  }

 private:
  std::string rest() {
    std::string out;
    for (std::string_view word = tokens_.word(); !word.empty(); word = tokens_.word())
      out += (out.empty() ? "" : " ") + std::string(word);
    return out;
  }

  void read_vertex() {
    Eigen::Vector3d p;
    for (double& x : p) x = tokens_.number("a coordinate of a vertex");
    points_.push_back(p);
  }

  int index(std::string_view word) const {
    int k = 0;
    const std::string_view digits = word.substr(0, word.find('/'));
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), k);
    const int count = static_cast<int>(points_.size());
    const int place = k > 0 ? k - 1 : count + k;
    if (error != std::errc() || end != digits.data() + digits.size() || k == 0 || place < 0 || place >= count)
      throw tokens_.error("is not a vertex of the file");
    return place;
  }

  void read_face() {
    std::vector<int> corners;
    for (std::string_view word = tokens_.word(); !word.empty(); word = tokens_.word())
      corners.push_back(index(word));
    if (corners.size() < 3) return;
    if (corners.size() > targets::max_face_corners) throw tokens_.error("a face of too many corners");
    faces_.push_back(corners);
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

  targets::MeshTokens tokens_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::vector<int>> faces_;  ///< vertices of each
  std::string name_, material_;
  std::map<std::pair<std::string, std::string>, Indexed> meshes_;
  ModelFile out_;
};

}  // namespace

ModelFile read_model_file(const std::string& file) {
  ModelFile model = read_by_ending(file);
  std::size_t triangles = 0;
  for (const FoundMesh& mesh : model.meshes) {
    triangles += mesh.soup.triangles.size();
    for (const Eigen::Vector3d& p : mesh.soup.points)
      if (!(p.cwiseAbs().maxCoeff() <= max_coordinate))
        throw InvalidInput("a coordinate is not a number within a thousand million. Correct the model",
                           {file});
  }
  if (triangles == 0) throw InvalidInput("has no triangles", {file});
  if (triangles > max_model_triangles)
    throw InvalidInput("has " + std::to_string(triangles) + " triangles, and the limit is " +
                           std::to_string(max_model_triangles) + ". Simplify the model",
                       {file});
  return model;
}

targets::FileMesh read_mesh_file(const std::string& file) {
  const std::string ending = targets::lower_case(std::filesystem::path(file).extension().string());
  if (ending == ".fold")
    return {read_origami_faces(targets::read_bytes(file, targets::max_mesh_bytes), file)};
  static const std::set<std::string> models = {".3mf", ".glb", ".step", ".stp"};
  if (!models.contains(ending)) return targets::read_plain_mesh(file);
  const ModelFile model = read_model_file(file);
  targets::FileMesh out{{}, model.unit_mm};
  for (const FoundMesh& part : model.meshes) {
    const int first = static_cast<int>(out.mesh.vertices.size());
    model::append(part.soup.points, out.mesh.vertices);
    for (targets::Triangle triangle : part.soup.triangles) {
      for (int& corner : triangle) corner += first;
      out.mesh.triangles.push_back(triangle);
    }
  }
  out.mesh = joined(out.mesh);
  return out;
}

ModelFile read_step(const std::string& file) {
  const std::string start = targets::read_bytes(file, targets::max_mesh_bytes).substr(0, 200);
  if (start.find("ISO-10303-21") == std::string::npos)
    throw InvalidInput("this is not a STEP file: it does not start with ISO-10303-21. Export it again",
                       {file});
  ModelFile out{file, {}, 1};
  try {
    for (cad::FoundSolid& solid : cad::solids_of_step(file))
      out.meshes.push_back({std::move(solid.name),
                            std::move(solid.colour),
                            {std::move(solid.points), std::move(solid.triangles)}});
  } catch (const InvalidInput& e) {
    throw InvalidInput(e.reason(), {file});
  }
  if (out.meshes.empty())
    throw InvalidInput("the file has no solids. Give a STEP file of solid bodies", {file});
  return out;
}

ModelFile read_groups_of_obj(const std::string& bytes, const std::string& file) {
  try {
    return ObjGroups(bytes, file).read();
  } catch (const InvalidInput& e) {
    throw InvalidInput(e.reason(), {file, e.place().line, e.place().column, {}});
  }
}

std::optional<model::TileSheet> read_tiles_of_obj(const std::string& file) {
  if (targets::lower_case(std::filesystem::path(file).extension().string()) != ".obj") return std::nullopt;
  try {
    const std::string bytes = targets::read_bytes(file, targets::max_mesh_bytes);
    ObjGroups groups(bytes, file);
    groups.read();
    return groups.tiles();
  } catch (const InvalidInput&) {
    return std::nullopt;  // the reader of models reports the fault
  }
}

namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_tile_bytes = 64 << 20;  // bytes of a file: more than a million corners

/// Number in a text, with its column.
struct FoundNumber {
  double value;
  int column;  ///< from 1
};

struct NumberLine {
  int number;  ///< from 1
  std::vector<FoundNumber> numbers;
};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == ','; }

/// Reads a line of finite numbers between blanks.
std::vector<FoundNumber> numbers_of(const std::string& line, const Place& place) {
  std::vector<FoundNumber> out;
  const char* const end = line.data() + line.size();
  for (const char* at = line.data(); at != end;) {
    if (is_blank(*at)) {
      ++at;
      continue;
    }
    const int column = static_cast<int>(at - line.data()) + 1;
    FoundNumber found{0, column};
    const auto [stop, error] = std::from_chars(at, end, found.value);
    if (error != std::errc() || (stop != end && !is_blank(*stop)) || !std::isfinite(found.value))
      throw InvalidInput("this is not a number. Give numbers between blanks",
                         {place.file, place.line, column});
    out.push_back(found);
    at = stop;
  }
  return out;
}

/// Reads the lines that are not empty.
std::vector<NumberLine> number_lines(const std::string& file) {
  const std::string text = targets::read_text_file(file, max_tile_bytes);
  std::vector<NumberLine> out;
  int number = 0;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find('\n', from), text.size());
    NumberLine line{++number, numbers_of(text.substr(from, to - from), {file, number})};
    if (!line.numbers.empty()) out.push_back(std::move(line));
    from = to + 1;
  }
  return out;
}

using Corners = std::vector<std::vector<Eigen::Vector3d>>;

Corners read_corners(const std::string& file) {
  Corners out;
  for (const NumberLine& line : number_lines(file)) {
    if (line.numbers.size() % 3 != 0 || line.numbers.size() < 9)
      throw InvalidInput(fmt::format("the line has {} numbers. Give x, y and z of three corners or more",
                                     line.numbers.size()),
                         {file, line.number, 1});
    std::vector<Eigen::Vector3d>& tile = out.emplace_back();
    for (std::size_t k = 0; k < line.numbers.size(); k += 3)
      tile.emplace_back(line.numbers[k].value, line.numbers[k + 1].value, line.numbers[k + 2].value);
  }
  if (out.empty()) throw InvalidInput("the file has no tiles. Give one tile per line", {file});
  return out;
}

int whole(const FoundNumber& found, const std::string& file, int line) {
  if (found.value != std::floor(found.value) || std::abs(found.value) > 1e9)
    throw InvalidInput("this is not a whole number. Give a whole number", {file, line, found.column});
  return static_cast<int>(found.value);
}

std::vector<model::TileJoint> read_joints(const std::string& file) {
  std::vector<model::TileJoint> out;
  std::map<std::array<int, 4>, std::pair<std::size_t, int>> known;  // by corners: joint, and faces as bits
  for (const NumberLine& line : number_lines(file)) {
    if (line.numbers.size() != 4 && line.numbers.size() != 5)
      throw InvalidInput(
          fmt::format("the line has {} numbers. Give `tile corner tile corner [face]`", line.numbers.size()),
          {file, line.number, 1});
    std::array<int, 4> ends{};
    for (std::size_t k = 0; k < 4; ++k) ends[k] = whole(line.numbers[k], file, line.number);
    const int face = line.numbers.size() == 5 ? whole(line.numbers[4], file, line.number) : 1;
    if (face < 1 || face > 3)
      throw InvalidInput(fmt::format("face {} is not known. Give 1 (bottom), 2 (top) or 3 (both)", face),
                         {file, line.number, line.numbers[4].column});
    if (std::pair(ends[0], ends[1]) > std::pair(ends[2], ends[3])) {
      std::swap(ends[0], ends[2]);
      std::swap(ends[1], ends[3]);
    }
    const auto [at, is_new] = known.try_emplace(ends, out.size(), 0);
    at->second.second |= face;
    if (is_new) out.push_back({ends[0], ends[1], ends[2], ends[3]});
    out[at->second.first].both_faces = at->second.second == 3;
  }
  return out;
}

void check_target(const model::TileSheet& sheet, const std::string& file) {
  if (sheet.target.size() != sheet.tiles.size())
    throw InvalidInput(fmt::format("the file has {} tiles, and vertices.txt has {}. Give the same number",
                                   sheet.target.size(), sheet.tiles.size()),
                       {file});
  for (std::size_t t = 0; t < sheet.tiles.size(); ++t)
    if (sheet.target[t].size() != sheet.tiles[t].size())
      throw InvalidInput(fmt::format("tile {} has {} corners, and {} in vertices.txt. Give the same number",
                                     t + 1, sheet.target[t].size(), sheet.tiles[t].size()),
                         {file});
}

}  // namespace

bool is_tile_folder(const std::string& path) {
  std::error_code failure;  // set for names that no file can have: reading reports them
  return fs::is_regular_file(fs::path(path) / "vertices.txt", failure);
}

model::TileSheet read_tiles(const std::string& folder) {
  const auto path = [&](const char* name) { return (fs::path(folder) / name).string(); };
  model::TileSheet out;
  out.tiles = read_corners(path("vertices.txt"));
  out.joints = read_joints(path("constraints.txt"));
  std::error_code failure;
  if (!fs::exists(path("target.txt"), failure)) return out;
  out.target = read_corners(path("target.txt"));
  check_target(out, path("target.txt"));
  return out;
}

}  // namespace kinetix::app
