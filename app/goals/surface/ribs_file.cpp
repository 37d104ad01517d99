#include "app/goals/surface/ribs_file.hpp"

#include <algorithm>
#include <cmath>

#include "app/files/file_header.hpp"
#include "app/files/process_section.hpp"
#include "model/contact/wall_contact.hpp"
#include "targets/surface/read_surface.hpp"

namespace kinetix::app {
namespace {

constexpr double cells_per_diagonal = 25;  // cells per diagonal: ribs follow the visible shape of the surface
constexpr double largest_tilt = 75 * radians_per_degree;  // rad, the default for sheets of facets too

void refuse_keys_of_sheets(const targets::Section& root) {
  const auto refuse = [&](const char* section, std::initializer_list<const char*> keys) {
    for (const char* key : keys)
      if (const auto node = root.section(section).optional(key))
        throw node->key_error("belongs to a sheet of facets, target.ribs asks for ribs; leave it out");
  };
  refuse("structure", {"facets"});
  refuse("variables", {"theta_deg", "sector_deg", "edge"});
}

optim::RibsSpec read_spec(const targets::Section& root, const targets::RibbedSurface& surface) {
  const targets::Node key = *root.section("target").optional("ribs");
  optim::RibsSpec spec = usual_ribs(surface, key.integer(1, most_ribs));
  root.section("structure").read("cell_mm", spec.size.edge_mm);
  ThinWalls walls;
  root.read_into(walls);
  spec.size = walls.size(spec.size.edge_mm);
  root.section("variables").read("beta_deg", spec.tilt);
  spec.theta.upper = std::min(spec.theta.upper, closing_theta(spec.size));
  spec.start_theta = std::clamp(spec.start_theta, spec.theta.lower, spec.theta.upper);
  key.located([&] { plan_ribs(surface, spec); });
  return spec;
}

}  // namespace

optim::RibsSpec usual_ribs(const targets::RibbedSurface& surface, int ribs) {
  optim::RibsSpec spec;
  spec.ribs = ribs;
  spec.clearance_mm = 0;
  spec.tilt = largest_tilt;
  const double pitch =
      std::min(surface.diagonal / cells_per_diagonal, surface.spine.length() / (2 * ribs + 1));
  spec.size = ThinWalls().size(pitch / std::cos(spec.start_theta));
  return spec;
}

RibsFile read_ribs_file(const targets::Node& node) {
  const targets::Section root = read_root(node, surface_file_keys());
  refuse_keys_of_sheets(root);
  const targets::Section target = root.section("target");
  targets::RibbedSurface surface = targets::read_ribbed_surface(target);
  RibsFile file{{}, targets::surface_name(target), std::move(surface)};
  file.spec = read_spec(root, file.surface);
  const targets::Section tolerance = root.section("tolerance");
  tolerance.read("shape", file.shape_tolerance);
  if (const auto cover = tolerance.optional("cover"))
    throw cover->key_error("belongs to a sheet of facets; of ribs give `tolerance.covered_share`");
  if (const auto curvature = tolerance.optional("curvature_share"))
    throw curvature->key_error("belongs to a sheet of facets, ribs follow any curvature; leave it out");
  tolerance.read("covered_share", file.covered_tolerance);
  read_settings(root, file.spec.size.edge_mm, file);
  file.process = read_process(root, file.spec.size, {});
  return file;
}

}  // namespace kinetix::app
