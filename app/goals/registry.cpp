#include "app/goals/registry.hpp"

#include <fmt/format.h>

#include "app/files/file_header.hpp"

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
    throw root.error("this is a design, not a target; use it with simulate, verify, view or export");
  if (root.optional("factors"))
    throw root.error("this is a design of experiments, not a target; use it with sweep");
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
  throw asked->error(
      fmt::format("goals of kind {} have no robust search; these have: {}", kind.name, kinds_with("robust")));
}

}  // namespace

const std::vector<const GoalKind*>& goal_kinds() { return kinds(); }

void add_goal_kind(const GoalKind& kind) { kinds().push_back(&kind); }

Target read_target(const std::string& file) { return read_target(targets::read_document(file)); }

Target read_target(const targets::Node& root) {
  check_kind_of_file(root);
  const GoalKind& kind = kind_of(root);
  check_robust(root, kind);
  return {&kind, kind.read(root)};
}

}  // namespace kinetix::app
