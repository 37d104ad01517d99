#include "app/goals/display/display_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/files/file_header.hpp"
#include "app/files/structure_section.hpp"
#include "optim/display/display_search.hpp"
#include "targets/display/read_display.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;
using model::Axis;
using optim::Channel;

constexpr double default_cell_mm = 10;  // a cell that a hand takes hold of, as in a design
// Of the plates' first distance, a fraction: a basic sheet has closed at 1 - cos 45 deg = 0.29 already.
constexpr targets::Bounds allowed_compression = {0, 0.5, false, true};
// Of tolerances in cell edges: 0 cannot be met, and an error of a whole cell is no agreement.
constexpr targets::Bounds part_of_one = {0, 1, false, true};
// Those that use gradients of a single cost, the default first.
const std::vector<optim::SolverName> fitting_solvers = {optim::SolverName::mma, optim::SolverName::ccsa,
                                                        optim::SolverName::slsqp};
// What the keys `channel` and `axis` may say.
constexpr targets::Word<Channel> channels[] = {
    {"aperture", Channel::aperture}, {"area", Channel::area}, {"rotation", Channel::rotation}};
constexpr targets::Word<Axis> axes[] = {{"x", Axis::x}, {"y", Axis::y}};

targets::KeyTable structure_keys() {
  return targets::KeyTable(
      {targets::panel_cells_key(), cell_mm_key(targets::by_default(default_cell_mm)), wall_mm_key()});
}

targets::KeyTable drive_keys(const DisplayFile& usual) {
  return targets::KeyTable({
      {"kind", value::choice({"plates"}), targets::by_default("plates"), "two plates press on the rim"},
      {"axis", value::choice(axes), targets::by_default("y"), "normal of the plates"},
      {"compression", value::number(allowed_compression), targets::by_default(usual.compression),
       "1 less the final over the initial distance of the plates"},
  });
}

targets::KeyTable t_keys(const DisplayFile& usual) {
  return targets::KeyTable({
      {"range", value::range({0, 1, false, false}), targets::by_default(usual.t),
       "where hinges may sit on their walls"},
      {"corner_mm", value::length(targets::from_to(0, 0.45, "mm (up to 0.45 cells)")),
       targets::by_default(0.0), "least distance of a hinge from the ends of its wall"},
      symmetry_key(),
  });
}

targets::KeyTable variables_keys(const DisplayFile& usual) {
  const targets::KeyTable compression({{"range", value::range(allowed_compression), targets::needed,
                                        "where to search; the search starts from `drive.compression`"}});
  return targets::KeyTable({
      {"t", value::map(t_keys(usual)), {}, "the positions of the hinges"},
      {"compression", value::map(compression), targets::otherwise("`drive.compression`, not searched"),
       "how far the panel is compressed"},
      {"axis", value::list(value::choice(axes), "`[x, y]`", 1, 2), targets::otherwise("`drive.axis`"),
       "directions to try; the best is taken"},
  });
}

targets::KeyTable tolerance_keys(const DisplayFile& usual) {
  return targets::KeyTable({
      {"stretch", value::number(part_of_one), targets::by_default(usual.stretch),
       "most that a hinge may stretch, cell edges"},
      {"auc", value::number({0.5, 1, false, true}), targets::by_default(usual.auc),
       "least [auc](#contrast-and-auc); of greys the rank correlation"},
      {"contrast", value::number(targets::at_least(0)), targets::by_default(usual.contrast),
       "least [contrast](#contrast-and-auc), of pictures with two levels"},
      {"verify", value::number(part_of_one), targets::by_default(usual.verify),
       "most of [verify_rms](#verify_rms-and-verify_max), cell edges"},
  });
}

std::optional<targets::Node> under(const targets::Section& root, std::string_view section,
                                   std::string_view key) {
  return root.section(section).optional(key);
}

void read_goal(const targets::Section& root, DisplayFile& file) {
  const targets::Section structure = root.section("structure");
  file.goal = read_display(root.required("target", ""), structure.optional("cells"));
  root.section("target").read("channel", file.channel, channels);
  file.size = read_size(structure, default_cell_mm);
}

void read_drive(const targets::Section& root, DisplayFile& file) {
  const targets::Section section = root.section("drive");
  if (const auto node = section.optional("kind")) node->one_of({"plates"});
  section.read("axis", file.axes.front(), axes);
  section.read("compression", file.compression);
}

void read_t(const targets::Section& t, DisplayFile& file) {
  t.read("range", file.t);
  std::optional<double> corner_mm;
  t.read_length("corner_mm", corner_mm, file.size.edge_mm);
  if (corner_mm) {
    const double least = *corner_mm / file.size.edge_mm;
    file.t = {std::max(file.t[0], least), std::min(file.t[1], 1 - least)};
    if (!(file.t[0] < file.t[1])) throw t.optional("corner_mm")->error("leaves nothing of variables.t.range");
  }
  file.symmetry = read_symmetry(t, file.goal.columns, file.goal.rows);
}

void read_compression(const targets::Section& root, const targets::Section& compression, DisplayFile& file) {
  if (!compression.given()) return;
  std::array<double, 2> range;
  compression.read_needed("range", "e.g. `range: [0.05, 0.2]`", range);
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

void read_axes(const targets::Section& root, const targets::Node& list, DisplayFile& file) {
  if (under(root, "drive", "axis"))
    throw list.error("says which directions to try, and drive.axis which one to take; give only one of them");
  file.axes.clear();
  for (const targets::Node& node : list.list("x, y or both, such as [x, y]")) {
    const Axis axis = read_word(node, axes);
    if (std::find(file.axes.begin(), file.axes.end(), axis) != file.axes.end())
      throw node.error("is given twice");
    file.axes.push_back(axis);
  }
  if (file.axes.empty()) throw list.error("names no direction; give x, y or both, such as [x, y]");
}

void read_variables(const targets::Section& root, DisplayFile& file) {
  const targets::Section section = root.section("variables");
  read_t(section.section("t"), file);
  read_compression(root, section.section("compression"), file);
  if (const auto node = section.optional("axis")) read_axes(root, *node, file);
}

void read_tolerance(const targets::Section& root, DisplayFile& file) {
  const targets::Section section = root.section("tolerance");
  section.read("stretch", file.stretch);
  section.read("auc", file.auc);
  if (const auto contrast = section.optional("contrast"); contrast && !file.goal.is_binary())
    throw contrast->key_error("is for pictures of two levels; greys are judged by tolerance.auc alone");
  section.read("contrast", file.contrast);
  section.read("verify", file.verify);
}

void read_search(const targets::Section& root, DisplayFile& file) {
  file.solver = read_solver(root);
  if (!file.solver.name) return;
  if (std::find(fitting_solvers.begin(), fitting_solvers.end(), *file.solver.name) == fitting_solvers.end())
    throw under(root, "solver", "name")
        ->error("`" + to_string(*file.solver.name) +
                "` does not use gradients of a single cost; allowed for a display: mma, ccsa, slsqp");
}

}  // namespace

const targets::KeyTable& display_keys() {
  static const DisplayFile usual{};
  static const optim::DisplayOptions search{};
  static const targets::KeyTable keys = file_keys({
      {"target", value::map(targets::display_target_keys()), targets::needed, "the goal"},
      {"structure", value::map(structure_keys()), {}, "the flat panel"},
      {"variables", value::map(variables_keys(usual)), {}, "what the search may change, and how far"},
      {"drive", value::map(drive_keys(usual)), {}, "how the panel is compressed"},
      {"hinge", value::map(elastic_hinge_keys()), {}, "what the hinges are made of"},
      {"tolerance", value::map(tolerance_keys(usual)), {}, "when the goal is met"},
      {"solver",
       value::map(solver_keys(fitting_solvers, search.starts, search.solver.max_evaluations,
                              "per stage of a search")),
       {},
       "how the search is run; starts are counted per direction"},
      {"physics", value::map(physics_keys()), {}, "settings of the physics run"},
  });
  return keys;
}

DisplayFile read_display_file(const targets::Node& node) {
  const targets::Section root(node, display_keys());
  check_version(root);
  DisplayFile file;
  file.name = read_name(root);
  read_goal(root, file);
  read_drive(root, file);
  read_variables(root, file);
  read_tolerance(root, file);
  read_search(root, file);
  file.hinge = read_elastic_hinge_section(root, file.size.edge_mm);
  file.physics = read_elastic_physics(root, file.size.edge_mm);
  return file;
}

}  // namespace kinetix::app
