#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "app/models/model_file.hpp"
#include "model/base/invalid_input.hpp"
#include "targets/document/text_file.hpp"

namespace kinetix::app {
namespace {

using PlainJson = nlohmann::json;
using Eigen::Affine3d;

constexpr double metre_mm = 1000;                 // mm: glTF is in metres
constexpr std::size_t max_json_bytes = 16 << 20;  // 16 MiB: numbers are in the buffer, all else is short
constexpr int max_node_depth = 256;  // levels of nested nodes: limbs of figures have about twenty
constexpr std::size_t max_placed_nodes = 100'000;  // nodes of a scene: no folding model has that many parts
constexpr std::size_t max_corners = 3 * max_model_triangles;  // corners, and also points: of all triangles
constexpr std::size_t glb_header_bytes = 12,
                      glb_chunk_bytes = 8;  // bytes of the file's header and of a chunk's, in glTF

/// Returns the rotation from y up, as in glTF, to z up.
Affine3d upright() {
  Affine3d out = Affine3d::Identity();
  out.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return out;
}

template <class Number>
double number_in(const char* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return number;
}

/// Number type in a buffer, with glTF's code for it.
struct Component {
  int code;
  std::size_t bytes;
  double (*read)(const char* bytes);
  double largest;  ///< value that means 1 in normalised data; 1: not scaled
};

const std::vector<Component>& components() {
  static const std::vector<Component> all = {{5121, 1, number_in<std::uint8_t>, 0xff},
                                             {5123, 2, number_in<std::uint16_t>, 0xffff},
                                             {5125, 4, number_in<std::uint32_t>, 1},
                                             {5126, 4, number_in<float>, 1}};
  return all;
}

/// Rows of numbers in a buffer.
struct Rows {
  const char* data = nullptr;
  std::size_t count = 0, stride = 0;
  Component component = components()[0];
  double unit = 1;  ///< factor of each number in the file

  double at(std::size_t row, std::size_t column) const {
    return component.read(data + row * stride + column * component.bytes) * unit;
  }
};

/// Binary glTF file of version 2 (Khronos 2021). The reader trusts nothing: every index and length is checked.
class GlbModel {
 public:
  GlbModel(std::string_view bytes, const std::string& file) : out_{file, {}, metre_mm} {
    if (bytes.size() < glb_header_bytes || !bytes.starts_with("glTF")) fail("is not a binary glTF file");
    if (whole_at(bytes, 4) != 2) fail("is binary glTF of another version than 2");
    const std::string_view json = chunk(bytes, glb_header_bytes, "JSON");
    if (json.size() > max_json_bytes) fail("is damaged: its JSON is larger than 16 MiB");
    const std::size_t next = glb_header_bytes + glb_chunk_bytes + json.size();
    if (next < bytes.size()) buffer_ = chunk(bytes, next, std::string_view("BIN\0", 4));
    parse(json);
  }

  ModelFile read() {
    find_parents();
    const PlainJson* scene = entry("scenes", whole(root_, "scene", 0));
    for (const PlainJson& node : list(*scene, "nodes")) place(index(node, "nodes"), upright(), 0);
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const { throw InvalidInput(reason, {out_.file}); }
  [[noreturn]] void damaged(const std::string& what) const { fail("is damaged: " + what); }

  static std::size_t whole_at(std::string_view bytes, std::size_t at) {
    std::uint32_t number;
    std::memcpy(&number, bytes.data() + at, sizeof number);
    return number;
  }

  std::string_view chunk(std::string_view bytes, std::size_t at, std::string_view kind) const {
    const std::string_view rest = bytes.substr(at);
    if (rest.size() < glb_chunk_bytes || rest.substr(4, 4) != kind ||
        rest.size() - glb_chunk_bytes < whole_at(rest, 0))
      damaged("it ends early, or has no JSON");
    return rest.substr(glb_chunk_bytes, whole_at(rest, 0));
  }

  void parse(std::string_view json) {
    if (targets::find_too_deep(json)) damaged("its JSON has lists in one another, over 64 deep");
    root_ = PlainJson::parse(json.begin(), json.end(), nullptr, false);
    if (!root_.is_object()) damaged("its JSON cannot be read");
  }

  /// Reads a whole number of at least 0.
  std::size_t whole(const PlainJson& map, const char* key, std::optional<std::size_t> otherwise = {}) const {
    const auto found = map.find(key);
    if (found == map.end() && otherwise) return *otherwise;
    if (found == map.end() || !found->is_number_unsigned() || found->get<std::uint64_t>() > max_json_number)
      damaged(std::string("`") + key + "` is not a whole number");
    return found->get<std::size_t>();
  }

  const PlainJson& list(const PlainJson& map, const char* key) const {
    static const PlainJson none = PlainJson::array();
    const auto found = map.find(key);
    if (found == map.end()) return none;
    if (!found->is_array()) damaged(std::string("`") + key + "` is not a list");
    return *found;
  }

  std::size_t index(const PlainJson& number, const char* of) const {
    if (!number.is_number_unsigned() || number.get<std::uint64_t>() >= list(root_, of).size())
      damaged(std::string("it names one of `") + of + "` that is not there");
    return number.get<std::size_t>();
  }

  const PlainJson* entry(const char* of, std::size_t index) const {
    const PlainJson& all = list(root_, of);
    if (index >= all.size() || !all[index].is_object())
      damaged(std::string("it names one of `") + of + "` that is not there");
    return &all[index];
  }

  /// Returns the entry that a key names, or null without such a key.
  const PlainJson* named(const PlainJson& map, const char* key, const char* of) const {
    return map.contains(key) ? entry(of, whole(map, key)) : nullptr;
  }

  static std::string name_of(const PlainJson* map) {
    const auto found = map ? map->find("name") : PlainJson::const_iterator();
    return map && found != map->end() && found->is_string() ? found->get<std::string>() : std::string();
  }

  std::string_view view(const PlainJson& accessor, std::size_t& stride) const {
    const PlainJson* part = named(accessor, "bufferView", "bufferViews");
    if (!part || accessor.contains("sparse"))
      fail("keeps its numbers compressed or sparse. Write it without compression");
    const PlainJson* buffer = named(*part, "buffer", "buffers");
    if (!buffer || whole(*part, "buffer") != 0 || buffer->contains("uri"))
      fail("keeps its numbers in another file. Write it as one binary file");
    const std::size_t start = whole(*part, "byteOffset", 0), length = whole(*part, "byteLength");
    if (start > buffer_.size() || length > buffer_.size() - start) damaged("its buffer ends early");
    stride = whole(*part, "byteStride", 0);
    return buffer_.substr(start, length);
  }

  const Component& component_of(const PlainJson& accessor) const {
    const std::size_t code = whole(accessor, "componentType");
    for (const Component& one : components())
      if (one.code == static_cast<int>(code)) return one;
    fail("has numbers of a kind that is not read: " + std::to_string(code));
  }

  /// Reads the rows of an accessor. @param type of a row in glTF, with `columns` numbers
  Rows rows(std::size_t accessor_index, const char* type, std::size_t columns) const {
    const PlainJson& accessor = *entry("accessors", accessor_index);
    Rows out;
    const std::string_view bytes = view(accessor, out.stride);
    out.component = component_of(accessor);
    const std::size_t start = whole(accessor, "byteOffset", 0), row = columns * out.component.bytes;
    out.count = whole(accessor, "count");
    if (accessor.value("type", PlainJson()) != type) damaged(std::string("numbers that are not ") + type);
    if (accessor.value("normalized", PlainJson(false)) == PlainJson(true))
      out.unit = 1 / out.component.largest;
    if (out.stride == 0) out.stride = row;
    if (out.count > max_corners) fail("has too many points or triangles. Thin the model out");
    if (start > bytes.size() || out.stride < row ||
        (out.count > 0 && row + (out.count - 1) * out.stride > bytes.size() - start))
      damaged("its buffer ends early");
    out.data = bytes.data() + start;
    return out;
  }

  Eigen::VectorXd numbers(const PlainJson& node, const char* key, const Eigen::VectorXd& otherwise) const {
    const auto found = node.find(key);
    if (found == node.end()) return otherwise;
    Eigen::VectorXd out = otherwise;
    const bool fits = found->is_array() && static_cast<Eigen::Index>(found->size()) == out.size();
    for (Eigen::Index k = 0; fits && k < out.size(); ++k)
      out[k] = (*found)[k].is_number() ? (*found)[k].get<double>() : std::nan("");
    if (!fits || !out.allFinite())
      damaged(std::string("a node's `") + key + "` does not have the form that glTF requires");
    return out;
  }

  Affine3d local(const PlainJson& node) const {
    Affine3d out = Affine3d::Identity();
    if (node.contains("matrix")) {
      const Eigen::VectorXd m = numbers(node, "matrix", Eigen::VectorXd::Zero(16));
      out.matrix().topRows<3>() = Eigen::Map<const Eigen::Matrix4d>(m.data()).topRows<3>();
      return out;
    }
    const Eigen::Vector3d p = numbers(node, "translation", Eigen::Vector3d::Zero()),
                          scale = numbers(node, "scale", Eigen::Vector3d::Ones());
    const Eigen::Vector4d q = numbers(node, "rotation", Eigen::Vector4d::UnitW());
    if (!(q.norm() > 0)) damaged("a node's `rotation` is zero");
    return Eigen::Translation3d(p) * Eigen::Quaterniond(q.normalized()) * Eigen::Scaling(scale);
  }

  void find_parents() {
    const PlainJson& nodes = list(root_, "nodes");
    parents_.assign(nodes.size(), std::nullopt);
    for (std::size_t n = 0; n < nodes.size(); ++n)
      for (const PlainJson& child : list(*entry("nodes", n), "children")) {
        const std::size_t c = index(child, "nodes");
        if (parents_[c]) damaged("a node is in two others");
        parents_[c] = n;
      }
  }

  Affine3d world(std::size_t node) const {
    Affine3d out = Affine3d::Identity();
    std::optional<std::size_t> at = node;
    for (int depth = 0; at; at = parents_[*at]) {
      if (++depth > max_node_depth) damaged("nodes are in one another, over 256 deep");
      out = local(*entry("nodes", *at)) * out;
    }
    return upright() * out;
  }

  void place(std::size_t node_index, const Affine3d& above, int depth) {
    if (depth > max_node_depth || ++placed_ > max_placed_nodes)
      damaged("its nodes are too many, or in one another, over 256 deep");
    const PlainJson& node = *entry("nodes", node_index);
    const Affine3d X = above * local(node);
    if (const PlainJson* mesh = named(node, "mesh", "meshes")) {
      ++objects_;
      for (const PlainJson& primitive : list(*mesh, "primitives"))
        add(node, X, primitive, name_of(&node).empty() ? name_of(mesh) : name_of(&node));
    }
    for (const PlainJson& child : list(node, "children")) place(index(child, "nodes"), X, depth + 1);
  }

  void add(const PlainJson& node, const Affine3d& X, const PlainJson& primitive, const std::string& name) {
    if (!primitive.is_object() || !primitive.contains("attributes") || !primitive["attributes"].is_object())
      damaged("a mesh has no points");
    const PlainJson& attributes = primitive["attributes"];
    const std::size_t mode = whole(primitive, "mode", 4);
    if (mode < 4 || !attributes.contains("POSITION")) return;  // points and lines
    FoundMesh found{name, name_of(named(primitive, "material", "materials")), {}, objects_};
    const Rows points = rows(whole(attributes, "POSITION"), "VEC3", 3);
    const bool is_skinned =
        node.contains("skin") && attributes.contains("JOINTS_0") && attributes.contains("WEIGHTS_0");
    found.soup.points = is_skinned ? skinned(node, attributes, points) : placed(points, X);
    add_triangles(corners(primitive, points.count), mode, X.linear().determinant() < 0, found);
    count_ += found.soup.points.size() + 3 * found.soup.triangles.size();
    if (count_ > 2 * max_corners) fail("has too many points or triangles. Thin the model out");
    out_.meshes.push_back(std::move(found));
  }

  Eigen::Vector3d point(const Rows& points, std::size_t row) const {
    const Eigen::Vector3d p(points.at(row, 0), points.at(row, 1), points.at(row, 2));
    if (!p.allFinite()) damaged("a coordinate is not a finite number");
    return p;
  }

  std::vector<Eigen::Vector3d> placed(const Rows& points, const Affine3d& X) const {
    std::vector<Eigen::Vector3d> out;
    for (std::size_t v = 0; v < points.count; ++v) out.emplace_back(X * point(points, v));
    return out;
  }

  /// Returns the transform of each joint of a skin for points of the mesh.
  std::vector<Affine3d> joints(const PlainJson& node) const {
    const PlainJson& skin = *named(node, "skin", "skins");
    std::vector<Affine3d> out;
    for (const PlainJson& joint : list(skin, "joints")) out.push_back(world(index(joint, "nodes")));
    if (!skin.contains("inverseBindMatrices")) return out;
    const Rows inverse = rows(whole(skin, "inverseBindMatrices"), "MAT4", 16);
    if (inverse.count < out.size()) damaged("a skin has too few matrices");
    for (std::size_t j = 0; j < out.size(); ++j) {
      Affine3d bind = Affine3d::Identity();
      for (int k = 0; k < 12; ++k) bind.matrix()(k % 3, k / 3) = inverse.at(j, 4 * (k / 3) + k % 3);
      if (!bind.matrix().allFinite()) damaged("a skin's matrix is not of finite numbers");
      out[j] = out[j] * bind;
    }
    return out;
  }

  /// Returns the points of a skinned mesh, each moved by up to four weighted bones. The transform of the mesh's node
  /// is not used.
  std::vector<Eigen::Vector3d> skinned(const PlainJson& node, const PlainJson& attributes,
                                       const Rows& points) const {
    const std::vector<Affine3d> bones = joints(node);
    const Rows bone_of = rows(whole(attributes, "JOINTS_0"), "VEC4", 4),
               weights = rows(whole(attributes, "WEIGHTS_0"), "VEC4", 4);
    if (bone_of.count < points.count || weights.count < points.count) damaged("a point has no bones");
    std::vector<Eigen::Vector3d> out(points.count, Eigen::Vector3d::Zero());
    for (std::size_t v = 0; v < points.count; ++v)
      for (int k = 0; k < 4; ++k) {
        const double bone = bone_of.at(v, k), weight = weights.at(v, k);
        if (!std::isfinite(weight)) damaged("a weight is not a finite number");
        if (weight == 0) continue;
        if (!(bone >= 0 && bone < static_cast<double>(bones.size()))) damaged("a bone is not there");
        out[v] += weight * (bones[static_cast<std::size_t>(bone)] * point(points, v));
      }
    return out;
  }

  std::vector<int> corners(const PlainJson& primitive, std::size_t points) const {
    std::vector<int> out;
    if (!primitive.contains("indices")) {
      for (std::size_t v = 0; v < points; ++v) out.push_back(static_cast<int>(v));
      return out;
    }
    const Rows given = rows(whole(primitive, "indices"), "SCALAR", 1);
    for (std::size_t k = 0; k < given.count; ++k) {
      const double v = given.at(k, 0);
      if (!(v >= 0 && v < static_cast<double>(points))) damaged("a triangle names a point that is not there");
      out.push_back(static_cast<int>(v));
    }
    return out;
  }

  /// Adds triangles. @param mode 4: triangles, 5: a strip, 6: a fan
  void add_triangles(const std::vector<int>& c, std::size_t mode, bool mirrored, FoundMesh& found) const {
    if (mode > 6) damaged("a mesh of an unknown kind");
    for (std::size_t k = 0; k + 2 < c.size(); k += mode == 4 ? 3 : 1) {
      std::array<int, 3> t{c[mode == 6 ? 0 : k], c[k + 1], c[k + 2]};
      if (mirrored != (mode == 5 && k % 2 == 1)) std::swap(t[1], t[2]);
      found.soup.triangles.push_back(t);
    }
  }

  static constexpr std::uint64_t max_json_number = 1u << 31;  // bytes or entries: files are smaller

  PlainJson root_;
  std::string_view buffer_;
  std::vector<std::optional<std::size_t>> parents_;  ///< by node
  std::size_t placed_ = 0, count_ = 0;               ///< nodes; corners and points
  int objects_ = 0;                                  ///< nodes with a mesh so far
  ModelFile out_;
};

}  // namespace

ModelFile read_glb(const std::string& bytes, const std::string& file) { return GlbModel(bytes, file).read(); }

}  // namespace kinetix::app
