#include "app/files/goal_drive.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;
using Kind = GoalDrive::Kind;

constexpr targets::Word<Kind> kinds[] = {{"usual", Kind::usual}, {"shape_memory", Kind::shape_memory}};

const targets::KeyTable& keys() {
  static const targets::KeyTable all(
      {
          {"kind", value::choice(kinds), targets::by_default("usual"),
           "`usual`: two plates, or one hinge that is turned, whichever folds the sheet's family most "
           "evenly; `shape_memory`: a spring in each hinge whose rest angle goes from flat to that of the "
           "design, as "
           "that of a shape-memory material when it is heated"},
          {"k_turn", value::number(targets::above(0, "N mm/rad")), targets::needed, "of each such spring",
           "shape_memory"},
      },
      {{"usual", "shape_memory"}, "kind"});
  return all;
}

}  // namespace

targets::Key goal_drive_key() {
  return {"drive", value::map(keys()), {}, "what moves the sheet where its hinges are elastic (`hinge`)"};
}

GoalDrive read_goal_drive(const targets::Section& root) {
  const auto node = root.optional("drive");
  GoalDrive drive;
  if (!node) return drive;
  if (const auto kind = node->optional("kind")) drive.kind = read_word(*kind, kinds);
  const targets::KeyTable own = keys().only(drive.kind == Kind::usual ? "usual" : "shape_memory");
  const targets::Section section(*node, own);
  if (drive.kind == Kind::shape_memory)
    section.read_needed("k_turn", "a stiffness in N mm/rad", drive.k_turn);
  return drive;
}

}  // namespace kinetix::app
