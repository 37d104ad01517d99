#include "app/goals/space_block/space_block_file.hpp"

#include <fmt/format.h>

#include "app/files/file_header.hpp"
#include "app/files/structure_section.hpp"
#include "targets/space_block/read_space_block.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;

constexpr int most_block_cells = 10;     // along a direction: a block of 10 x 10 x 10 has 40 000 bodies
constexpr int most_block_bodies = 6000;  // those of 5 x 5 x 5 cells, whose physics run takes minutes
constexpr int bodies_a_cell =
    36;  // inside: 12 rotors and 24 gussets; blocks have some at their sides besides
// Of an edge: with these, walls pass each other until rotors have turned by a right angle.
constexpr double usual_block_thickness = 0.08, usual_block_height = 0.15;
// Of theta, degrees: at 45 rotors have turned by a right angle.
const targets::Bounds block_turns = targets::between(0, 45, "degrees");
const targets::Bounds gusset_lengths = targets::from_to(0.02, 0.9);

targets::KeyTable block_structure_keys() {
  return targets::KeyTable({
      {"cells", value::list(value::integer(1, most_block_cells), "`[x, y, z]`", 3, 3),
       targets::otherwise("[2, 2, 2], or as `target.size_mm` asks"),
       "cubic cells of the sodalite net, each 2.83 edges long"},
      cell_mm_key(targets::otherwise("20, or as `target.size_mm` asks")),
      {"wall_mm",
       value::map(targets::KeyTable({
           {"thickness", value::number(targets::above(0, "mm")), targets::otherwise("0.08 edges"),
            "of the walls"},
           {"height", value::number(targets::above(0, "mm")), targets::otherwise("0.15 edges"),
            "of the walls"},
       })),
       {},
       "the walls, from each rotor to the middle of a gusset"},
  });
}

targets::KeyTable block_variables_keys(const SpaceBlockFile& usual) {
  const optim::SpaceBlockVariables& v = usual.variables;
  const targets::KeyTable theta(
      {{"range_deg", value::angle_range(block_turns), targets::by_default_deg(v.theta.lower, v.theta.upper),
        "half of the turn of the rotors"}});
  const targets::KeyTable gusset(
      {{"range", value::range(gusset_lengths), targets::by_default(v.gusset),
        "lengths of gussets, the pieces between two rotors that never turn, over the edge; the shortest are "
        "0.2, or as near to it as theta keeps its range"}});
  return targets::KeyTable({{"theta", value::map(theta), {}, "how far rotors turn"},
                            {"gusset", value::map(gusset), {}, "how long gussets may be"}});
}

targets::KeyTable block_tolerance_keys(const SpaceBlockFile& usual) {
  return targets::KeyTable({
      {"factor", value::number(targets::part_of_one), targets::by_default(usual.factor_tolerance),
       "most that the factor of a direction may differ from `target.factor`"},
      {"size", value::number(targets::part_of_one), targets::by_default(usual.size_tolerance),
       "most that a length at rest may differ from `target.size_mm`, over it"},
      {"verify", value::number(targets::part_of_one), targets::by_default(usual.verify_tolerance),
       "most of [verify_rms](#verify_rms-and-verify_max), cell edges"},
  });
}

void read_block_structure(const targets::Section& root, SpaceBlockFile& file) {
  const targets::Section structure = root.section("structure");
  if (const auto cells = structure.optional("cells")) {
    const auto sides = cells->list_of(3, "[x, y, z]");
    file.variables.cells = {sides[0].integer(1, most_block_cells), sides[1].integer(1, most_block_cells),
                            sides[2].integer(1, most_block_cells)};
  }
  structure.read("cell_mm", file.variables.edge_mm);
  const targets::Section wall = structure.section("wall_mm");
  wall.read("thickness", file.thickness_mm);
  wall.read("height", file.height_mm);
}

void read_block_variables(const targets::Section& root, SpaceBlockFile& file) {
  const targets::Section variables = root.section("variables");
  std::array<double, 2> theta = {file.variables.theta.lower, file.variables.theta.upper};
  variables.section("theta").read("range_deg", theta);
  file.variables.theta = {theta[0], theta[1]};
  variables.section("gusset").read("range", file.variables.gusset);
}

void read_block_tolerance(const targets::Section& root, SpaceBlockFile& file) {
  const targets::Section tolerance = root.section("tolerance");
  tolerance.read("factor", file.factor_tolerance);
  tolerance.read("size", file.size_tolerance);
  tolerance.read("verify", file.verify_tolerance);
  if (const auto size = tolerance.optional("size"); size && !file.goal.size_mm)
    throw size->key_error("is of `target.size_mm`, which is not given; leave it out");
}

void check_factor(const targets::Section& target, const SpaceBlockFile& file) {
  const std::string why = obstacle(file.goal, file.variables);
  if (!why.empty()) throw target.optional("factor")->error(why);
}

void check_bodies(const targets::Section& target, const SpaceBlockFile& file) {
  const auto& cells = file.found.cells;
  const double bodies = static_cast<double>(bodies_a_cell) * cells[0] * cells[1] * cells[2];
  if (bodies <= most_block_bodies) return;
  throw target.error(
      fmt::format("{} x {} x {} cells have some {:.0f} bodies; at most {} are searched for: give "
                  "larger cells",
                  cells[0], cells[1], cells[2], bodies, most_block_bodies));
}

}  // namespace

model::CellSize SpaceBlockFile::size() const {
  return {found.edge_mm, thickness_mm.value_or(usual_block_thickness * found.edge_mm),
          height_mm.value_or(usual_block_height * found.edge_mm)};
}

const targets::KeyTable& space_block_keys() {
  static const SpaceBlockFile usual;
  static const targets::KeyTable keys = file_keys({
      {"target", value::map(targets::space_block_target_keys()), targets::needed, "the goal"},
      {"structure", value::map(block_structure_keys()), {}, "the lattice"},
      {"variables", value::map(block_variables_keys(usual)), {}, "how far the search may go"},
      {"tolerance", value::map(block_tolerance_keys(usual)), {}, "when the goal is met"},
      {"physics", value::map(physics_keys()), {}, "settings of the physics run"},
      process_key(),
  });
  return keys;
}

SpaceBlockFile read_space_block_file(const targets::Node& node) {
  const targets::Section root(node, space_block_keys());
  check_version(root);
  SpaceBlockFile file;
  file.name = read_name(root);
  const targets::Section target = root.section("target");
  file.goal = targets::read_space_block(target);
  read_block_structure(root, file);
  read_block_variables(root, file);
  read_block_tolerance(root, file);
  check_factor(target, file);
  file.found = fit_space_block(file.goal, file.variables, file.size_tolerance);
  check_bodies(target, file);
  file.process = read_process(root);
  file.physics = read_physics(root, file.found.edge_mm);
  return file;
}

}  // namespace kinetix::app
