#include "app/files/goal_settings.hpp"

#include "app/files/process_section.hpp"

namespace kinetix::app {

targets::Key robust_key() {
  return {"robust", targets::value::boolean(), targets::by_default("false"),
          "of the designs that meet the goal, the one whose [prints](hinges.md#4-as-made) come nearest to "
          "it, over theta "
          "where the search is free to choose it, and over gaps of blocks and films"};
}

void read_hinges(const targets::Section& root, const std::optional<model::CellSize>& size,
                 GoalSettings& settings) {
  if (const auto hinge = root.optional("hinge"); hinge && !size)
    throw hinge->key_error(
        "needs structure.cell_mm: a hinge has its size, and cells that are left out get theirs by the "
        "search");
  settings.drive = read_goal_drive(root);
  if (!size) {
    settings.process = read_process(root);
    return;
  }
  settings.hinge = read_hinge_section(root, *size);
  settings.process = read_process(root, *size, settings.hinge.made);
}

}  // namespace kinetix::app
