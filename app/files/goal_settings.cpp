#include "app/files/goal_settings.hpp"

#include "app/files/file_header.hpp"
#include "app/files/process_section.hpp"
#include "targets/document/bound_key.hpp"

namespace kinetix::app {

void note_process(const GoalSettings& settings, const model::CellSize& size,
                  std::vector<std::string>& notes) {
  note_process(settings.process, size, settings.hinge.made, notes);
  for (const HingePart& part : settings.hinge_parts)
    note_process(settings.process, size, part.hinge.made, notes);
}

namespace {

bool starts_as_number(const std::string& word) { return word.find_first_of("0123456789.+-") == 0; }

/// Nothing where the file does not ask for it.
std::optional<double> read_robust(const targets::Section& root) {
  const auto node = root.optional("robust");
  if (!node) return std::nullopt;
  const bool is_number =
      node->kind() == targets::Node::Kind::scalar && starts_as_number(node->text("true, false or a weight"));
  if (is_number) return node->number(targets::part_of_one);
  return node->boolean() ? std::optional(1.0) : std::nullopt;
}

/// Of springs that would have nothing to turn.
void refuse_idle_drive(const targets::Section& root, const GoalSettings& settings) {
  if (!settings.drive || settings.hinge.model == HingeSection::Model::elastic) return;
  throw root.optional("drive")->key_error(
      "shape_memory needs elastic hinges, which its springs turn: give `hinge:`, such as `hinge: "
      "{kind: film, material: pp, gap_mm: 2, thickness_mm: 0.4}`");
}

}  // namespace

targets::Key robust_key(const std::string& over) {
  return {"robust",
          targets::value::either({targets::value::boolean(), targets::value::number(targets::part_of_one)}),
          targets::by_default("false"),
          "of the designs that meet the goal, the one whose [prints](hinges.md#4-as-made) come nearest to "
          "it, over " +
              over +
              "; a number weighs what prints are expected to be off against what the design itself is, with "
              "the rest "
              "to 1: `true` is 1"};
}

targets::KeyTable goal_keys(std::vector<targets::Key> own, const std::string& hinge,
                            std::vector<targets::Key> more) {
  if (!hinge.empty()) {
    own.push_back({"hinge", hinge_keys(), hinge});
    own.push_back(goal_drive_key());
  }
  own.push_back({"physics", physics_keys(), "settings of the physics run"});
  own.push_back(process_key());
  own.insert(own.end(), more.begin(), more.end());
  return file_keys(std::move(own));
}

targets::Key verify_key(double usual) {
  return {"verify", &GoalSettings::verify_tolerance, targets::value::number(targets::part_of_one),
          targets::by_default(usual), "most of [verify_rms](#verify_rms-and-verify_max), cell edges"};
}

void read_settings(const targets::Section& root, double edge_mm, GoalSettings& settings) {
  settings.name = read_name(root);
  root.read_into(settings);
  if (root.knows("solver")) settings.solver = read_solver(root);
  settings.physics = read_physics(root, edge_mm);
  settings.process = read_process(root);
  if (root.knows("robust")) settings.robust = read_robust(root);
}

void read_hinges(const targets::Section& root, const std::optional<model::CellSize>& size,
                 GoalSettings& settings) {
  if (const auto hinge = root.optional("hinge"); hinge && !size)
    throw hinge->key_error(
        "needs structure.cell_mm: a hinge has its size, and cells that are left out get theirs by the "
        "search");
  settings.drive = read_goal_drive(root);
  if (size) {
    settings.hinge = read_hinge_section(root, *size);
    settings.hinge_parts = read_hinge_parts(root, *size);
    refuse_lines(root, settings.hinge_parts);
  }
  refuse_idle_drive(root, settings);
  settings.process = size ? read_process(root, *size, settings.hinge.made) : read_process(root);
  for (const HingePart& part : settings.hinge_parts) read_process(root, *size, part.hinge.made);
}

}  // namespace kinetix::app
