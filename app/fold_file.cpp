#include "app/fold_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/file_header.hpp"
#include "app/structure_section.hpp"
#include "model/wall_contact.hpp"
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

void read_beta(const Node& beta, FoldFile& file) {
  beta.reject_unknown_keys({"range_deg"});
  const auto range = beta.optional("range_deg");
  if (!range) return;
  const auto [lower, upper] = range->angle_range(from_to(-89, 89, "degrees"));
  if (!(lower < 0 && upper > 0))
    throw range->error("leaves one sign out: tilts alternate in sign along a crease; give a range around 0");
  file.tilt = std::min(-lower, upper);
}

void read_theta(const Node& theta, FoldFile& file) {
  theta.reject_unknown_keys({"range_deg"});
  const auto range = theta.optional("range_deg");
  if (!range) return;
  const auto [lower, upper] = range->angle_range(between(0, 45, "degrees"));
  file.theta = {lower, upper};
}

void read_variables(const Node& root, FoldFile& file) {
  const auto section = root.optional("variables");
  if (section) {
    section->reject_unknown_keys({"beta", "theta"});
    if (const auto beta = section->optional("beta")) read_beta(*beta, file);
    if (const auto theta = section->optional("theta")) read_theta(*theta, file);
  }
  if (file.theta.lower < closing_theta(file.size)) return;
  throw section.value_or(root).error(
      fmt::format("theta starts above {:.2f} deg, where walls of {:.3g} mm close cells of {:.3g} mm",
                  to_degrees(closing_theta(file.size)), file.size.thickness_mm, file.size.edge_mm));
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
  read_variables(root, file);
  read_tolerance(root, file);
  file.physics = read_physics(root, file.size.edge_mm);
  return file;
}

}  // namespace kinetix
