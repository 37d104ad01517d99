#include "app/goals/display/display_file.hpp"

#include <fmt/format.h>

#include "app/files/drive_section.hpp"
#include "app/files/file_header.hpp"
#include "app/files/process_section.hpp"
#include "app/goals/display/display_panel.hpp"
#include "optim/display/display_search.hpp"
#include "targets/display/display_goal.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;
using model::Axis;
using optim::Channel;

constexpr double display_cell_mm = 10;  // mm: easy to grip by hand, and the default of a design
// Fraction of the plates' initial distance. A basic sheet is already closed at 1 - cos 45 deg = 0.29.
constexpr targets::Bounds allowed_compression = {0, 0.5, false, true};
// Offset or stretch of a hinge, as a fraction of cell_mm.
const targets::Bounds allowed_offset = {0, 0.5, true, false, "mm (below half of cell_mm)"};
// Solvers that use gradients of a single cost, the default first.
const std::vector<optim::SolverName> fitting_solvers = {optim::SolverName::mma, optim::SolverName::ccsa,
                                                        optim::SolverName::slsqp};
// Turn of a driven hinge, degrees: 120 is 2 theta at the plates' largest compression of 0.5.
const targets::Bounds allowed_turn = {0, 120, false, true, "degrees"};
// Values of the keys `channel`, `axis` and `kind`.
constexpr targets::Word<Channel> channels[] = {{"light", Channel::light},
                                               {"aperture", Channel::aperture},
                                               {"area", Channel::area},
                                               {"rotation", Channel::rotation}};
constexpr targets::Word<Axis> axes[] = {{"x", Axis::x}, {"y", Axis::y}};
constexpr targets::Word<bool> drives[] = {{"plates", false}, {"hinge", true}};

targets::KeyTable display_structure_keys() {
  std::vector<targets::Key> keys = lattice_choice_keys(true);
  keys.insert(keys.begin() + 1, targets::panel_cells_key());
  keys.push_back(cell_mm_key(targets::by_default(display_cell_mm)));
  keys.push_back(wall_mm_key());
  return targets::KeyTable(std::move(keys));
}

targets::KeyTable display_drive_keys() {
  return targets::KeyTable(
      {
          {"kind", value::choice(drives), targets::by_default("plates"),
           "`plates`: two plates press on the boundary, whose rows stay straight. `hinge`: one hinge is "
           "turned "
           "and all rows are free, which shows a clearer picture"},
          {"axis", value::choice(axes), targets::by_default("y"), "normal of the plates", "plates"},
          {"compression", &DisplayFile::compression, value::number(allowed_compression),
           "relative shortening: 1 minus the ratio of final to initial distance of the plates", "plates"},
          press_key(),
          {"angle_deg", &DisplayFile::angle, value::angle(allowed_turn),
           "rotation of the hinge, in the direction that shows the picture", "hinge"},
          wall_key("hinge", targets::otherwise("a wall in the middle of the panel that is hardly scaled")),
      },
      {{"plates", "hinge"}, "kind"});
}

targets::KeyTable t_keys() {
  return targets::KeyTable({
      {"range", &DisplayFile::t, value::range({0, 1, false, false}),
       "allowed positions of hinges along their walls. The default is `[0.08, 0.92]` if "
       "`variables.offset_mm` is 0. If a `symmetry` maps a position p to 1 - p, the end nearer to 0.5 limits "
       "both sides"},
      {"corner_mm", value::length(targets::from_to(0, 0.45, "mm (up to 0.45 cells)")),
       targets::by_default(0.0), "minimum distance of a hinge from the ends of its wall"},
      symmetry_key("symmetry of the flat panel. `rotate_4` needs as many columns as rows"),
  });
}

targets::KeyTable display_variables_keys() {
  const targets::KeyTable compression({{"range", value::range(allowed_compression), targets::needed,
                                        "range of the search, which starts from `drive.compression`"}});
  return targets::KeyTable({
      {"offset_mm", value::length(allowed_offset),
       targets::otherwise("0.08 `cell_mm`; 0 with a `solver`, a `hinge_position.symmetry`, or a `channel` "
                          "other than `light`"),
       "largest lateral offset of a hinge. Such hinges show a picture without stretching. 0: hinges on their "
       "walls, which have to stretch"},
      {"stretch_mm", value::length(allowed_offset), targets::by_default(0.0),
       "limit of the joint separation of hinges with offsets. Separation gives a clearer picture, and needs "
       "more force and a longer search. 0: none"},
      targets::Key("hinge_position", t_keys(), "positions of the hinges along their walls").formerly("t"),
      {"compression", compression, "compression of the panel",
       targets::otherwise("`drive.compression`, not searched")},
      {"axis", value::list(value::choice(axes), "`[x, y]`", 1, 2), targets::otherwise("`drive.axis`"),
       "directions to try. The search keeps the best"},
  });
}

targets::KeyTable display_tolerance_keys() {
  std::vector<targets::Key> keys = {
      {"stretch", &DisplayFile::stretch, value::number(targets::part_of_one),
       "limit of the joint separation, in cell edges"},
      {"auc", &DisplayFile::auc, value::number({0.5, 1, false, true}),
       "minimum of [auc](#contrast-and-auc). For greys: minimum of the rank correlation"},
      {"contrast", &DisplayFile::contrast, value::number(targets::at_least(0)),
       "minimum of [contrast](#contrast-and-auc), the separation d′ of pictures with two levels"},
      verify_key(DisplayFile::default_verify_tolerance),
  };
  const auto limits =
      hinge_limit_keys("The search presses the panel less to stay within it",
                       targets::otherwise("the limit of the material of `hinge`; none without `hinge.kind`"));
  keys.insert(keys.end() - 1, limits.begin(), limits.end());
  return targets::KeyTable(std::move(keys));
}

std::optional<targets::Node> under(const targets::Section& root, std::string_view section,
                                   std::string_view key) {
  return root.section(section).optional(key);
}

targets::Section t_section(const targets::Section& root) {
  return root.section("variables").section("hinge_position");
}

/// Returns whether a file has settings that only apply to hinges on their walls.
bool requests_walls(const targets::Section& root, const DisplayFile& file) {
  return root.optional("solver") || file.channel != Channel::light || file.symmetry != optim::Symmetry::none;
}

/// Limits the offset to the largest at which a made hinge fits on its wall. @throws InvalidInput for a larger offset_mm
void limit_offset(const targets::Section& root, DisplayFile& file) {
  if (!file.hinge.made) return;
  const double most_mm = largest_offset_mm(*file.hinge.made, file.size);
  file.offset = std::min(file.offset, most_mm / file.size.edge_mm);
  const auto node = root.section("variables").optional("offset_mm");
  std::optional<double> required_mm;
  root.section("variables").read_length("offset_mm", required_mm, file.size.edge_mm);
  if (required_mm && *required_mm > most_mm * (1 + 1e-9))  // rounding of a file's digits
    throw node->error(offset_limit_text(*file.hinge.made, file.size));
}

/// Reads offset_mm and stretch_mm. It runs before the keys whose defaults depend on the offset.
void read_offset(const targets::Section& root, DisplayFile& file) {
  std::optional<double> offset_mm;
  root.section("variables").read_length("offset_mm", offset_mm, file.size.edge_mm);
  limit_offset(root, file);
  if (offset_mm)
    file.offset = *offset_mm / file.size.edge_mm;
  else if (requests_walls(root, file))
    file.offset = 0;
  std::optional<double> stretch_mm;
  root.section("variables").read_length("stretch_mm", stretch_mm, file.size.edge_mm);
  if (stretch_mm) file.strain = *stretch_mm / file.size.edge_mm;
  if (file.offset > 0) return;
  if (stretch_mm)
    throw root.section("variables")
        .optional("stretch_mm")
        ->key_error(
            "has no effect if variables.offset_mm is 0. Remove the key, or set tolerance.stretch "
            "instead");
  if (file.lattice.lattice)
    throw root.section("structure")
        .optional("lattice")
        ->error(
            "hinges on their walls show pictures only on squares. Set variables.offset_mm above 0 and remove "
            "`solver`, or remove `lattice`");
  if (!under(root, "target", "channel")) file.channel = channel_on_walls;
  file.t = t_on_walls;
}

void read_goal(const targets::Section& root, DisplayFile& file) {
  const targets::Section structure = root.section("structure");
  file.lattice = read_lattice_choice(structure, true);
  file.goal =
      read_display(root.required("target", ""), structure.optional("cells"), file.lattice.cell_shape());
  file.size = read_size(structure, display_cell_mm);
  file.hinge = read_elastic_hinge_section(root, file.size);
  file.process = read_process(root);
  root.section("target").read("channel", file.channel, channels);
  file.symmetry = read_symmetry(t_section(root), file.goal.columns, file.goal.rows);
  read_offset(root, file);
}

/// Rejects settings that need plates, for a driven hinge.
void reject_plate_options(const targets::Section& root, const targets::Section& drive,
                          const DisplayFile& file) {
  const targets::Section variables = root.section("variables");
  for (const char* key : {"compression", "axis", "stretch_mm"})
    if (const auto node = variables.optional(key))
      throw node->key_error(
          "only applies to plates, and the drive is a hinge, which turns to drive.angle_deg. Remove the key, "
          "or "
          "give `drive: {kind: plates}`");
  if (!(file.offset > 0))
    throw drive.optional("kind")->error(
        "hinges on their walls have to stretch, which needs plates. Set variables.offset_mm above 0 and "
        "remove "
        "`solver`, or give `kind: plates`");
}

void read_driven_hinge(const targets::Section& root, const targets::Section& drive, DisplayFile& file) {
  reject_plate_options(root, drive, file);
  if (const auto wall = drive.optional("wall"))
    file.driven_hinge = WallReader(make_panel(file, {file.goal.columns, file.goal.rows})).hinge_of(*wall);
}

void read_drive(const targets::Section& root, DisplayFile& file) {
  const targets::Section section = root.section("drive");
  section.read("kind", file.by_hinge, drives);
  if (section.given())
    check_keys(section.node(), display_drive_keys().only(file.by_hinge ? "hinge" : "plates"));
  section.read("axis", file.axes.front(), axes);
  section.read("push_only", file.press);
  section.read_into(file);
  if (file.by_hinge) read_driven_hinge(root, section, file);
}

/// Checks that t ranges on both sides of 0.5 with a symmetry. A symmetry maps a wall to another one with the ends
/// exchanged, which has its hinge at 1 - t, or to itself, which puts the hinge in the middle.
void check_tied_t(const targets::Section& t, const DisplayFile& file) {
  if (file.symmetry == optim::Symmetry::none || (file.t[0] < 0.5 && file.t[1] > 0.5)) return;
  throw t.optional("range")->error(
      "the range does not contain 0.5, and a symmetry puts hinges in the middle of walls. Give a range "
      "around "
      "0.5");
}

/// Checks t and symmetry for panels with offsets. All walls of the panel share one scaling, so no part is mirrored and
/// hinges are on both sides of the middle.
void check_scaled_t(const targets::Section& t, const DisplayFile& file) {
  if (!(file.offset > 0)) return;
  const auto range = t.optional("range");
  if (!(file.t[0] < 0.5 && file.t[1] > 0.5))
    throw range->error(
        "the range does not contain 0.5, which offsets of hinges need. Give a range around 0.5, or set "
        "variables.offset_mm: 0");
  if (file.symmetry != optim::Symmetry::none)
    throw t.optional("symmetry")
        ->error(
            "a symmetry only applies to hinges on their walls. Remove the key, or set variables.offset_mm: "
            "0");
}

void read_t(const targets::Section& t, DisplayFile& file) {
  t.read_into(file);
  std::optional<double> corner_mm;
  t.read_length("corner_mm", corner_mm, file.size.edge_mm);
  if (corner_mm) {
    const double least = *corner_mm / file.size.edge_mm;
    file.t = {std::max(file.t[0], least), std::min(file.t[1], 1 - least)};
    if (!(file.t[0] < file.t[1]))
      throw t.optional("corner_mm")
          ->error(
              "no position is left within variables.hinge_position.range. Give a smaller corner_mm, or a "
              "wider range");
  }
  check_scaled_t(t, file);
  check_tied_t(t, file);
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
        fmt::format("{:g} is outside variables.compression.range, which is [{:g}, {:g}]. Give a start within "
                    "the range",
                    file.compression, range[0], range[1]));
  file.compression = start;
}

void read_axes(const targets::Section& root, const targets::Node& list, DisplayFile& file) {
  if (under(root, "drive", "axis"))
    throw list.error(
        "cannot be combined with drive.axis, which sets the direction. Remove one of the two keys");
  file.axes.clear();
  for (const targets::Node& node : list.list("x, y or both, such as [x, y]")) {
    const Axis axis = read_word(node, axes);
    if (std::find(file.axes.begin(), file.axes.end(), axis) != file.axes.end())
      throw node.error("the direction is listed twice. Remove one entry");
    file.axes.push_back(axis);
  }
  if (file.axes.empty()) throw list.error("the list has no direction. Give x, y or both, such as [x, y]");
}

void read_variables(const targets::Section& root, DisplayFile& file) {
  const targets::Section section = root.section("variables");
  read_t(t_section(root), file);
  read_compression(root, section.section("compression"), file);
  if (const auto node = section.optional("axis")) read_axes(root, *node, file);
}

void read_limits(const targets::Section& section, DisplayFile& file) {
  file.limits = read_hinge_limits(section, file.hinge);
  if (const auto& made = file.hinge.made; made && !is_pin(made->kind) && !file.limits.strain)
    file.limits.strain = made->material.strain_max;
  if (const auto force = section.optional("force_N"); force && file.by_hinge)
    throw force->key_error(
        "applies to plates only, and a driven hinge has a moment instead. Remove the key, or give `drive: "
        "{kind: plates}`");
}

void read_tolerance(const targets::Section& root, DisplayFile& file) {
  const targets::Section section = root.section("tolerance");
  if (const auto contrast = section.optional("contrast"); contrast && !file.goal.is_binary())
    throw contrast->key_error(
        "only applies to pictures with two levels. Remove the key: tolerance.auc limits the error of greys");
  section.read_into(file);
  read_limits(section, file);
}

void check_search(const targets::Section& root, const DisplayFile& file) {
  if (const auto solver = root.optional("solver"); solver && file.offset > 0)
    throw solver->key_error(
        "has no effect here: with variables.offset_mm above 0 the problem is convex. Remove `solver`, or set "
        "variables.offset_mm: 0");
  if (!file.solver.name) return;
  if (std::find(fitting_solvers.begin(), fitting_solvers.end(), *file.solver.name) == fitting_solvers.end())
    throw under(root, "solver", "name")
        ->error("`" + to_string(*file.solver.name) +
                "` does not use gradients of a single cost. Give mma, ccsa or slsqp");
}

}  // namespace

double turn_of_compression(double compression) { return 2 * std::acos(1 - compression); }

const targets::KeyTable& display_keys() {
  static const optim::DisplayOptions search{};
  static const targets::KeyTable keys = goal_keys(
      {
          {"target", targets::display_target_keys(), "the goal", targets::needed},
          {"structure", display_structure_keys(), "flat panel"},
          {"variables", display_variables_keys(), "quantities that the search changes, with their ranges"},
          {"drive", display_drive_keys(), "actuation that compresses the panel"},
          {"hinge", elastic_hinge_keys(), any_hinge},
          {"tolerance", display_tolerance_keys(), "limits for a met goal"},
          {"solver",
           solver_keys(fitting_solvers, search.starts, search.solver.max_evaluations,
                       "per stage of a search"),
           "solver of the search. Starts are counted per direction"},
      },
      {});
  return keys;
}

DisplayFile read_display_file(const targets::Node& node) {
  const targets::Section root = read_root(node, display_keys());
  DisplayFile file;
  read_goal(root, file);
  read_drive(root, file);
  read_variables(root, file);
  read_tolerance(root, file);
  read_settings(root, file.size.edge_mm, file);
  check_search(root, file);
  return file;
}

}  // namespace kinetix::app
