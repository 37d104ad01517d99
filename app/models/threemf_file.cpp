#include <zip.h>

#include <cmath>
#include <cstdlib>
#include <pugixml.hpp>

#include "app/models/model_file.hpp"
#include "model/base/invalid_input.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {
namespace {

constexpr zip_int64_t max_entries = 10'000;  // files of a package: thumbnails and parts of one model are tens
constexpr zip_uint64_t max_model_bytes =
    512u << 20;                          // bytes, unpacked: a million triangles take some 100 MB as text
constexpr int max_component_depth = 32;  // objects in objects: assemblies of assemblies have three or four
constexpr int max_placed_objects = 100'000;  // objects, counted each time: no folding model has that many
constexpr std::size_t max_points = 3 * max_model_triangles;  // of all meshes: a point for each corner.
// Counts in a package's XML, 1: a million triangles have a third of these. XML beyond them fills memory many times its
// size.
constexpr std::ptrdiff_t max_tags = 4'000'000, max_attributes = 12'000'000;

class Package {
 public:
  Package(const std::string& bytes, const std::string& file) : file_(file) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    if (source == nullptr) throw std::runtime_error("zip: no memory");
    archive_.reset(zip_open_from_source(source, ZIP_RDONLY, &error));
    if (!archive_) {
      zip_source_free(source);
      throw InvalidInput("is not a 3MF file, or is damaged: it is not a zip archive that opens", {file_});
    }
    check_names();
  }

  /// Reads a file of the package. The counts of tags and attributes are limited over all files read.
  std::string text(const std::string& name) {
    zip_stat_t status;
    if (zip_stat(archive_.get(), name.c_str(), ZIP_FL_NOCASE, &status) != 0)
      throw InvalidInput("has no `" + name + "` inside; it is not a 3MF file, or is damaged", {file_});
    if (status.size > max_model_bytes)
      throw InvalidInput("unpacks to " + std::to_string(status.size >> 20) + " MiB in `" + name +
                             "`; at most " + std::to_string(max_model_bytes >> 20) + " MiB are allowed",
                         {file_});
    const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> opened(
        zip_fopen(archive_.get(), name.c_str(), ZIP_FL_NOCASE), &zip_fclose);
    std::string out(status.size, '\0');
    const zip_int64_t read = opened ? zip_fread(opened.get(), out.data(), out.size()) : -1;
    if (read != static_cast<zip_int64_t>(out.size()))
      throw InvalidInput("is damaged in `" + name + "`", {file_});
    tags_ += std::count(out.begin(), out.end(), '<');
    attributes_ += std::count(out.begin(), out.end(), '=');
    if (tags_ > max_tags || attributes_ > max_attributes)
      throw InvalidInput("holds far more in `" + name + "` than a model of a million triangles", {file_});
    return out;
  }

  bool has(const std::string& name) const {
    return zip_name_locate(archive_.get(), name.c_str(), ZIP_FL_NOCASE) >= 0;
  }

 private:
  void check_names() const {
    const zip_int64_t count = zip_get_num_entries(archive_.get(), 0);
    if (count > max_entries)
      throw InvalidInput("holds " + std::to_string(count) + " files; at most " + std::to_string(max_entries) +
                             " are allowed",
                         {file_});
    for (zip_int64_t k = 0; k < count; ++k) {
      const char* entry = zip_get_name(archive_.get(), static_cast<zip_uint64_t>(k), 0);
      const std::string name = entry ? entry : "";
      const bool escapes = name.empty() || name[0] == '/' || name.find('\\') != std::string::npos ||
                           name.find(':') != std::string::npos ||
                           ("/" + name + "/").find("/../") != std::string::npos;
      if (escapes)
        throw InvalidInput("holds a file whose path leads outside, " + targets::in_ticks(name), {file_});
    }
  }

  std::string file_;
  std::unique_ptr<zip_t, decltype(&zip_discard)> archive_{nullptr, &zip_discard};
  std::ptrdiff_t tags_ = 0, attributes_ = 0;  ///< read so far
};

/// Returns the path of the model that the package's relationships name.
std::string model_part(Package& package) {
  if (package.has("_rels/.rels")) {
    pugi::xml_document relations;
    relations.load_string(package.text("_rels/.rels").c_str());
    for (const pugi::xml_node& r : relations.child("Relationships").children("Relationship"))
      if (std::string(r.attribute("Type").value()).ends_with("/3dmodel")) {
        std::string target = r.attribute("Target").value();
        return target.starts_with('/') ? target.substr(1) : target;
      }
  }
  return "3D/3dmodel.model";
}

/// Model of a package: the first, or one that holds objects for it (production extension).
struct ModelPart {
  pugi::xml_document document;
  pugi::xml_node root;
  std::map<int, std::vector<std::string>> materials;
  std::map<int, pugi::xml_node> objects;
};

class ThreemfModel {
 public:
  ThreemfModel(Package& package, const std::string& file) : package_(package), out_{file, {}} {}

  ModelFile read() {
    const std::string first = model_part(package_);
    ModelPart& part = part_of(first);
    out_.unit_mm = unit(part);
    for (const pugi::xml_node& item : part.root.child("build").children("item"))
      add_object(item, first, Eigen::Affine3d::Identity(), 0, "");
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const { throw InvalidInput(reason, {out_.file}); }

  /// Returns a model of the package. It is read at the first request.
  ModelPart& part_of(const std::string& name) {
    const auto [found, is_new] = parts_.try_emplace(name);
    ModelPart& part = found->second;
    if (!is_new) return part;
    const pugi::xml_parse_result parsed = part.document.load_string(package_.text(name).c_str());
    if (!parsed) fail("is damaged: `" + name + "` is not XML: " + parsed.description());
    part.root = part.document.child("model");
    if (!part.root) fail("is damaged: `" + name + "` has no `model`");
    for (const pugi::xml_node& node : part.root.child("resources").children()) {
      if (std::string(node.name()) == "basematerials") read_materials(node, part);
      if (std::string(node.name()).ends_with("colorgroup")) read_colours(node, part);
      if (std::string(node.name()) == "object") part.objects[node.attribute("id").as_int(-1)] = node;
    }
    return part;
  }

  double unit(const ModelPart& part) const {
    static const std::map<std::string, double> units = {{"micron", 1e-3},   {"millimeter", 1},
                                                        {"centimeter", 10}, {"inch", 25.4},
                                                        {"foot", 304.8},    {"meter", 1000}};
    const auto found = units.find(part.root.attribute("unit").as_string("millimeter"));
    if (found == units.end())
      fail("has an unknown unit " + targets::in_ticks(part.root.attribute("unit").value()));
    return found->second;
  }

  static void read_materials(const pugi::xml_node& group, ModelPart& part) {
    std::vector<std::string>& names = part.materials[group.attribute("id").as_int(-1)];
    for (const pugi::xml_node& base : group.children("base"))
      names.emplace_back(base.attribute("name").value());
  }

  static void read_colours(const pugi::xml_node& group, ModelPart& part) {
    std::vector<std::string>& names = part.materials[group.attribute("id").as_int(-1)];
    for (const pugi::xml_node& colour : group.children())
      names.push_back(targets::lower_case(std::string(colour.attribute("color").value()).substr(0, 7)));
  }

  /// Reads a transform: row vectors times a matrix of four rows and three columns.
  Eigen::Affine3d transform(const pugi::xml_node& node) const {
    Eigen::Affine3d out = Eigen::Affine3d::Identity();
    const pugi::xml_attribute given = node.attribute("transform");
    if (!given) return out;
    const char* at = given.value();
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 3; ++column) {
        char* end = nullptr;
        const double x = std::strtod(at, &end);
        if (end == at || !std::isfinite(x)) fail("has a transform that is not twelve numbers");
        out.matrix()(column, row) = x;
        at = end;
      }
    return out;
  }

  /// Returns the name of the model whose object an item or a component places. @param here the model that it is in
  static std::string part_name(const pugi::xml_node& placed, const std::string& here) {
    for (const pugi::xml_attribute& attribute : placed.attributes())
      if (std::string(attribute.name()).ends_with(":path")) {
        const std::string path = attribute.value();
        return path.starts_with('/') ? path.substr(1) : path;
      }
    return here;
  }

  const pugi::xml_node& object(int id, const ModelPart& part) const {
    const auto found = part.objects.find(id);
    if (found == part.objects.end()) fail("names an object " + std::to_string(id) + " that is not there");
    return found->second;
  }

  /// Adds an object with its components. @param placed an item of the build, or a component of an object.
  /// @param here the model that it is in.   @param around transform of that object.   @param name used if its object
  /// has none
  void add_object(const pugi::xml_node& placed, const std::string& here, const Eigen::Affine3d& around,
                  int depth, const std::string& name) {
    const int id = placed.attribute("objectid").as_int(-1);
    if (depth > max_component_depth)
      fail("has an object " + std::to_string(id) + " that is a part of itself, or 32 deep");
    if (++placed_ > max_placed_objects)
      fail("places objects more than " + std::to_string(max_placed_objects) +
           " times, those in others counted each time");
    const std::string in = part_name(placed, here);
    const ModelPart& part = part_of(in);
    if (in != here && unit(part) != out_.unit_mm)
      fail("holds objects of another unit in " + targets::in_ticks(in));
    const pugi::xml_node& node = object(id, part);
    const std::string own = node.attribute("name").value();
    const std::string called = own.empty() ? name : own;
    const Eigen::Affine3d X = around * transform(placed);
    if (node.child("mesh")) add_mesh(node, part, X, called);
    for (const pugi::xml_node& component : node.child("components").children("component"))
      add_object(component, in, X, depth + 1, called);
  }

  double coordinate(const pugi::xml_node& vertex, const char* name) const {
    const char* text = vertex.attribute(name).value();
    char* end = nullptr;
    const double x = std::strtod(text, &end);
    if (end == text || *end != '\0' || !std::isfinite(x))
      fail("has a vertex whose " + std::string(name) + " is not a finite number: " + targets::in_ticks(text));
    return x;
  }

  static std::string material_of(const pugi::xml_node& triangle, const pugi::xml_node& of_object,
                                 const ModelPart& part) {
    const bool own = triangle.attribute("pid") || triangle.attribute("p1");
    const int group = triangle.attribute("pid") ? triangle.attribute("pid").as_int(-1)
                                                : of_object.attribute("pid").as_int(-1);
    const int index = own ? triangle.attribute("p1").as_int(0) : of_object.attribute("pindex").as_int(0);
    const auto found = part.materials.find(group);
    if (found == part.materials.end() || index < 0 || index >= static_cast<int>(found->second.size()))
      return {};
    return found->second[index];
  }

  void count_points(std::size_t more) {
    if ((points_ += more) > max_points) fail("has too many points. Thin the model out");
  }

  void add_mesh(const pugi::xml_node& node, const ModelPart& part, const Eigen::Affine3d& X,
                const std::string& name) {
    std::vector<Eigen::Vector3d> points;
    ++objects_;
    for (const pugi::xml_node& v : node.child("mesh").child("vertices").children("vertex")) {
      count_points(1);
      points.push_back(X * Eigen::Vector3d(coordinate(v, "x"), coordinate(v, "y"), coordinate(v, "z")));
    }
    const bool mirrored = X.linear().determinant() < 0;
    std::map<std::string, std::size_t> mesh_of;  // by material, in the order of their first triangle
    for (const pugi::xml_node& t : node.child("mesh").child("triangles").children("triangle")) {
      if (++triangles_ > max_model_triangles)
        fail("has too many triangles; at most " + std::to_string(max_model_triangles) +
             " are allowed. Thin the model out");
      std::array<int, 3> corners{t.attribute("v1").as_int(-1), t.attribute("v2").as_int(-1),
                                 t.attribute("v3").as_int(-1)};
      for (const int c : corners)
        if (c < 0 || c >= static_cast<int>(points.size()))
          fail("has a triangle of a vertex that is not there");
      if (mirrored) std::swap(corners[1], corners[2]);
      const std::string material = material_of(t, node, part);
      const auto [found, is_new] = mesh_of.try_emplace(material, out_.meshes.size());
      if (is_new && found->second > 0) count_points(points.size());
      if (is_new) out_.meshes.push_back({name, material, {points, {}}, objects_});
      out_.meshes[found->second].soup.triangles.push_back(corners);
    }
  }

  Package& package_;
  std::map<std::string, ModelPart> parts_;  ///< by their names in the package
  std::size_t triangles_ = 0, points_ = 0;
  int placed_ = 0, objects_ = 0;  ///< objects so far, and those with a mesh
  ModelFile out_;
};

}  // namespace

ModelFile read_threemf(const std::string& bytes, const std::string& file) {
  Package package(bytes, file);
  return ThreemfModel(package, file).read();
}

}  // namespace kinetix::app
