#include "app/goals/outline/outline_file.hpp"

#include "app/files/file_header.hpp"
#include "app/files/process_section.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;

// Cell edges: a living hinge at the face of a wall that is a sixth of the edge thick.
constexpr double default_offset = 0.08;
// Cells: a search takes about a second for a thousand cells and a minute for this number.
constexpr int most_cells = 10'000;
// Values of the key `trim`.
constexpr targets::Word<bool> trims[] = {{"outline", true}, {"none", false}};
// Offset of a hinge, cell edges: half a wall to either side.
const targets::Bounds offset = {0, 0.5, true, false, "mm (below half of cell_mm)"};
// Theta, degrees: at 45 basic cells are closed.
const targets::Bounds fold_range = targets::between(0, 45, "degrees");

targets::KeyTable outline_structure_keys(const OutlineFile& usual) {
  std::vector<targets::Key> keys = lattice_choice_keys(true);
  keys.insert(
      keys.begin() + 1,
      cells_key(targets::by_default({static_cast<double>(usual.columns), static_cast<double>(usual.rows)}),
                "[columns, rows] of the panel, or of the rectangle that it is cut from"));
  keys.push_back(
      {"trim", value::choice(trims), targets::otherwise("`none` with `target.flat`, else `outline`"),
       "`outline`: the flat panel is cut to the shape of the outline. `none`: a whole rectangle of cells"});
  keys.push_back(cell_mm_key(
      targets::otherwise("gives the pressed panel the size of the outline. If the key is given, the "
                         "outline is scaled to the panel")));
  keys.push_back(wall_mm_key());
  return targets::KeyTable(std::move(keys));
}

targets::KeyTable outline_variables_keys() {
  const targets::KeyTable t(
      {{"range", &OutlineFile::t, value::range(targets::place_along),
        "allowed positions of hinges along their walls. The end nearer to 0.5 limits both sides"}});
  const targets::KeyTable theta(
      {{"range_deg", &OutlineFile::theta, value::angle_range(fold_range),
        "fold angle of the pressed state. The search tries several within the range"}});
  return targets::KeyTable({
      {"offset_mm", &OutlineFile::offset_mm, value::length(offset), targets::otherwise("0.08 of `cell_mm`"),
       "largest lateral offset of a hinge, to either side"},
      targets::Key("hinge_position", t, "positions of the hinges along their walls").formerly("t"),
      targets::Key("fold_angle", theta, "fold angle of the pressed panel").formerly("theta"),
  });
}

void read_cells_of(const targets::Section& structure, OutlineFile& file) {
  const auto node = structure.optional("cells");
  file.trims = !file.flat;
  structure.read("trim", file.trims, trims);
  if (!node) return;
  const auto sides = as_rectangle(read_cells(*node));
  if (!sides)
    throw node->error("the cells do not fill a rectangle, which an outline needs. Give [columns, rows]");
  if ((*sides)[0] * (*sides)[1] > most_cells)
    throw node->error("there are too many cells for a search. Give at most 10000");
  file.columns = (*sides)[0];
  file.rows = (*sides)[1];
}

void read_structure(const targets::Section& root, OutlineFile& file) {
  const targets::Section structure = root.section("structure");
  file.lattice = read_lattice_choice(structure, true);
  read_cells_of(structure, file);
  structure.read("cell_mm", file.cell_mm);
  const targets::Section wall = structure.section("wall_mm");
  wall.read_length("thickness", file.thickness_mm, file.cell_mm.value_or(file.folded.diagonal()));
  wall.read("height", file.height_mm);
  if (file.flat && file.trims)
    throw root.section("structure")
        .error(
            "`trim: outline` cannot be combined with `target.flat`, which sets the flat outline. Remove one "
            "of the two keys");
}

void read_variables(const targets::Section& root, OutlineFile& file) {
  root.read_into(file, file.cell_mm.value_or(file.folded.diagonal()));
  if (!(file.t[0] < 0.5 && file.t[1] > 0.5))
    throw root.section("variables")
        .section("hinge_position")
        .optional("range")
        ->error("the range does not contain 0.5, where hinges start. Give a range around 0.5");
}

/// Limits the offset to the largest at which a made hinge fits on its wall. @throws InvalidInput for a larger offset_mm
void limit_outline_offset(const targets::Section& root, OutlineFile& file) {
  if (!file.hinge.made || !file.cell_mm) return;
  const model::CellSize size = file.size(*file.cell_mm);
  const double most_mm = largest_offset_mm(*file.hinge.made, size);
  if (const auto asked = root.section("variables").optional("offset_mm");
      asked && *file.offset_mm > most_mm * (1 + 1e-9))
    throw asked->error(offset_limit_text(*file.hinge.made, size));
  file.offset_mm = std::min(file.offset(*file.cell_mm) * *file.cell_mm, most_mm);
}

}  // namespace

model::CellSize OutlineFile::size(double edge_mm) const {
  model::CellSize size = default_size(edge_mm);
  size.thickness_mm = thickness_mm.value_or(size.thickness_mm);
  size.height_mm = height_mm.value_or(size.height_mm);
  return size;
}

double OutlineFile::offset(double edge_mm) const { return offset_mm ? *offset_mm / edge_mm : default_offset; }

const targets::KeyTable& outline_keys() {
  static const OutlineFile usual;
  static const targets::KeyTable keys = goal_keys(
      {
          {"target", targets::outline_target_keys(), "the goal", targets::needed},
          {"structure", outline_structure_keys(usual), "flat panel"},
          {"variables", outline_variables_keys(), "quantities that the search changes, with their ranges"},
          {"tolerance",
           targets::KeyTable({
               {"shape", &OutlineFile::shape_tolerance, value::number(targets::part_of_one),
                "limit of [outline_rms](#outline_rms-and-iou), relative to the diagonal of the outline's "
                "bounding box"},
               {"iou", &OutlineFile::iou_tolerance, value::number(targets::part_of_one),
                "minimum of [iou](#outline_rms-and-iou)"},
               verify_key(),
           }),
           "limits for a met goal"},
      },
      sized_hinge);
  return keys;
}

OutlineFile read_outline_file(const targets::Node& node) {
  const targets::Section root = read_root(node, outline_keys());
  const targets::Section target = root.section("target");
  OutlineFile file;
  target.required("points", "the path of a file or a list of points [[x, y], ...] in mm");
  const bool checks_size = !root.section("structure").optional("cell_mm");
  file.folded = targets::read_outline(target, "points", checks_size, file.input_notes);
  if (target.optional("flat"))
    file.flat = targets::read_outline(target, "flat", checks_size, file.input_notes);
  read_structure(root, file);
  read_variables(root, file);
  read_settings(root, file.cell_mm.value_or(file.folded.diagonal() / file.columns), file);
  read_hinges(root, file.cell_mm ? std::optional(file.size(*file.cell_mm)) : std::nullopt, file);
  if (!file.hinge_parts.empty())
    throw root.section("hinge").optional("except")->key_error(
        "the hinges of a panel are upright, so it has no creases. Remove the key");
  limit_outline_offset(root, file);
  return file;
}

}  // namespace kinetix::app
