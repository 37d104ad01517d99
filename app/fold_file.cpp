#include "app/fold_file.hpp"

#include "app/file_header.hpp"
#include "app/structure_section.hpp"
#include "app/variables_section.hpp"
#include "targets/read_fold.hpp"

namespace kinetix {
namespace {

constexpr double default_cell_mm = 10;

void read_structure(const Node& root, FoldFile& file) {
  const auto structure = root.optional("structure");
  if (structure) {
    if (const auto cells = structure->optional("cells"))
      throw cells->key_error(
          "the cells of a fold follow from its faces; give them in target.box or target.net");
    structure->reject_unknown_keys({"cell_mm", "wall_mm"});
  }
  file.size = read_size(structure, default_cell_mm);
}

void read_tolerance(const Node& root, FoldFile& file) {
  const auto section = root.optional("tolerance");
  if (!section) return;
  section->reject_unknown_keys({"angle_deg", "shape", "verify"});
  const Bounds part_of_one = {0, 1, false, true};
  if (const auto node = section->optional("angle_deg"))
    file.angle_tolerance = node->angle({0, 90, false, true, "degrees"});
  if (const auto node = section->optional("shape")) file.shape_tolerance = node->number(part_of_one);
  if (const auto node = section->optional("verify")) file.verify_tolerance = node->number(part_of_one);
}

}  // namespace

FoldFile read_fold_file(const Node& root) {
  root.reject_unknown_keys({"kinetix", "name", "target", "structure", "variables", "tolerance", "physics"});
  check_version(root);
  FoldFile file;
  file.name = read_name(root);
  file.goal = read_fold(root.required("target", ""));
  read_structure(root, file);
  const NetVariables variables = read_net_variables(root, file.size, {file.tilt, file.theta});
  file.tilt = variables.tilt;
  file.theta = variables.theta;
  read_tolerance(root, file);
  file.physics = read_physics(root, file.size.edge_mm);
  return file;
}

}  // namespace kinetix
