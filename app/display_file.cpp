#include "app/display_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/file_header.hpp"
#include "app/structure_section.hpp"
#include "targets/read_display.hpp"

namespace kinetix {
namespace {

constexpr double default_cell_mm = 10;
constexpr Bounds allowed_compression = {0, 0.5, false, true};

std::optional<Node> under(const Node& root, std::string_view section, std::string_view key) {
  const auto node = root.optional(section);
  return node ? node->optional(key) : std::nullopt;
}

void read_goal(const Node& root, DisplayFile& file) {
  const Node target = root.required("target", "");
  if (const auto structure = root.optional("structure"))
    structure->reject_unknown_keys({"cells", "cell_mm", "wall_mm"});
  file.goal = read_display(target, under(root, "structure", "cells"));
  if (const auto node = target.optional("channel"))
    file.channel = node->choice<Channel>(
        {{"aperture", Channel::aperture}, {"area", Channel::area}, {"rotation", Channel::rotation}});
  file.size = read_size(root.optional("structure"), default_cell_mm);
}

Axis read_axis(const Node& node) { return node.choice<Axis>({{"x", Axis::x}, {"y", Axis::y}}); }

void read_drive(const Node& root, DisplayFile& file) {
  const auto section = root.optional("drive");
  if (!section) return;
  section->reject_unknown_keys({"kind", "axis", "compression"});
  if (const auto node = section->optional("kind")) node->one_of({"plates"});
  if (const auto node = section->optional("axis")) file.axes = {read_axis(*node)};
  if (const auto node = section->optional("compression"))
    file.compression = node->number(allowed_compression);
}

void read_t(const Node& t, DisplayFile& file) {
  t.reject_unknown_keys({"range", "corner_mm", "symmetry"});
  if (const auto node = t.optional("range")) file.t = node->range({0, 1, false, false});
  if (const auto node = t.optional("corner_mm")) {
    const double corner = node->number(from_to(0, 0.45 * file.size.edge_mm, "mm (up to 0.45 cells)"));
    const double least = corner / file.size.edge_mm;
    file.t = {std::max(file.t[0], least), std::min(file.t[1], 1 - least)};
    if (!(file.t[0] < file.t[1])) throw node->error("leaves nothing of variables.t.range");
  }
  if (const auto node = t.optional("symmetry"))
    file.symmetry = read_symmetry(*node, file.goal.columns, file.goal.rows);
}

void read_compression(const Node& root, const Node& compression, DisplayFile& file) {
  compression.reject_unknown_keys({"range"});
  const Node node = compression.required("range", "e.g. `range: [0.05, 0.2]`");
  const auto range = node.range(allowed_compression);
  file.compression_range = range;
  const auto given = under(root, "drive", "compression");
  const double start = std::clamp(file.compression, range[0], range[1]);
  if (given && start != file.compression)
    throw given->error(
        fmt::format("{:g} lies outside variables.compression.range, which is [{:g}, {:g}]; the search "
                    "starts there",
                    file.compression, range[0], range[1]));
  file.compression = start;
}

void read_axes(const Node& root, const Node& axes, DisplayFile& file) {
  if (under(root, "drive", "axis"))
    throw axes.error("says which directions to try, and drive.axis which one to take; give only one of them");
  file.axes.clear();
  for (const Node& node : axes.list("x, y or both, such as [x, y]")) {
    const Axis axis = read_axis(node);
    if (std::find(file.axes.begin(), file.axes.end(), axis) != file.axes.end())
      throw node.error("is given twice");
    file.axes.push_back(axis);
  }
  if (file.axes.empty()) throw axes.error("names no direction; give x, y or both, such as [x, y]");
}

void read_variables(const Node& root, DisplayFile& file) {
  const auto section = root.optional("variables");
  if (!section) return;
  section->reject_unknown_keys({"t", "compression", "axis"});
  if (const auto node = section->optional("t")) read_t(*node, file);
  if (const auto node = section->optional("compression")) read_compression(root, *node, file);
  if (const auto node = section->optional("axis")) read_axes(root, *node, file);
}

void read_tolerance(const Node& root, DisplayFile& file) {
  const auto section = root.optional("tolerance");
  if (!section) return;
  section->reject_unknown_keys({"stretch", "auc", "contrast", "verify"});
  const Bounds part_of_one = {0, 1, false, true};
  if (const auto node = section->optional("stretch")) file.stretch = node->number(part_of_one);
  if (const auto node = section->optional("auc")) file.auc = node->number({0.5, 1, false, true});
  if (const auto node = section->optional("contrast")) file.contrast = node->number(at_least(0, ""));
  if (const auto node = section->optional("verify")) file.verify = node->number(part_of_one);
}

void read_search(const Node& root, DisplayFile& file) {
  file.solver = read_solver(root);
  if (!file.solver.name) return;
  const bool fits = *file.solver.name == SolverName::mma || *file.solver.name == SolverName::ccsa ||
                    *file.solver.name == SolverName::slsqp;
  if (!fits)
    throw under(root, "solver", "name")
        ->error("`" + to_string(*file.solver.name) +
                "` does not use gradients of a single cost; allowed for a display: mma, ccsa, slsqp");
}

}  // namespace

DisplayFile read_display_file(const Node& root) {
  root.reject_unknown_keys({"kinetix", "name", "target", "structure", "variables", "drive", "hinge",
                            "tolerance", "solver", "physics"});
  check_version(root);
  DisplayFile file;
  file.name = read_name(root);
  read_goal(root, file);
  read_drive(root, file);
  read_variables(root, file);
  read_tolerance(root, file);
  read_search(root, file);
  file.hinge = read_hinge_section(root, file.size.edge_mm);
  file.physics = read_physics(root, file.size.edge_mm);
  return file;
}

}  // namespace kinetix
