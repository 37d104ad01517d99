#include "app/goals/registry.hpp"

#include <fmt/format.h>
#include <array>
#include <map>

#include "app/files/file_header.hpp"
#include "app/files/process_section.hpp"
#include "app/files/structure_section.hpp"
#include "targets/document/edit_document.hpp"
#include "targets/document/number.hpp"

namespace kinetix::app {

extern const GoalKind curve_kind, display_kind, fold_kind, helmet_kind, outline_kind, space_block_kind,
    space_curve_kind, surface_kind;

namespace {

std::vector<const GoalKind*>& kinds() {
  static std::vector<const GoalKind*> all = {
      // One kind per line.
      &curve_kind,        //
      &display_kind,      //
      &fold_kind,         //
      &helmet_kind,       //
      &outline_kind,      //
      &space_block_kind,  //
      &space_curve_kind,  //
      &surface_kind,
  };
  return all;
}

std::vector<std::string_view> names() {
  std::vector<std::string_view> all;
  for (const GoalKind* kind : goal_kinds()) all.push_back(kind->name);
  return all;
}

std::string kind_hint() {
  std::string hint;
  const auto all = names();
  for (std::size_t k = 0; k < all.size(); ++k)
    hint += fmt::format("{}`kind: {}`", k == 0 ? "" : k + 1 < all.size() ? ", " : " or ", all[k]);
  return hint;
}

std::string target_hint() { return fmt::format("e.g. `{}`", goal_kinds().front()->example); }

void check_kind_of_file(const targets::Node& root) {
  refuse_result(root);
  if (root.kind() != targets::Node::Kind::map || root.optional("target")) return;
  if (root.optional("design"))
    throw root.error("this file is a design, not a target. Use it with simulate, verify, view or export");
  if (root.optional("factors"))
    throw root.error("this file is a sweep, not a target. Use it with `kinetix-opt sweep`");
}

/// Returns the `target` section. If it is missing, reports wrong keys, version or name first, then the missing section.
targets::Node goal_of(const targets::Node& root) {
  if (root.kind() == targets::Node::Kind::map && root.optional("target"))
    return root.required("target", target_hint());
  const targets::Section section(root, goal_kinds().front()->table());
  check_version(section);
  read_name(section);
  return root.required("target", target_hint());
}

const GoalKind& kind_of(const targets::Node& root) {
  return *goal_kinds()[goal_of(root).required("kind", kind_hint()).one_of(names())];
}

/// Lists the kinds that accept a key at the top level of their files, separated by commas.
std::string kinds_with(std::string_view key) {
  std::string out;
  for (const GoalKind* kind : goal_kinds()) {
    const auto keys = kind->table().names();
    if (std::find(keys.begin(), keys.end(), key) != keys.end())
      out += (out.empty() ? "" : ", ") + std::string(kind->name);
  }
  return out;
}

/// Rejects `robust` for a kind without a robust search. The error names the kinds that have one.
void check_robust(const targets::Node& root, const GoalKind& kind) {
  const auto asked = root.optional("robust");
  const auto keys = kind.table().names();
  if (!asked || std::find(keys.begin(), keys.end(), "robust") != keys.end()) return;
  throw asked->error(fmt::format("goals of kind {} have no robust search. Remove the key, or use one of: {}",
                                 kind.name, kinds_with("robust")));
}

/// Returns the path of a variable with the name that the file has for it, which may be an earlier one.
std::string path_in_file(const targets::Node& root, const std::string& path) {
  constexpr std::array<std::array<std::string_view, 2>, 3> earlier = {
      {{"tilt", "beta"}, {"fold_angle", "theta"}, {"hinge_position", "t"}}};
  const auto variables = root.optional("variables");
  if (!variables || variables->kind() != targets::Node::Kind::map) return path;
  for (const auto& [name, before] : earlier) {
    const std::string start = fmt::format("variables.{}.", name);
    if (path.starts_with(start) && variables->optional(std::string(before)))
      return fmt::format("variables.{}.{}", before, path.substr(start.size()));
  }
  return path;
}

/// File of a target, and keys that are to be other than it has them.
class ChangedTarget {
 public:
  explicit ChangedTarget(const targets::Node& root) : given_(root), changed_(root) {}

  /// Returns a value of the section `structure` with the changes so far; empty if there is none.
  std::optional<targets::Node> structure(const std::string& key) const { return of_structure(root(), key); }
  /// Checks whether the file itself gives a key of that section.
  bool gives(const std::string& key) const { return of_structure(given_, key).has_value(); }

  void set_structure(const std::string& key, const std::string& yaml) {
    changes_given_ |= gives(key);
    changed_.put(targets::parse_path("structure." + key), yaml);
    structure_[key] = yaml;
  }

  /// Gives walls that are cut from a sheet its thickness as their height, if the file leaves the height open.
  void set_open_height() {
    if (const auto height_mm = open_wall_height_mm(root()))
      changed_.put(targets::parse_path("structure.wall_mm.height"), targets::shortest_text(*height_mm));
  }

  /// Replaces any values. A key that the file has by its earlier name keeps that name.
  /// @return the changes: "structure.cells: [60, 1], structure.cell_mm: 8"
  std::string change(const targets::DocumentChanges& changes) {
    std::string all;
    for (const auto& [key, yaml] : changes) {
      const std::string path = path_in_file(given_, key);
      changed_.put(targets::parse_path(path), yaml);
      all += fmt::format("{}{}: {}", all.empty() ? "" : ", ", path, yaml);
    }
    return all;
  }

  bool changes_given() const { return changes_given_; }
  targets::Node root() const { return changed_.root(); }
  /// Returns the keys that differ: "structure: {cell_mm: 12.5}".
  std::string keys() const {
    std::string all;
    for (const auto& [key, yaml] : structure_) all += (all.empty() ? "" : ", ") + key + ": " + yaml;
    return "structure: {" + all + "}";
  }

 private:
  static std::optional<targets::Node> of_structure(const targets::Node& root, const std::string& key) {
    const auto section = root.optional("structure");
    return section && section->kind() == targets::Node::Kind::map ? section->optional(key) : std::nullopt;
  }

  targets::Node given_;
  targets::DocumentEditor changed_;
  std::map<std::string, std::string> structure_;
  bool changes_given_ = false;
};

std::string text(double number) { return fmt::format("{:.6g}", number); }

/// Sets fewer cells of the same total length, if the file gives their number or the kind has a usual one.
/// @return whether it did
bool set_fewer_cells(const GoalKind& kind, double share, ChangedTarget& target) {
  const auto cells = target.structure("cells");
  if (!cells && (!kind.usual_cells || target.gives("cell_mm"))) return false;
  std::array<int, 2> sides = kind.usual_cells.value_or(std::array{0, 0});
  if (cells) {
    const auto rectangle = as_rectangle(read_cells(*cells));
    if (!rectangle) throw cells->error("has no columns and rows");
    sides = *rectangle;
  }
  const auto fewer = [&](int side) { return std::max(1, static_cast<int>(std::floor(side * share))); };
  if (const auto cell_mm = target.structure("cell_mm"))
    target.set_structure("cell_mm", text(cell_mm->number() * sides[0] / fewer(sides[0])));
  target.set_structure("cells", fmt::format("[{}, {}]", fewer(sides[0]), fewer(sides[1])));
  return true;
}

/// Gives a target cells of another size, mm. @param before size of its cells, mm
void resize(const GoalKind& kind, const model::CellSize& before, const model::CellSize& size,
            ChangedTarget& target) {
  const bool is_larger = size.edge_mm > before.edge_mm;
  const bool has_fewer =
      is_larger && kind.keeps_length && set_fewer_cells(kind, before.edge_mm / size.edge_mm, target);
  // Kinds that choose the number of cells themselves would choose another one for other walls.
  const bool is_number_open =
      kind.keeps_length && !kind.usual_cells && !target.structure("cells") && !target.structure("cell_mm");
  if ((is_larger && !has_fewer) || is_number_open) target.set_structure("cell_mm", text(size.edge_mm));
  const bool has_walls = size.thickness_mm == before.thickness_mm && size.height_mm == before.height_mm;
  if (target.structure("wall_mm") && has_walls) return;
  target.set_structure(
      "wall_mm", fmt::format("{{thickness: {}, height: {}}}", text(size.thickness_mm), text(size.height_mm)));
}

/// Reads a goal that can be read again with other cells or other values.
std::unique_ptr<Goal> read_resizable(const GoalKind& kind, const ChangedTarget& target) {
  std::unique_ptr<Goal> goal = kind.read(target.root());
  goal->resize = [&kind, target](const model::CellSize& before,
                                 const model::CellSize& size) -> std::optional<Goal::Changed> {
    try {
      ChangedTarget next = target;
      resize(kind, before, size, next);
      return Goal::Changed{read_resizable(kind, next), next.keys(), next.changes_given()};
    } catch (const InvalidInput&) {
      return std::nullopt;  // the goal allows no such cells
    }
  };
  goal->change = [&kind, target](const targets::DocumentChanges& changes) {
    ChangedTarget next = target;
    const std::string keys = next.change(changes);
    return Goal::Changed{read_resizable(kind, next), keys};
  };
  return goal;
}

}  // namespace

const std::vector<const GoalKind*>& goal_kinds() { return kinds(); }

void add_goal_kind(const GoalKind& kind) { kinds().push_back(&kind); }

Target read_target(const std::string& file) { return read_target(targets::read_document(file)); }

Target read_target(const targets::Node& root) {
  check_kind_of_file(root);
  const GoalKind& kind = kind_of(root);
  check_robust(root, kind);
  ChangedTarget target(root);
  target.set_open_height();
  return {&kind, read_resizable(kind, target)};
}

}  // namespace kinetix::app
