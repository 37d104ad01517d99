#include "app/sweep/plan/nearest_path.hpp"

#include <fmt/format.h>

#include <limits>
#include <set>

#include "app/files/physics_section.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {
namespace {

constexpr std::size_t longest_compared = 200;  // bytes: bounds the time of a comparison

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
    for (const char* key : {"t", "t_mm", "alpha_deg", "beta_deg", "offset_mm"})
      names.insert(fmt::format("design.{}[*].{}", group, key));
  return names;
}

/// Adds the paths of numbers that a file may leave out, from the type that reads it.
void add_numbers(const targets::ValueType& type, const std::string& path, std::vector<std::string>& paths) {
  if (type.is_numeric()) paths.push_back(path);
  if (type.kind == targets::ValueType::Kind::either)
    for (const targets::ValueType& way : type.parts) add_numbers(way, path, paths);
  if (type.kind != targets::ValueType::Kind::map) return;
  for (const targets::Key& key : type.keys->keys())
    if (key.fallback.kind != targets::Default::Kind::needed || !key.type.is_numeric())
      add_numbers(key.type, path.empty() ? key.name : path + "." + key.name, paths);
}

}  // namespace

std::vector<std::string> optional_keys(const SweepBase& base) {
  if (base.has_bodies()) return {"structure.cell_mm", "drive.angle_deg"};
  std::vector<std::string> paths;
  add_numbers(targets::value::map(base.target ? base.target->kind->table() : design_keys()), {}, paths);
  return paths;
}

std::string no_such_path(const SweepBase& base, const targets::DocumentEditor& editor,
                         const targets::DocumentPath& path) {
  const std::string asked = pattern(path);
  for (const targets::RemovedKey& key : physics_keys().removed())
    if (asked == "physics." + key.name) return fmt::format("`{}` {}", asked, key.answer);
  std::string nearest;
  int least = std::numeric_limits<int>::max();
  for (const std::string& name : patterns(base, editor)) {
    if (name == asked)
      return fmt::format("`{}` has no such entry; positions count from 0, and `[*]` takes all of them",
                         to_string(path));
    const int distance = targets::spelling_distance(asked.substr(0, longest_compared), name);
    if (distance >= least) continue;
    least = distance;
    nearest = name;
  }
  return fmt::format("the base has no number at {}; the nearest is `{}`", targets::in_ticks(to_string(path)),
                     nearest);
}

}  // namespace kinetix::app
