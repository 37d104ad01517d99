#include "app/sweep/plan/edit.hpp"

#include <fmt/format.h>
#include <charconv>
#include <set>

#include "app/files/bodies_section.hpp"
#include "app/goals/registry.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {

SweepBase read_base(const std::string& file, const targets::DocumentChanges& changes) {
  SweepBase base{
      .root = targets::read_changed_document(file, max_design_bytes, changes), .design = {}, .target = {}};
  if (base.root.kind() == targets::Node::Kind::map && base.root.optional("target"))
    base.target = read_target(base.root);
  else
    base.design = read_design(base.root);
  return base;
}

namespace {

constexpr std::size_t longest_compared = 200;  // bytes: bounds the time of a comparison

using Kind = Edit::Kind;

// Bounds of fold angles and tilts.
const targets::Bounds tilt = targets::between(-90, 90, "degrees");

/// Number of a hinge that can end a path.
struct HingeNumber {
  const char* key;
  std::string_view old_key;  ///< earlier name; empty: none
  Kind kind;
  double model::HingeParameters::*member;
  double flipped;          ///< sum of the numbers of two hinges that alternate
  targets::Bounds bounds;  ///< fractions, degrees or cell edges

  bool in_degrees() const { return bounds.unit == "degrees"; }
  bool in_mm() const { return kind == Kind::t_mm || kind == Kind::offset_mm; }
};

using Hinge = model::HingeParameters;
// Default and bounds of each number, in the unit of its key.
const HingeNumber hinge_numbers[] = {
    {"hinge_position", "t", Kind::t, &Hinge::t, 1, targets::between(0, 1)},
    {"hinge_position_mm", "t_mm", Kind::t_mm, &Hinge::t, 1, targets::between(0, 1)},
    {"alpha_deg", "", Kind::alpha_deg, &Hinge::alpha, pi, targets::between(0, 180, "degrees")},
    {"tilt_deg", "beta_deg", Kind::beta_deg, &Hinge::beta, 0, tilt},
    {"offset_mm", "", Kind::offset_mm, &Hinge::offset, 0, targets::between(-0.5, 0.5, "cell edges")}};

/// Writes every position as `[*]`: names that differ only in a number become one.
std::string pattern(targets::DocumentPath path) {
  for (targets::PathStep& step : path)
    if (step.key.empty()) step.position = targets::PathStep::every;
  return to_string(path);
}

bool has_hinges(const SweepBase& base) {
  const auto design = base.root.optional("design");
  return design && design->optional("hinges");
}

/// Lists the groups of hinges that paths can name. Only squares have columns and rows of walls.
std::vector<const char*> groups_of_hinges(const SweepBase& base) {
  std::vector<const char*> groups = {"walls"};
  if (base.design->structure.squares()) groups.insert(groups.end(), {"columns", "rows"});
  if (has_hinges(base)) groups.push_back("hinges");
  return groups;
}

std::set<std::string> patterns(const SweepBase& base, const targets::DocumentEditor& editor) {
  std::set<std::string> names;
  const auto add = [&](const std::string& name) {
    if (name != "kinetix" && name.find(".wall[") == std::string::npos)
      names.insert(pattern(targets::parse_path(name)));
  };
  for (const std::string& name : editor.numbers()) add(name);
  for (const std::string& name : optional_keys(base)) add(name);
  if (!base.design || base.has_bodies()) return names;
  for (const char* group : groups_of_hinges(base))
    for (const HingeNumber& number : hinge_numbers)
      for (const std::string_view key : {std::string_view(number.key), number.old_key})
        if (!key.empty()) names.insert(fmt::format("design.{}[*].{}", group, key));
  return names;
}

/// Adds the paths of numbers that a file may leave out, from the type that reads it.
void add_numbers(const targets::ValueType& type, const std::string& path, std::vector<std::string>& paths) {
  if (type.is_numeric()) paths.push_back(path);
  if (type.kind == targets::ValueType::Kind::either)
    for (const targets::ValueType& alternative : type.parts) add_numbers(alternative, path, paths);
  if (type.kind != targets::ValueType::Kind::map) return;
  for (const targets::Key& key : type.keys->keys())
    if (key.fallback.kind != targets::Default::Kind::needed || !key.type.is_numeric())
      add_numbers(key.type, path.empty() ? key.name : path + "." + key.name, paths);
}

/// Finds a key of a map, or of the maps that a value may be. @return null for all other keys
const targets::Key* find_key(const targets::ValueType& type, std::string_view name) {
  if (type.kind == targets::ValueType::Kind::map) return type.keys->find(name);
  for (const targets::ValueType& alternative : type.parts)
    if (type.kind == targets::ValueType::Kind::either)
      if (const targets::Key* key = find_key(alternative, name)) return key;
  return nullptr;
}

targets::ValueType file_type(const SweepBase& base) {
  return targets::value::map(base.target         ? base.target->kind->table()
                             : base.has_bodies() ? bodies_keys()
                                                 : design_keys());
}

/// Returns the path with current names of keys. @param as_in_file whether keys that the base gives by their earlier
/// names keep these
targets::DocumentPath renamed(const SweepBase& base, targets::DocumentPath path, bool as_in_file) {
  targets::ValueType type = file_type(base);
  std::optional<targets::Node> node = base.root;
  for (targets::PathStep& step : path) {
    const targets::Key* key = step.key.empty() ? nullptr : find_key(type, step.key);
    if (!key) return path;
    const bool is_map = node && node->kind() == targets::Node::Kind::map;
    const bool is_old = is_map && !key->old_name.empty() && node->optional(key->old_name);
    step.key = is_old && as_in_file ? key->old_name : key->name;
    node = is_map ? node->optional(is_old ? key->old_name : key->name) : std::nullopt;
    type = targets::ValueType(key->type);
  }
  return path;
}

}  // namespace

std::vector<std::string> optional_keys(const SweepBase& base) {
  if (base.has_bodies()) return {"structure.cell_mm", "drive.angle_deg"};
  std::vector<std::string> paths;
  add_numbers(file_type(base), {}, paths);
  return paths;
}

std::string describe_unknown_path(const SweepBase& base, const targets::DocumentEditor& editor,
                                  const targets::DocumentPath& path) {
  const std::string asked = pattern(path);
  for (const targets::RemovedKey& key : physics_keys().removed())
    if (asked == "physics." + key.name) return fmt::format("`{}` {}", asked, key.answer);
  std::string nearest;
  int least = std::numeric_limits<int>::max();
  for (const std::string& name : patterns(base, editor)) {
    if (name == asked)
      return fmt::format("`{}` has no such entry. Count positions from 0, or write `[*]` for all entries",
                         to_string(path));
    const int distance = targets::spelling_distance(asked.substr(0, longest_compared), name);
    if (distance >= least) continue;
    least = distance;
    nearest = name;
  }
  return fmt::format("the base has no number at {}. Did you mean `{}`?", targets::in_ticks(to_string(path)),
                     nearest);
}

namespace {

std::optional<Kind> hinge_key(const std::string& key) {
  for (const HingeNumber& number : hinge_numbers)
    if (key == number.key || (!number.old_key.empty() && key == number.old_key)) return number.kind;
  return std::nullopt;
}

/// @pre `kind` is a number of a hinge
const HingeNumber& number_of(Kind kind) {
  return hinge_numbers[static_cast<int>(kind) - static_cast<int>(Kind::t)];
}

bool selects(const targets::PathStep& step, int position) {
  return step.position == targets::PathStep::every || step.position == position;
}

/// Returns whether the path is `design.GROUP[n].KEY` with a key of hinges.
bool is_hinge_path(const targets::DocumentPath& path, const char* group) {
  return path.size() == 4 && path[0].key == "design" && path[1].key == group && path[2].key.empty() &&
         hinge_key(path[3].key).has_value();
}

std::string entry(const targets::DocumentPath& path, int position) {
  return fmt::format("design.{}[{}].{}", path[1].key, position, path[3].key);
}

std::vector<Match> walls(const model::Lattice& structure, const targets::DocumentPath& path) {
  std::vector<Match> matches;
  for (int k = 0; k < structure.hinges(); ++k)
    if (selects(path[2], k)) matches.push_back({entry(path, k), {{*hinge_key(path[3].key), k}}});
  return matches;
}

/// Returns the hinges of the walls of a column (axis x) or row (axis y), for each that the path selects.
std::vector<Match> lines(const model::Structure& structure, const targets::DocumentPath& path,
                         model::Axis axis) {
  const Kind kind = *hinge_key(path[3].key);
  std::vector<Match> matches;
  const auto add = [&](int line) {
    Match match{entry(path, line), {}};
    for (const int k : hinges_on_line(structure, axis, line)) {
      const model::Wall& wall = structure.hinges[k].wall;
      const bool by_class = kind == Kind::t || kind == Kind::t_mm || kind == Kind::offset_mm;
      match.edits.push_back({kind, k, by_class ? starts_in_sublattice_b(wall) : alternation(wall) < 0});
    }
    if (!match.edits.empty()) matches.push_back(std::move(match));
  };
  for (int line = 0; line < line_count(structure, axis); ++line)
    if (selects(path[2], line)) add(line);
  return matches;
}

/// Returns the hinges that the file names, in its order.
std::vector<Match> named_hinges(const SweepBase& base, const targets::DocumentPath& path) {
  const auto section = base.root.optional("design");
  const auto list = section ? section->optional("hinges") : std::nullopt;
  std::vector<Match> matches;
  if (!list) return matches;
  const WallReader walls(base.design->structure);
  const auto entries = list->list("hinges");
  for (int n = 0; n < static_cast<int>(entries.size()); ++n) {
    if (!selects(path[2], n)) continue;
    const int hinge = walls.hinge_of(targets::Section(entries[n], hinge_entry_keys()));
    matches.push_back({entry(path, n), {{*hinge_key(path[3].key), hinge}}});
  }
  return matches;
}

std::vector<Match> structural(const SweepBase& base, const targets::DocumentPath& path) {
  if (!base.design || base.has_bodies()) return {};
  const model::Lattice& structure = base.design->structure;
  if (renamed(base, path, false) == targets::parse_path("design.fold_angle_deg"))
    return {{to_string(path), {{Kind::theta_deg}}}};
  if (is_hinge_path(path, "walls")) return walls(structure, path);
  const model::Structure* squares = structure.squares();
  if (squares && is_hinge_path(path, "columns")) return lines(*squares, path, model::Axis::x);
  if (squares && is_hinge_path(path, "rows")) return lines(*squares, path, model::Axis::y);
  if (is_hinge_path(path, "hinges")) return named_hinges(base, path);
  return {};
}

bool is_optional_key(const SweepBase& base, const targets::DocumentPath& path) {
  const std::string text = to_string(path);
  for (const std::string& key : optional_keys(base))
    if (key == text) return true;
  return false;
}

/// Converts to degrees as a file writes them: 30, not 30.000000000000004.
double degrees_of(double radians) {
  const std::string text = targets::degrees_text(radians);
  double degrees = to_degrees(radians);
  std::from_chars(text.data(), text.data() + text.size(), degrees);
  return degrees;
}

void check_range(double value, const targets::Bounds& bounds) {
  if (!bounds.contains(value))
    throw InvalidInput(fmt::format("{} is out of range. Give {}", value, bounds.describe()));
}

}  // namespace

std::vector<Match> find_matches(const SweepBase& base, targets::DocumentEditor& editor,
                                const targets::DocumentPath& path) {
  std::vector<Match> matches = structural(base, path);
  if (!matches.empty()) return matches;
  const targets::DocumentPath in_file = renamed(base, path, true);
  const auto items =
      is_optional_key(base, renamed(base, path, false)) ? editor.find_or_add(in_file) : editor.find(in_file);
  for (const int item : items) matches.push_back({editor.path(item), {{Kind::document, item}}});
  if (matches.empty()) throw InvalidInput(describe_unknown_path(base, editor, path));
  return matches;
}

std::optional<double> base_value(const SweepBase& base, const targets::DocumentEditor& editor,
                                 const Edit& edit) {
  if (edit.kind == Kind::document) return editor.number(edit.index);
  const Design& design = *base.design;
  if (edit.kind == Kind::theta_deg) return degrees_of(design.theta);
  const HingeNumber& number = number_of(edit.kind);
  const double own = design.structure.hinge(edit.index).*number.member,
               value = edit.flipped ? number.flipped - own : own;
  if (number.in_mm()) return value * design.structure.size().edge_mm;
  return number.in_degrees() ? degrees_of(value) : value;
}

void apply(const Edit& edit, double value, Design& design) {
  if (edit.kind == Kind::theta_deg) {
    check_range(value, tilt);
    design.theta = targets::radians_of(value);
    return;
  }
  const HingeNumber& number = number_of(edit.kind);
  if (number.in_mm()) value /= design.structure.size().edge_mm;
  check_range(value, number.bounds);
  if (number.in_degrees()) value = targets::radians_of(value);
  design.structure.hinge(edit.index).*number.member = edit.flipped ? number.flipped - value : value;
}

}  // namespace kinetix::app
