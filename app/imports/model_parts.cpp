#include "app/imports/model_parts.hpp"

#include <fmt/format.h>
#include <cctype>
#include <set>

#include "app/files/file_header.hpp"
#include "app/models/model_file.hpp"
#include "model/assembly/shells.hpp"
#include "model/base/algorithms.hpp"
#include "model/base/box.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {
namespace {

// Words in names of materials and parts that mark them as soft: rubbers, and the names in kinetix's own exports.
constexpr std::array<std::string_view, 11> soft_words = {
    "soft", "tango", "agilus", "rubber", "elast", "flex", "ninja", "tpu", "tpe", "silicone", "hinge"};
// Share of the largest side. Nearer points are merged if a shell is not closed as written.
constexpr double weld_share = 1e-6;
// Largest sides of a model, in a file's own unit: below the first it cannot be in mm, below the second not in inches.
constexpr double min_mm = 10, min_inches = 1;

struct Unit {
  std::string_view name;
  double mm;
  std::string_view words;
};
// Units in which programs write models, in mm.
constexpr std::array<Unit, 5> units = {{{"mm", 1, "millimetres"},
                                        {"cm", 10, "centimetres"},
                                        {"m", 1000, "metres"},
                                        {"in", 25.4, "inches"},
                                        {"ft", 304.8, "feet"}}};

double largest_side(const std::vector<ModelFile>& files) {
  Eigen::AlignedBox3d box;
  for (const ModelFile& file : files)
    for (const FoundMesh& mesh : file.meshes)
      for (const auto& t : mesh.soup.triangles)
        for (const int p : t) box.extend(mesh.soup.points[p]);
  return box.isEmpty() ? 0 : box.sizes().maxCoeff();
}

const Unit& named_unit(const std::string& name) {
  for (const Unit& unit : units)
    if (unit.name == name) return unit;
  throw InvalidInput("--unit: unknown unit " + targets::in_ticks(name) + "; allowed: mm, cm, m, in, ft");
}

/// Describes the units that files state. Different units appear with the names of their files.
std::string stated_units(const std::vector<ModelFile>& files) {
  std::set<double> said;
  std::string each;
  for (const ModelFile& file : files) {
    if (!file.unit_mm) continue;
    said.insert(*file.unit_mm);
    each += fmt::format("{}{:g} mm of {}", each.empty() ? "" : " and ", *file.unit_mm, file.file);
  }
  return said.size() == 1 ? fmt::format("{:g} mm, from the file", *said.begin()) : each + ", from the files";
}

/// Scales files to mm and describes how the unit was found. Two files have common coordinates. If one of them does not
/// state its unit, it has that of the other.
std::string to_mm(const std::string& asked, std::vector<ModelFile>& files) {
  const double side = largest_side(files);
  const Unit& guess = side >= min_mm ? units[0] : side >= min_inches ? units[3] : units[2];
  std::optional<double> said;
  for (const ModelFile& file : files)
    if (file.unit_mm) said = file.unit_mm;
  for (ModelFile& file : files) {
    const double own = file.unit_mm.value_or(said.value_or(guess.mm)),
                 mm = asked.empty() ? own : named_unit(asked).mm;
    for (FoundMesh& mesh : file.meshes)
      for (Eigen::Vector3d& p : mesh.soup.points) p *= mm;
  }
  if (!asked.empty()) return std::string(named_unit(asked).words) + ", as requested";
  if (said) return stated_units(files);
  return fmt::format(
      "{}, inferred: the file has no unit, and the model is {:.4g} of them long. Give --unit for another one",
      guess.words, side);
}

bool is_soft_name(const std::string& text) {
  const std::string low = targets::lower_case(text);
  return std::any_of(soft_words.begin(), soft_words.end(),
                     [&](std::string_view word) { return low.find(word) != std::string::npos; });
}

bool is_called(const FoundMesh& mesh, const std::string& name) {
  return targets::lower_case(mesh.material) == name || targets::lower_case(mesh.name) == name;
}

/// Rule by which parts are soft. Materials come first: a part called "hinge" may be a hard half of one.
class Softness {
 public:
  Softness(const ImportRequest& request, const ModelFile& file)
      : requested_(targets::lower_case(request.soft_material)) {
    for (const FoundMesh& mesh : file.meshes) materials_.insert(mesh.material);
    by_material_ = std::any_of(materials_.begin(), materials_.end(), is_soft_name);
    const bool any =
        std::any_of(file.meshes.begin(), file.meshes.end(), [&](const FoundMesh& m) { return is_soft(m); });
    if (any || is_none()) return;
    if (!requested_.empty())
      throw InvalidInput("--soft-material: no material, colour or part has the name " +
                             targets::in_ticks(request.soft_material) + found(),
                         {file.file});
    if (materials_.size() > 1)
      unclear_ = "the soft material is not clear" + found() + ". Name it with --soft-material";
  }

  bool is_soft(const FoundMesh& mesh) const {
    if (is_none()) return false;
    if (!requested_.empty()) return is_called(mesh, requested_);
    return is_soft_name(by_material_ ? mesh.material : mesh.name);
  }

  std::string words() const {
    return is_none()             ? "none, as asked"
           : !unclear_.empty()   ? "none of the materials; --soft-material names one that is"
           : !requested_.empty() ? "as asked"
           : by_material_        ? "by the names of materials"
                                 : "by the names of parts";
  }

  const std::string& unclear() const { return unclear_; }

 private:
  bool is_none() const { return requested_ == "none"; }

  std::string found() const {
    std::string names;
    for (const std::string& m : materials_)
      names += (names.empty() ? ": " : ", ") + (m.empty() ? "none" : targets::in_ticks(m));
    return names;
  }

  std::string requested_, unclear_;
  std::set<std::string> materials_;
  bool by_material_ = false;
};

std::string plain(const std::string& name) {
  std::string out;
  for (const char c : name.substr(0, 60)) {
    const bool fine = std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '.' || c == '_';
    if (fine)
      out += c;
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && (out.back() == '_' || out.back() == '.')) out.pop_back();
  while (!out.empty() && out.front() == '.') out.erase(0, 1);
  return out;
}

class Names {
 public:
  /// Returns an unused name. @param wanted may be empty or used before: then a number follows
  std::string next(const std::string& wanted, bool soft, bool many) {
    const std::string stem = many || wanted.empty() ? (soft ? "hinge" : "body") : wanted;
    if (stem == wanted && used_names_.insert(stem).second) return stem;
    std::string name;
    do name = stem + "_" + std::to_string(++count_[stem]);
    while (!used_names_.insert(name).second);
    return name;
  }

 private:
  std::set<std::string> used_names_;
  std::map<std::string, int> count_;
};

bool closes(const std::vector<model::Polyhedron>& shells) {
  return std::all_of(shells.begin(), shells.end(), [](const model::Polyhedron& s) { return is_closed(s); });
}

std::vector<model::Polyhedron> shells_of(const model::Polyhedron& soup) {
  std::vector<model::Polyhedron> exact = shells(model::welded(soup, 0));
  if (closes(exact)) return exact;
  const double near = weld_share * model::box_of(soup.points).sizes().maxCoeff();
  std::vector<model::Polyhedron> nearly = shells(model::welded(soup, near));
  return closes(nearly) ? nearly : exact;
}

/// Joins the meshes of each object of a file whose materials are open shells: colours of a surface are no parts. The
/// joined mesh has the material with the most triangles.
void join_open_meshes(std::vector<FoundMesh>& meshes) {
  std::map<int, std::vector<std::size_t>> objects;
  for (std::size_t k = 0; k < meshes.size(); ++k)
    if (meshes[k].object > 0) objects[meshes[k].object].push_back(k);
  for (const auto& [object, all] : objects) {
    const auto is_open = [&](std::size_t k) { return !closes(shells_of(meshes[k].soup)); };
    if (all.size() < 2 || std::none_of(all.begin(), all.end(), is_open)) continue;
    const std::size_t largest = *std::max_element(all.begin(), all.end(), [&](std::size_t a, std::size_t b) {
      return meshes[a].soup.triangles.size() < meshes[b].soup.triangles.size();
    });
    FoundMesh joined{meshes[all.front()].name, meshes[largest].material, {}, object};
    for (const std::size_t k : all) {
      const int first = static_cast<int>(joined.soup.points.size());
      model::append(meshes[k].soup.points, joined.soup.points);
      for (std::array<int, 3> t : meshes[k].soup.triangles) {
        for (int& corner : t) corner += first;
        joined.soup.triangles.push_back(t);
      }
      meshes[k].soup = {};
    }
    meshes[all.front()] = std::move(joined);
  }
  std::erase_if(meshes, [](const FoundMesh& mesh) { return mesh.soup.triangles.empty(); });
}

void add_parts(const FoundMesh& mesh, bool soft, Names& names, ModelParts& out) {
  std::vector<model::Polyhedron> found = shells_of(mesh.soup);
  const bool many = found.size() > 1;
  for (model::Polyhedron& shell : found)
    out.parts.push_back({names.next(plain(mesh.name), soft, many), soft, std::move(shell)});
}

/// Extent and volume of a part, equal for two parts of one place and shape.
struct PartExtent {
  const model::ModelPart* part;
  Eigen::AlignedBox3d box;
  double volume_mm3 = 0;

  explicit PartExtent(const model::ModelPart& of)
      : part(&of), box(model::box_of(of.solid.points)), volume_mm3(model::volume_mm3(of.solid)) {}

  bool is_as(const PartExtent& other) const {
    const double near = weld_share * box.diagonal().norm();
    return (box.min() - other.box.min()).norm() <= near && (box.max() - other.box.max()).norm() <= near &&
           std::abs(volume_mm3 - other.volume_mm3) <= near * box.diagonal().squaredNorm();
  }
};

/// Refuses a part that is there twice: a soft one would count twice as a hinge.
void refuse_repeated_parts(const std::vector<model::ModelPart>& parts, const std::string& file) {
  std::vector<PartExtent> extents(parts.begin(), parts.end());
  std::stable_sort(extents.begin(), extents.end(), [](const PartExtent& a, const PartExtent& b) {
    return a.box.min().x() < b.box.min().x();
  });
  for (std::size_t k = 0; k < extents.size(); ++k)
    for (std::size_t other = k + 1; other < extents.size(); ++other) {
      const double apart = extents[other].box.min().x() - extents[k].box.min().x();
      if (apart > weld_share * extents[k].box.diagonal().norm()) break;
      if (extents[k].is_as(extents[other]))
        throw InvalidInput("the same part is twice in one place, " +
                               targets::in_ticks(extents[k].part->name) + " and " +
                               targets::in_ticks(extents[other].part->name) + ". Remove one of them",
                           {file});
    }
}

namespace value = targets::value;

targets::ValueType axis_type() { return value::list(value::number(), "`[x, y, z]`", 3, 3); }

const targets::KeyTable& choice_keys() {
  static const targets::KeyTable keys({
      {"hinge", value::text("name of a soft part"), targets::otherwise("`bodies`"), "the soft part"},
      {"bodies", value::list(value::text("name of a body"), "`[name, name]`", 2, 2),
       targets::otherwise("`hinge`"), "the two bodies that it joins, instead of its name"},
      {"axis", axis_type(), targets::needed, "its axis at rest, of any length"},
  });
  return keys;
}

Eigen::Vector3d read_axis(const targets::Node& node) {
  const auto entries = node.list_of(3, "a direction [x, y, z]");
  const Eigen::Vector3d v(entries[0].number(), entries[1].number(), entries[2].number());
  if (!(v.norm() > 0)) throw node.error("all three numbers are 0. Give a direction");
  return v.normalized();
}

std::string key_of(const targets::Section& entry) {
  const auto hinge = entry.optional("hinge"), bodies = entry.optional("bodies");
  if (hinge.has_value() == bodies.has_value())
    throw entry.error("the hinge is not clear. Give either `hinge` or `bodies`");
  if (hinge) return hinge->text("name of a soft part");
  const auto ends = bodies->list_of(2, "the names of two bodies");
  return ends[0].text("name of a body") + "/" + ends[1].text("name of a body");
}

}  // namespace

ModelParts read_model_parts(const ImportRequest& request) {
  const bool pair = !request.hard.empty();
  if (pair == !request.model.empty() || (!pair && !request.soft.empty()))
    throw InvalidInput("the model is missing. Give MODEL, or --hard FILE and --soft FILE");
  ModelParts out;
  std::vector<ModelFile> files;
  if (pair) {
    files.push_back(read_model_file(request.hard));
    if (!request.soft.empty()) files.push_back(read_model_file(request.soft));
    out.source = request.hard + (request.soft.empty() ? "" : " and " + request.soft);
    out.softness = request.soft.empty() ? "none" : "as asked";
  } else {
    files.push_back(read_model_file(request.model));
    out.source = request.model;
  }
  out.unit = to_mm(request.unit, files);
  for (ModelFile& file : files) join_open_meshes(file.meshes);
  Names names;
  for (std::size_t k = 0; k < files.size(); ++k) {
    if (pair) {
      for (const FoundMesh& mesh : files[k].meshes) add_parts(mesh, k == 1, names, out);
      continue;
    }
    const Softness softness(request, files[k]);
    out.softness = softness.words();
    out.unclear = softness.unclear();
    for (const FoundMesh& mesh : files[k].meshes) add_parts(mesh, softness.is_soft(mesh), names, out);
  }
  refuse_repeated_parts(out.parts, files.back().file);
  return out;
}

const targets::KeyTable& hinge_choice_keys() {
  static const targets::KeyTable keys({
      {"kinetix", value::integer(1, 1), targets::needed, "version of the file format"},
      {"hinges", value::list(value::map(choice_keys()), "a list of hinges", 0), targets::no_default,
       "hinges with a given axis"},
      {"towards", axis_type(), targets::no_default,
       "direction for ambiguous hinges that are not listed: the nearest axis is used"},
  });
  return keys;
}

model::HingeChoices read_hinge_choices(const std::string& file) {
  const targets::Section root = read_root(targets::read_document(file), hinge_choice_keys());
  model::HingeChoices out;
  if (const auto list = root.optional("hinges"))
    for (const targets::Node& entry : list->list("a list of hinges")) {
      const targets::Section section(entry, choice_keys());
      if (!out.axes
               .try_emplace(key_of(section),
                            read_axis(section.required("axis", "its axis, e.g. `axis: [0, 0, 1]`")))
               .second)
        throw entry.error("the hinge is listed twice. Remove one entry");
    }
  if (const auto towards = root.optional("towards")) out.towards = read_axis(*towards);
  return out;
}

}  // namespace kinetix::app
