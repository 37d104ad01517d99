#include "app/design_file.hpp"

#include <vector>

#include "app/file_header.hpp"
#include "app/structure_section.hpp"
#include "app/wall_node.hpp"
#include "model/cell_tuple.hpp"

namespace kinetix {
namespace {

const Bounds fraction = between(0, 1);
const Bounds in_plane = between(0, 180, "degrees");
const Bounds tilt = between(-90, 90, "degrees");

constexpr double default_cell_mm = 10;

void check_kind_of_file(const Node& root) {
  if (root.kind() == Node::Kind::map && !root.optional("design") && root.optional("target"))
    throw root.error("this is a target, not a design; search it first with `kinetix-opt TARGET.yaml`");
  root.reject_unknown_keys({"kinetix", "name", "structure", "design", "drive", "hinge", "physics"});
}

Structure read_structure(const Node& root) {
  const Node section = root.required("structure", "e.g. `structure: {cells: [6, 1], cell_mm: 10}`");
  section.reject_unknown_keys({"cells", "cell_mm", "wall_mm"});
  const Node cells = section.required("cells", "[columns, rows], or a list of cells [[i, j], ...]");
  const CellSize size = read_size(section, default_cell_mm);
  return cells.located([&] { return make_structure(read_cells(cells), size); });
}

std::array<double, 4> read_four(const Node& tuple, const char* key, const std::array<double, 4>& fallback,
                                const auto& read_value) {
  const auto node = tuple.optional(key);
  if (!node) return fallback;
  const auto entries = node->list_of(4, "four values: bottom, right, top, left");
  return {read_value(entries[0]), read_value(entries[1]), read_value(entries[2]), read_value(entries[3])};
}

CellTuple read_tuple(const Node& pattern, const char* key) {
  CellTuple tuple;
  const auto node = pattern.optional(key);
  if (!node) return tuple;
  node->reject_unknown_keys({"P", "A_in_deg", "A_out_deg"});
  tuple.P = read_four(*node, "P", tuple.P, [](const Node& n) { return n.number(fraction); });
  tuple.A_in = read_four(*node, "A_in_deg", tuple.A_in, [](const Node& n) { return n.angle(in_plane); });
  tuple.A_out = read_four(*node, "A_out_deg", tuple.A_out, [](const Node& n) { return n.angle(tilt); });
  return tuple;
}

void read_pattern(const Node& design, Structure& structure) {
  const auto pattern = design.optional("pattern");
  if (!pattern) return;
  pattern->reject_unknown_keys({"even", "odd", "shared"});
  const CellTuple even = read_tuple(*pattern, "even"), odd = read_tuple(*pattern, "odd");
  SharedWalls shared = SharedWalls::must_agree;
  if (const auto node = pattern->optional("shared"))
    shared = node->choice<SharedWalls>(
        {{"average", SharedWalls::average}, {"must_agree", SharedWalls::must_agree}});
  pattern->located([&] { apply_pattern(structure, even, odd, shared); });
}

void read_parameters(const Node& node, HingeParameters& p) {
  p = {};
  if (const auto t = node.optional("t")) p.t = t->number(fraction);
  if (const auto alpha = node.optional("alpha_deg")) p.alpha = alpha->angle(in_plane);
  if (const auto beta = node.optional("beta_deg")) p.beta = beta->angle(tilt);
}

void read_hinges(const Node& design, Structure& structure) {
  const auto list = design.optional("hinges");
  if (!list) return;
  std::vector<int> line_of(structure.hinges.size(), 0);
  for (const Node& node : list->list("a list of hinges, e.g. `- {wall: [[0, 0], [1, 0]], beta_deg: 30}`")) {
    node.reject_unknown_keys({"wall", "t", "alpha_deg", "beta_deg"});
    const int k = read_hinge_index(node, structure);
    if (line_of[k] > 0)
      throw node.error("the wall " + to_string(structure.hinges[k].wall) + " is named twice, first in line " +
                       std::to_string(line_of[k]) + "; name it once");
    line_of[k] = node.place().line;
    read_parameters(node, structure.hinges[k].parameters);
  }
}

double read_state(const Node& root, Structure& structure) {
  const auto design = root.optional("design");
  if (!design) return 0;
  design->reject_unknown_keys({"theta_deg", "pattern", "hinges"});
  read_pattern(*design, structure);
  read_hinges(*design, structure);
  const auto theta = design->optional("theta_deg");
  return theta ? theta->angle(tilt) : 0;
}

}  // namespace

DesignFile read_design(const std::string& path) { return read_design(read_document(path, max_design_bytes)); }

DesignFile read_design(const Node& root) {
  check_kind_of_file(root);
  check_version(root);
  DesignFile file{.name = read_name(root), .structure = read_structure(root)};
  file.theta = read_state(root, file.structure);
  file.drive = read_drive_section(root, file.structure);
  file.side = read_side(root);
  file.hinge = read_hinge_section(root, file.structure.size.edge_mm);
  file.physics = read_physics(root, file.structure.size.edge_mm);
  return file;
}

}  // namespace kinetix
