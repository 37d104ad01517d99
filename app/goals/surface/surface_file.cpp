#include "app/goals/surface/surface_file.hpp"

#include <fmt/format.h>

#include "app/files/file_header.hpp"
#include "app/files/process_section.hpp"
#include "app/models/model_file.hpp"
#include "targets/surface/ribbed_surface.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;

constexpr int max_facets = 24;       // facets per side: a search with 24 takes minutes
constexpr double max_curvature = 1;  // rad: largest turn of the surface over one flat facet
// Shares of a whole, ratio.
const targets::Bounds share = {0, 1, true, true};
// Tilt of creases, degrees: near 90 walls would be in the plane of the sheet.
const targets::Bounds tilts = targets::between(0, 85, "degrees");
// Theta, degrees: planar cells close at 45.
const targets::Bounds turns = targets::between(0, 45, "degrees");
const targets::Bounds sectors = targets::between(0, 180, "degrees");
const targets::Bounds edges = targets::between(0, 10);

targets::KeyTable surface_target_keys() {
  std::vector<targets::Key> keys = targets::surface_keys();
  keys.insert(keys.begin(), targets::goal_kind_key("surface"));
  keys.push_back(
      {"ribs", value::integer(1, max_ribs), targets::otherwise("a sheet of facets"),
       "number of ribs on a spine, which replace the sheet of facets. They cover any surface, open or "
       "closed"});
  return targets::KeyTable(std::move(keys));
}

void read_structure(const targets::Section& root, SurfaceFile& file) {
  const targets::Section structure = root.section("structure");
  if (const auto cell = structure.optional("cell_mm"))
    throw cell->key_error(
        "only applies to ribs: the walls of a sheet follow from its facets. Remove the key, or "
        "add `target.ribs`");
  if (const auto facets = structure.optional("facets")) {
    const auto sides = facets->list_of(2, "[columns, rows]");
    file.columns = sides[0].integer(2, max_facets);
    file.rows = sides[1].integer(2, max_facets);
  }
  root.read_into(file.walls);
}

void read_variables_and_tolerance(const targets::Section& root, SurfaceFile& file) {
  root.read_into(file);
  const targets::Section variables = root.section("variables");
  if (const auto edge = variables.optional("edge"); edge && !(file.edge[0] < 1 && file.edge[1] > 1))
    throw edge->error("the range does not contain 1, the mean edge. Give a range around 1");
  if (const auto sector = variables.optional("sector_deg");
      sector && !(file.sector[0] < pi / 2 && file.sector[1] > pi / 2))
    throw sector->error("the range does not contain 90. Give a range around 90 degrees");
  if (const auto covered = root.section("tolerance").optional("covered_share"))
    throw covered->key_error(
        "only applies to ribs. Give `tolerance.cover` for a sheet, or add `target.ribs`");
}

/// Rejects a surface that turns by more than max_curvature over one flat facet.
void check_curvature(const targets::Section& target, const SurfaceFile& file) {
  const targets::SurfaceCurvature curvature = curvature_of(file.patch);
  const double facet = 2 * std::max(file.patch.half.x() / file.columns, file.patch.half.y() / file.rows);
  if (curvature.most * facet <= max_curvature) return;
  throw target.error(
      fmt::format("the radius of the surface near ({:.3g}, {:.3g}) mm is {:.3g} mm, less than the width of a "
                  "facet, {:.3g} mm. Give more `structure.facets`, or `target.ribs`",
                  curvature.place.x(), curvature.place.y(), 1 / curvature.most, facet));
}

}  // namespace

const targets::KeyTable& surface_file_keys() {
  static const targets::KeyTable keys = goal_keys(
      {
          {"target", surface_target_keys(), "the goal", targets::needed},
          {"structure",
           targets::KeyTable({
               {"facets", value::list(value::integer(2, max_facets), "`[columns, rows]`", 2, 2),
                targets::by_default(std::array<double, 2>{8, 8}),
                "flat facets of the folded sheet, along x and y of the surface. Each has 2 x 2 bodies"},
               {"cell_mm", value::number(targets::above(0, "mm")),
                targets::otherwise("leaves room between ribs, with 25 cells along the diagonal"),
                "cell edge of ribs"},
               thin_walls_key("mean walls, or cells of ribs",
                              "size of the walls. Their lengths follow from the surface"),
           }),
           "flat sheet"},
          {"variables",
           targets::KeyTable({
               targets::Key("fold_angle_deg", &SurfaceFile::theta, value::angle(turns),
                            "fold angle of the sheet on the surface")
                   .formerly("theta_deg"),
               targets::Key("tilt_deg", &SurfaceFile::tilt, value::angle(tilts),
                            "largest tilt of a hinge, of either sign")
                   .formerly("beta_deg"),
               {"sector_deg", &SurfaceFile::sector, value::angle_range(sectors),
                "angles between the creases of a vertex. Below 50 and above 130 bodies may not fit round the "
                "vertex. Below 60 and above 120 walls collide early"},
               {"edge", &SurfaceFile::edge, value::range(edges),
                "lengths of the facets' edges, relative to their mean"},
           }),
           "ranges of the search"},
          {"tolerance",
           targets::KeyTable({
               {"shape", &SurfaceFile::shape_tolerance, value::number(targets::part_of_one),
                "limit of [surface_rms](#surface_rms), relative to the diagonal of the surface's box"},
               {"cover", &SurfaceFile::cover_tolerance, value::number(share),
                "for a sheet: minimum of [cover](#surface_rms)"},
               {"curvature_share", &SurfaceFile::curvature_tolerance, value::number(share),
                "for a sheet: minimum of [curvature_share](#curvature_share), if the surface curves in both "
                "directions by more than 0.1 sr"},
               {"covered_share", value::number(share),
                targets::otherwise(targets::shortest_text(default_covered_share) + " with `target.ribs`"),
                "for ribs: minimum of [covered_share](#covered_share)"},
               verify_key(),
           }),
           "limits for a met goal"},
      },
      {});
  return keys;
}

SurfaceFile read_surface_file(const targets::Node& node) {
  const targets::Section root = read_root(node, surface_file_keys());
  SurfaceFile file;
  const targets::Section target = root.section("target");
  file.patch = targets::read_surface(target, read_mesh_file);
  read_structure(root, file);
  check_curvature(target, file);
  read_variables_and_tolerance(root, file);
  read_settings(root, file.patch.diagonal() / (4 * std::max(file.columns, file.rows)), file);
  return file;
}

namespace {

constexpr double cells_per_diagonal = 25;  // cells per diagonal: ribs follow the visible shape of the surface
constexpr double largest_tilt = 75 * radians_per_degree;  // rad, the default for sheets of facets too

void refuse_keys_of_sheets(const targets::Section& root) {
  const auto refuse = [&](const char* section, std::initializer_list<const char*> keys) {
    for (const char* key : keys)
      if (const auto node = root.section(section).optional(key))
        throw node->key_error("only applies to a sheet of facets. Remove the key, or target.ribs");
  };
  refuse("structure", {"facets"});
  refuse("variables", {"fold_angle_deg", "sector_deg", "edge"});
}

optim::RibsSpec read_spec(const targets::Section& root, const targets::RibbedSurface& surface) {
  const targets::Node key = *root.section("target").optional("ribs");
  optim::RibsSpec spec = default_ribs(surface, key.integer(1, max_ribs));
  root.section("structure").read("cell_mm", spec.size.edge_mm);
  ThinWalls walls;
  root.read_into(walls);
  spec.size = walls.size(spec.size.edge_mm);
  root.section("variables").read("tilt_deg", spec.tilt);
  spec.theta.upper = std::min(spec.theta.upper, closing_theta(spec.size));
  spec.start_theta = std::clamp(spec.start_theta, spec.theta.lower, spec.theta.upper);
  key.located([&] { plan_ribs(surface, spec); });
  return spec;
}

}  // namespace

optim::RibsSpec default_ribs(const targets::RibbedSurface& surface, int ribs) {
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
  targets::RibbedSurface surface = targets::read_ribbed_surface(target, read_mesh_file);
  RibsFile file{{}, targets::surface_name(target), std::move(surface)};
  file.spec = read_spec(root, file.surface);
  const targets::Section tolerance = root.section("tolerance");
  tolerance.read("shape", file.shape_tolerance);
  if (const auto cover = tolerance.optional("cover"))
    throw cover->key_error("only applies to a sheet of facets. Give `tolerance.covered_share` for ribs");
  if (const auto curvature = tolerance.optional("curvature_share"))
    throw curvature->key_error("only applies to a sheet of facets. Remove the key, or target.ribs");
  tolerance.read("covered_share", file.covered_tolerance);
  read_settings(root, file.spec.size.edge_mm, file);
  return file;
}

}  // namespace kinetix::app
