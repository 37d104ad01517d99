#include "app/files/goal_drive.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;

constexpr targets::Word<bool> kinds[] = {{"usual", false},
                                         {"shape_memory", true}};  // whether springs fold it

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

std::optional<model::ShapeMemory> read_goal_drive(const targets::Section& root) {
  const auto node = root.optional("drive");
  if (!node) return std::nullopt;
  const auto kind = node->optional("kind");
  const bool by_springs = kind && read_word(*kind, kinds);
  const targets::KeyTable own = keys().only(by_springs ? "shape_memory" : "usual");
  const targets::Section section(*node, own);
  if (!by_springs) return std::nullopt;
  model::ShapeMemory springs;
  section.read_needed("k_turn", "a stiffness in N mm/rad", springs.k_turn);
  return springs;
}

}  // namespace kinetix::app
