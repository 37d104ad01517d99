#include <bit>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "app/print/format/print_format.hpp"

namespace kinetix::app {
namespace {

static_assert(std::endian::native == std::endian::little, "glb is little-endian");

using GltfJson = nlohmann::ordered_json;

// Constants of glTF 2.0.
constexpr int gltf_float = 5126;                    // type of a component, float
constexpr int gltf_uint = 5125;                     // type of a component, unsigned int
constexpr int gltf_ushort = 5123;                   // type of a component, unsigned short
constexpr std::uint32_t gltf_magic = 0x46546C67;    // "glTF"
constexpr std::uint32_t json_chunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t binary_chunk = 0x004E4942;  // "BIN"
constexpr double seconds = 4;                       // s: of the motion from flat to the fold

/// Binary part of the file, with its views and accessors.
class Buffer {
 public:
  template <class Number>
  int add(const std::vector<Number>& numbers, const char* type, int width, int component) {
    while (bytes_.size() % 4 != 0) bytes_ += '\0';
    views_.push_back(
        {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", numbers.size() * sizeof(Number)}});
    bytes_.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
    accessors_.push_back({{"bufferView", views_.size() - 1},
                          {"componentType", component},
                          {"count", numbers.size() / static_cast<std::size_t>(width)},
                          {"type", type}});
    return static_cast<int>(accessors_.size()) - 1;
  }
  /// Adds numbers with the least and largest of each component, which positions and times need.
  int add_ranged(const std::vector<float>& numbers, const char* type, int width) {
    const int accessor = add(numbers, type, width, gltf_float);
    GltfJson low = GltfJson::array(), high = GltfJson::array();
    for (int k = 0; k < width; ++k) {
      float least = numbers[k], most = numbers[k];
      for (std::size_t i = k; i < numbers.size(); i += width) {
        least = std::min(least, numbers[i]);
        most = std::max(most, numbers[i]);
      }
      low.push_back(least);
      high.push_back(most);
    }
    accessors_.back()["min"] = low;
    accessors_.back()["max"] = high;
    return accessor;
  }

  void describe(GltfJson& gltf) const {
    gltf["buffers"] = GltfJson::array({{{"byteLength", bytes_.size()}}});
    gltf["bufferViews"] = views_;
    gltf["accessors"] = accessors_;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  GltfJson views_ = GltfJson::array(), accessors_ = GltfJson::array();
};

std::vector<float> positions(const model::Polyhedron& solid) {
  std::vector<float> out;
  for (const Eigen::Vector3d& p : solid.points)
    for (const double x : p) out.push_back(static_cast<float>(x));
  return out;
}

std::vector<std::uint32_t> corners(const model::Polyhedron& solid) {
  std::vector<std::uint32_t> out;
  for (const auto& t : solid.triangles)
    for (const int k : t) out.push_back(static_cast<std::uint32_t>(k));
  return out;
}

std::vector<float> translations(const PrintSheet& sheet, int body) {
  std::vector<float> out;
  for (const model::State& state : sheet.path)
    for (const double x : state[body].p) out.push_back(static_cast<float>(x));
  return out;
}

/// Returns a body's quaternions. Each has the sign that gives the shorter way from the one before.
std::vector<float> rotations(const PrintSheet& sheet, int body) {
  std::vector<float> out;
  Eigen::Quaterniond before = Eigen::Quaterniond::Identity();
  for (const model::State& state : sheet.path) {
    Eigen::Quaterniond q(state[body].R);
    if (q.dot(before) < 0) q.coeffs() *= -1;
    q.normalize();
    for (const double x : q.coeffs()) out.push_back(static_cast<float>(x));
    before = q;
  }
  return out;
}

class Scene3 {
 public:
  explicit Scene3(const PrintJob& job) : job_(job), sheet_(job.sheet) {}

  std::string glb() && {
    gltf_ = {{"asset", {{"version", "2.0"}, {"generator", "kinetix"}}}, {"scene", 0}};
    gltf_["materials"] =
        GltfJson::array({material("hard", {0.85, 0.85, 0.82, 1}), material("soft", {0.18, 0.44, 0.72, 1})});
    add_bodies();
    if (sheet_.has_soft()) add_soft();
    add_root();
    if (sheet_.path.size() > 1) add_motion();
    gltf_["meshes"] = meshes_;
    gltf_["nodes"] = nodes_;
    buffer_.describe(gltf_);
    return packed();
  }

 private:
  static GltfJson material(const char* name, const std::vector<double>& colour) {
    return {{"name", name},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", colour}, {"metallicFactor", 0}, {"roughnessFactor", 0.8}}}};
  }

  void add_bodies() {
    for (int b = 0; b < static_cast<int>(sheet_.meshes.size()); ++b) {
      const model::Pose& pose = job_.unturned()[b];
      const Eigen::Quaterniond q(pose.R);
      const std::string name = "body " + sheet_.linkage.vertex_name(b);
      nodes_.push_back({{"name", name},
                        {"translation", {pose.p.x(), pose.p.y(), pose.p.z()}},
                        {"rotation", {q.x(), q.y(), q.z(), q.w()}}});
      children_.push_back(b);
      if (!sheet_.meshes[b].points.empty()) nodes_.back()["mesh"] = mesh_of(name, sheet_.with_rods(b));
    }
  }

  /// Adds a mesh for one body, since Blender names what hangs on a bone by its mesh. Bodies of one shape share the
  /// numbers.
  std::size_t mesh_of(const std::string& name, const model::Polyhedron& solid) {
    const auto [known, is_new] = known_.try_emplace(positions(solid));
    if (is_new)
      known->second = {buffer_.add_ranged(known->first, "VEC3", 3),
                       buffer_.add(corners(solid), "SCALAR", 1, gltf_uint)};
    meshes_.push_back({{"name", name},
                       {"primitives", GltfJson::array({{{"attributes", {{"POSITION", known->second.points}}},
                                                        {"indices", known->second.triangles},
                                                        {"material", 0}}})}});
    return meshes_.size() - 1;
  }

  /// Adds all soft parts as one mesh. Each corner moves with one body, so the parts stretch.
  void add_soft() {
    model::Polyhedron all;
    std::vector<std::uint16_t> joints;
    const model::State rest = rest_state(sheet_.linkage);
    for (int h = 0; h < static_cast<int>(sheet_.soft.size()); ++h) {
      const std::size_t points = sheet_.soft[h].points.size();
      if (points == 0) continue;
      append(placed_soft(sheet_, rest, h), all);
      const model::RestHinge& hinge = sheet_.linkage.hinges[h];
      for (std::size_t k = 0; k < points; ++k)
        joints.insert(joints.end(),
                      {static_cast<std::uint16_t>(k < points / 2 ? hinge.lower : hinge.upper), 0, 0, 0});
    }
    std::vector<float> weights(joints.size(), 0.0F), inverse;
    for (std::size_t k = 0; k < weights.size(); k += 4) weights[k] = 1;
    for (const model::Pose& pose : rest)
      for (const double x :
           {1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., -pose.p.x(), -pose.p.y(), -pose.p.z(), 1.})
        inverse.push_back(static_cast<float>(x));
    const int points = buffer_.add_ranged(positions(all), "VEC3", 3),
              joint = buffer_.add(joints, "VEC4", 4, gltf_ushort),
              weight = buffer_.add(weights, "VEC4", 4, gltf_float),
              triangles = buffer_.add(corners(all), "SCALAR", 1, gltf_uint);
    meshes_.push_back(
        {{"primitives",
          GltfJson::array(
              {{{"attributes", {{"POSITION", points}, {"JOINTS_0", joint}, {"WEIGHTS_0", weight}}},
                {"indices", triangles},
                {"material", 1}}})}});
    gltf_["skins"] = GltfJson::array(
        {{{"joints", children_}, {"inverseBindMatrices", buffer_.add(inverse, "MAT4", 16, gltf_float)}}});
    nodes_.push_back({{"name", "hinges"}, {"mesh", meshes_.size() - 1}, {"skin", 0}});
    loose_ = static_cast<int>(nodes_.size()) - 1;
  }

  /// Adds the root node: metres, and y up.
  void add_root() {
    const double half = std::sqrt(0.5);
    nodes_.push_back({{"name", sheet_.name},
                      {"rotation", {-half, 0, 0, half}},
                      {"scale", {metres_per_mm, metres_per_mm, metres_per_mm}},
                      {"children", children_}});
    GltfJson roots = GltfJson::array({nodes_.size() - 1});
    if (loose_ >= 0) roots.push_back(loose_);
    gltf_["scenes"] = GltfJson::array({{{"name", sheet_.name}, {"nodes", roots}}});
  }

  void add_motion() {
    std::vector<float> times;
    for (std::size_t k = 0; k < sheet_.path.size(); ++k)
      times.push_back(
          static_cast<float>(seconds * static_cast<double>(k) / static_cast<double>(sheet_.path.size() - 1)));
    const int time = buffer_.add_ranged(times, "SCALAR", 1);
    GltfJson samplers = GltfJson::array(), channels = GltfJson::array();
    const auto add = [&](int body, const char* path, int output) {
      channels.push_back({{"sampler", samplers.size()}, {"target", {{"node", body}, {"path", path}}}});
      samplers.push_back({{"input", time}, {"output", output}, {"interpolation", "LINEAR"}});
    };
    for (const int b : children_) {
      add(b, "translation", buffer_.add(translations(sheet_, b), "VEC3", 3, gltf_float));
      add(b, "rotation", buffer_.add(rotations(sheet_, b), "VEC4", 4, gltf_float));
    }
    gltf_["animations"] =
        GltfJson::array({{{"name", "folding"}, {"samplers", samplers}, {"channels", channels}}});
  }

  std::string packed() const {
    std::string json = gltf_.dump(), binary = buffer_.bytes();
    while (json.size() % 4 != 0) json += ' ';
    while (binary.size() % 4 != 0) binary += '\0';
    std::string out;
    const auto add = [&](std::uint32_t n) { out.append(reinterpret_cast<const char*>(&n), sizeof n); };
    add(gltf_magic);
    add(2);  // version
    add(static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + binary.size()));
    add(static_cast<std::uint32_t>(json.size()));
    add(json_chunk);
    out += json;
    add(static_cast<std::uint32_t>(binary.size()));
    add(binary_chunk);
    return out + binary;
  }

  const PrintJob& job_;
  const PrintSheet& sheet_;
  GltfJson gltf_, nodes_ = GltfJson::array(), meshes_ = GltfJson::array();
  std::vector<int> children_;
  int loose_ = -1;  // node of the soft parts: skins ignore the place of their node
  struct Shape {
    int points = 0, triangles = 0;  // accessors
  };
  std::map<std::vector<float>, Shape> known_;
  Buffer buffer_;
};

std::vector<NamedContent> write_glb(const PrintJob& job) {
  return {{job.sheet.name + ".glb", Scene3(job).glb()}};
}

}  // namespace

// Entry of the format glb: name, meaning and writer.
const PrintFormat glb_format = {"glb", "viewers, folding as an animation", write_glb};

}  // namespace kinetix::app
