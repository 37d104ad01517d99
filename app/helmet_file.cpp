#include "app/helmet_file.hpp"

#include <algorithm>
#include <cmath>

#include "app/file_header.hpp"
#include "app/structure_section.hpp"
#include "app/variables_section.hpp"
#include "model/wall_contact.hpp"
#include "targets/read_head.hpp"

namespace kinetix {
namespace {

constexpr double default_cell_mm = 6;
constexpr int most_ribs = 200;
constexpr double least_cell_mm = 1;
constexpr double most_cell_mm = 60;

void read_structure(const Node& root, HelmetFile& file) {
  const auto structure = root.optional("structure");
  if (structure) {
    if (const auto cells = structure->optional("cells"))
      throw cells->key_error("the cells of a helmet follow from the head, target.ribs and structure.cell_mm");
    structure->reject_unknown_keys({"cell_mm", "wall_mm"});
    if (const auto cell = structure->optional("cell_mm"))
      cell->number(from_to(least_cell_mm, most_cell_mm, "mm"));
  }
  file.wish.size = read_size(structure, default_cell_mm);
}

void read_ribs(const Node& target, HelmetFile& file) {
  const auto ribs = target.optional("ribs"), spacing = target.optional("spacing_mm");
  if (ribs && spacing) throw spacing->key_error("and target.ribs say the same thing; give one of them");
  if (ribs) file.wish.ribs = ribs->integer(1, most_ribs);
  if (spacing) {
    file.wish.spacing_mm = spacing->number(from_to(least_cell_mm, 1000, "mm"));
    if (*file.wish.spacing_mm < 2 * file.wish.size.edge_mm * std::cos(file.wish.start_theta))
      throw spacing->error("ribs so close overlap flat: leave two cells at least, which are " +
                           shortest_text(2 * file.wish.size.edge_mm) + " mm flat");
  }
  if (const auto node = target.optional("clearance_mm"))
    file.wish.clearance_mm = node->number(from_to(0, 100, "mm"));
  file.wish.coverage_mm = file.head.coverage_mm;
}

void read_variables(const Node& root, HelmetWish& wish) {
  const NetVariables read = read_net_variables(root, wish.size, {wish.tilt, wish.theta});
  wish.tilt = read.tilt;
  wish.theta = {read.theta.lower, std::min(read.theta.upper, closing_theta(wish.size))};
  wish.start_theta = std::clamp(wish.start_theta, wish.theta.lower, wish.theta.upper);
}

void read_tolerance(const Node& root, HelmetFile& file) {
  const auto section = root.optional("tolerance");
  if (!section) return;
  section->reject_unknown_keys({"rms_mm", "max_mm", "verify"});
  if (const auto node = section->optional("rms_mm")) file.rms_mm = node->number(above(0, "mm"));
  if (const auto node = section->optional("max_mm")) file.max_mm = node->number(above(0, "mm"));
  if (const auto node = section->optional("verify")) file.verify = node->number({0, 1, false, true});
}

}  // namespace

HelmetFile read_helmet_file(const Node& root) {
  root.reject_unknown_keys(
      {"kinetix", "name", "target", "structure", "variables", "tolerance", "solver", "physics"});
  check_version(root);
  const std::string name = read_name(root);
  const Node target = root.required("target", "");
  target.reject_unknown_keys(
      {"kind", "mesh", "units", "up", "front", "crown", "ribs", "spacing_mm", "coverage_mm", "clearance_mm"});
  HelmetFile file{.name = name, .head = read_head(target)};
  read_structure(root, file);
  read_variables(root, file.wish);
  read_ribs(target, file);
  read_tolerance(root, file);
  file.solver = read_solver(root);
  if (file.solver.name && *file.solver.name != SolverName::ceres)
    throw root.optional("solver")->optional("name")->error(
        "a helmet's hundreds of tilts need second-order steps; "
        "allowed: ceres");
  file.physics = read_physics(root, file.wish.size.edge_mm);
  return file;
}

}  // namespace kinetix
