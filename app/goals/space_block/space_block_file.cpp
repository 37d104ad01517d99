#include "app/goals/space_block/space_block_file.hpp"

#include <fmt/format.h>

#include "app/files/file_header.hpp"
#include "app/files/structure_section.hpp"
#include "targets/document/bound_key.hpp"
#include "targets/space_block/read_space_block.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;

constexpr int most_block_cells = 10;     // cells per direction: a block of 10 x 10 x 10 has 40 000 bodies
constexpr int most_block_bodies = 6000;  // bodies of 5 x 5 x 5 cells, whose simulation takes minutes
constexpr int bodies_per_cell = 36;      // 12 rotors and 24 gussets per inner cell; sides have a few more
// Theta, degrees: at 45 rotors have turned by a right angle.
const targets::Bounds block_turns = targets::between(0, 45, "degrees");
const targets::Bounds gusset_lengths = targets::from_to(0.02, 0.9);

targets::KeyTable block_variables_keys() {
  using Variables = optim::SpaceBlockVariables;
  const targets::KeyTable theta(
      {{"range_deg", &Variables::theta, value::angle_range(block_turns), "half of the turn of the rotors"}});
  const targets::KeyTable gusset(
      {{"range", &Variables::gusset, value::range(gusset_lengths),
        "lengths of gussets, the pieces between two rotors that never turn, over the edge; the shortest are "
        "0.2, or as near to it as theta keeps its range"}});
  return targets::KeyTable(
      {{"theta", theta, "how far rotors turn"}, {"gusset", gusset, "how long gussets may be"}});
}

void read_block_structure(const targets::Section& root, SpaceBlockFile& file) {
  const targets::Section structure = root.section("structure");
  if (const auto cells = structure.optional("cells")) {
    const auto sides = cells->list_of(3, "[x, y, z]");
    file.variables.cells = {sides[0].integer(1, most_block_cells), sides[1].integer(1, most_block_cells),
                            sides[2].integer(1, most_block_cells)};
  }
  structure.read("cell_mm", file.variables.edge_mm);
  root.read_into(file.walls);
}

void read_block_tolerance(const targets::Section& root, SpaceBlockFile& file) {
  root.read_into(file);
  const auto size = root.section("tolerance").optional("size");
  if (size && !file.goal.size_mm)
    throw size->key_error("is of `target.size_mm`, which is not given; leave it out");
}

void check_factor(const targets::Section& target, const SpaceBlockFile& file) {
  const std::string why = obstacle(file.goal, file.variables);
  if (!why.empty()) throw target.optional("factor")->error(why);
}

void check_bodies(const targets::Section& target, const SpaceBlockFile& file) {
  const auto& cells = file.found.cells;
  const double bodies = static_cast<double>(bodies_per_cell) * cells[0] * cells[1] * cells[2];
  if (bodies <= most_block_bodies) return;
  throw target.error(
      fmt::format("{} x {} x {} cells have some {:.0f} bodies; at most {} are searched for: give "
                  "larger cells",
                  cells[0], cells[1], cells[2], bodies, most_block_bodies));
}

}  // namespace

const targets::KeyTable& space_block_keys() {
  static const targets::KeyTable keys = goal_keys(
      {
          {"target", targets::space_block_target_keys(), "the goal", targets::needed},
          {"structure",
           targets::KeyTable({
               {"cells", value::list(value::integer(1, most_block_cells), "`[x, y, z]`", 3, 3),
                targets::otherwise("[2, 2, 2], or as `target.size_mm` asks"),
                "cubic cells of the sodalite net, each 2.83 edges long"},
               cell_mm_key(targets::otherwise("20, or as `target.size_mm` asks")),
               thin_walls_key("edges", "the walls, from each rotor to the middle of a gusset"),
           }),
           "the lattice"},
          {"variables", block_variables_keys(), "how far the search may go"},
          {"tolerance",
           targets::KeyTable({
               {"factor", &SpaceBlockFile::factor_tolerance, value::number(targets::part_of_one),
                "most that the factor of a direction may differ from `target.factor`"},
               {"size", &SpaceBlockFile::size_tolerance, value::number(targets::part_of_one),
                "most that a length at rest may differ from `target.size_mm`, over it"},
               verify_key(),
           }),
           "when the goal is met"},
      },
      {});
  return keys;
}

SpaceBlockFile read_space_block_file(const targets::Node& node) {
  const targets::Section root = read_root(node, space_block_keys());
  SpaceBlockFile file;
  const targets::Section target = root.section("target");
  file.goal = targets::read_space_block(target);
  read_block_structure(root, file);
  root.read_into(file.variables);
  read_block_tolerance(root, file);
  check_factor(target, file);
  file.found = fit_space_block(file.goal, file.variables, file.size_tolerance);
  check_bodies(target, file);
  read_settings(root, file.found.edge_mm, file);
  return file;
}

}  // namespace kinetix::app
