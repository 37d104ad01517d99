#include "app/goals/read_target.hpp"

#include <fmt/format.h>

#include "app/files/file_header.hpp"
#include "app/goals/registry.hpp"

namespace kinetix::app {
namespace {

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
  if (root.kind() != targets::Node::Kind::map || root.optional("target")) return;
  if (root.optional("design"))
    throw root.error("this is a design, not a target; use it with verify or simulate");
  if (root.optional("factors"))
    throw root.error("this is a design of experiments, not a target; use it with sweep");
}

/// Says what is wrong with a file that names no goal: its keys, its version or its name, else that.
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

}  // namespace

Target read_target(const std::string& file) { return read_target(targets::read_document(file)); }

Target read_target(const targets::Node& root) {
  check_kind_of_file(root);
  const GoalKind& kind = kind_of(root);
  return {&kind, kind.read(root)};
}

}  // namespace kinetix::app
