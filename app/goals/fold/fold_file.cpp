#include "app/goals/fold/fold_file.hpp"

#include "app/files/file_header.hpp"
#include "app/files/goal_settings.hpp"
#include "app/files/structure_section.hpp"
#include "targets/document/bound_key.hpp"
#include "targets/fold/read_fold.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;

constexpr double fold_cell_mm = 10;  // the default of a design; the folding of a net does not depend on it

targets::KeyTable fold_structure_keys() {
  return targets::KeyTable({cell_mm_key(targets::by_default(fold_cell_mm)), wall_mm_key()});
}

targets::KeyTable fold_tolerance_keys() {
  std::vector<targets::Key> keys = {
      {"angle_deg", &FoldFile::angle_tolerance, value::angle({0, 90, false, true, "degrees"}),
       "most that the fold of a crease may be off"},
      {"shape", &FoldFile::shape_tolerance, value::number(targets::part_of_one),
       "most of [face_rms](#face_rms), over the edge of a face"},
      {"size", &FoldFile::size_tolerance, value::number(targets::part_of_one),
       "most that an edge of the folded box may differ from `target.box_mm`, over its length"},
      verify_key(),
  };
  const auto limits = hinge_limit_keys("the net folds at a smaller theta where it has to");
  keys.insert(keys.end() - 1, limits.begin(), limits.end());
  return targets::KeyTable(std::move(keys));
}

void read_structure(const targets::Section& root, FoldFile& file) {
  const auto node = root.optional("structure");
  if (const auto cells = node ? node->optional("cells") : std::nullopt)
    throw cells->key_error(
        "the cells of a fold follow from its faces; give them in target.box or target.net");
  file.size = read_size(root.section("structure"), fold_cell_mm);
}

/// Returns a function that gives the walls for any cell edge: sizes from the file, and defaults from the edge.
std::function<model::CellSize(double)> walls_for(const targets::Section& structure,
                                                 const model::CellSize& given) {
  const targets::Section wall = structure.section("wall_mm");
  const bool has_thickness = wall.optional("thickness").has_value(),
             has_height = wall.optional("height").has_value();
  return [=](double edge_mm) {
    model::CellSize size = default_size(edge_mm);
    if (has_thickness) size.thickness_mm = given.thickness_mm;
    if (has_height) size.height_mm = given.height_mm;
    return size;
  };
}

/// Chooses the cells and their edge for a box of given size.
void choose_cells(const targets::Section& root, FoldFile& file) {
  const targets::Node target = root.required("target", "");
  const targets::Section structure = root.section("structure");
  optim::BoxOptions options;
  options.asked_mm = *file.goal.box_mm;
  options.open = file.goal.open;
  options.crease_columns = file.goal.nets.front().creases.front().columns;
  if (structure.optional("cell_mm")) options.edge_mm = file.size.edge_mm;
  options.fold.tilt = file.tilt;
  options.fold.theta = file.theta;
  options.size = [&](double edge_mm) { return read_size(structure, edge_mm); };
  const optim::BoxInCells box = target.located([&] { return fit_box(options); });
  file.size = options.size(box.edge_mm);
  file.goal = targets::box_goal(box.edges, options.open, options.crease_columns);
  file.goal.box_mm = options.asked_mm;
  file.box_folded_mm = box.folded_mm;
  options.size = walls_for(structure, file.size);
  file.box = std::move(options);
}

void check_force_limit(const targets::Node& force, const FoldFile& file) {
  if (file.hinge.model != HingeSection::Model::elastic)
    throw force.key_error("applies to elastic hinges; give `hinge` as well");
  if (file.drive) throw force.key_error("is for a drive from outside; springs in the hinges need none");
}

/// Rejects a strain limit without elastic hinges, because strain is known only in their equilibrium.
void check_strain_limit(const targets::Node& strain, const FoldFile& file) {
  if (file.hinge.model != HingeSection::Model::elastic)
    throw strain.key_error("applies to elastic hinges; leave out `model: rotary` of `hinge`");
}

void read_tolerance(const targets::Section& root, FoldFile& file) {
  const targets::Section section = root.section("tolerance");
  root.read_into(file);
  if (const auto size = section.optional("size"); size && !file.goal.box_mm)
    throw size->key_error("is of `target.box_mm`, which is not given; leave it out");
  file.limits = read_hinge_limits(section, file.hinge, file.hinge_parts);
  if (const auto force = section.optional("force_N")) check_force_limit(*force, file);
  if (const auto strain = section.optional("strain")) check_strain_limit(*strain, file);
}

targets::KeyTable keys_of(const FoldFile& usual) {
  return goal_keys(
      {
          {"target", targets::fold_target_keys(), "the goal", targets::needed},
          {"structure", fold_structure_keys(), "the flat net"},
          {"variables", net_variables_keys(usual.tilt, usual.theta),
           "what the search may change, and how far"},
          {"tolerance", fold_tolerance_keys(), "when the goal is met"},
      },
      any_hinge, {robust_key()});
}

}  // namespace

const targets::KeyTable& fold_keys() {
  static const targets::KeyTable keys = keys_of(FoldFile());
  return keys;
}

FoldFile read_fold_file(const targets::Node& node) {
  const targets::Section root = read_root(node, fold_keys());
  FoldFile file;
  file.goal = read_fold(root.required("target", ""));
  read_structure(root, file);
  const NetVariables variables = read_net_variables(root, file.size, {file.tilt, file.theta});
  file.tilt = variables.tilt;
  file.theta = variables.theta;
  if (file.goal.box_mm) choose_cells(root, file);
  read_settings(root, file.size.edge_mm, file);
  read_hinges(root, file.size, file);
  read_tolerance(root, file);
  if (file.goal.solid && file.robust)
    throw root.optional("robust")->error("is for boxes and nets of squares; leave it out for a solid");
  if (file.goal.solid && file.limits.any())
    throw root.optional("tolerance")
        ->error("force_N and strain are kept for boxes and nets of squares; leave them out for a solid");
  return file;
}

}  // namespace kinetix::app
