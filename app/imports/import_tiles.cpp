#include "app/imports/import_tiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/console/console.hpp"
#include "app/imports/tile_files.hpp"
#include "app/imports/written_import.hpp"
#include "model/assembly/assembly_motion.hpp"
#include "model/assembly/deployment.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::app {
namespace {

constexpr double usual_edge_mm = 20;      // mm: tiles that a hand can hold
constexpr double thickness_share = 0.05;  // of the median edge: 1 mm of board at the usual one
constexpr double kerf_share =
    0.03;  // likewise: more than what counts as touching in the physics run, a wide laser cut
constexpr double usual_expand = 3;  // times: no tiling opens so far, so that tiles go as far as they can
constexpr double no_motion =
    1e-6;  // rad and cell edges: of a singular value of closure, which files leave of zero

void refuse_options_of_models(const ImportRequest& r) {
  for (const auto& [name, value] :
       {std::pair("--hard", &r.hard), std::pair("--soft", &r.soft),
        std::pair("--soft-material", &r.soft_material), std::pair("--unit", &r.unit),
        std::pair("--material", &r.material), std::pair("--hinges", &r.hinges)})
    if (!value->empty())
      throw InvalidInput(
          fmt::format("{} is of models with hard and soft parts; a folder of tiles has --tile-mm, "
                      "--thickness-mm and --kerf-mm",
                      name));
}

double checked(const std::optional<double>& asked, double usual, double least, const char* option) {
  const double value = asked.value_or(usual);
  if (!(value >= least && value <= 1e6))
    throw InvalidInput(fmt::format("{} is {} mm; it is from {} to 1000000 mm", option, value, least));
  return value;
}

model::TileMake make_of(const ImportRequest& request, const model::TileSheet& sheet) {
  constexpr double least = 1e-3;  // mm: nothing is made finer
  const double edge = model::median_edge(sheet),
               mm = checked(request.tile_mm, usual_edge_mm, least, "--tile-mm");
  if (!(edge > 0)) throw InvalidInput("has tiles without a size");
  return {.scale_mm = mm / edge,
          .thickness_mm = checked(request.thickness_mm, thickness_share * mm, least, "--thickness-mm"),
          .kerf_mm = checked(request.kerf_mm, kerf_share * mm, 0, "--kerf-mm")};
}

/// A design of tiles, and what there is to say of it.
struct TileImport {
  Design design;
  model::TileMake make;
  std::optional<double> target_off = {};  ///< by which corners miss their target as rigid tiles, median edges
  std::optional<int> motions = {};        ///< at rest
};

TileImport made_of(const model::TileSheet& sheet, const ImportRequest& request) {
  TileImport out;
  out.make = make_of(request, sheet);
  out.design.name = import_name(request);
  out.design.structure = model::Sheet(assembly_of_tiles(sheet, out.make));
  const model::Linkage linkage = out.design.structure;
  model::BodyPull pull;
  if (sheet.target.empty()) {
    pull.expand = usual_expand;
  } else {
    const model::TileTarget target =
        target_of_tiles(sheet, *out.design.structure.assembly(), out.make.scale_mm);
    out.target_off = target.off_max;
    pull.poses = aligned_pull(linkage, {target.poses}).to;
  }
  out.design.drive = pull;
  out.motions = degrees_of_freedom(linkage, rest_state(linkage), linkage.hinges.size(), no_motion);
  return out;
}

TileImport located_import(const ImportRequest& request) {
  const model::TileSheet sheet = read_tiles(request.model);
  try {
    return made_of(sheet, request);
  } catch (const InvalidInput& e) {
    if (!e.place().file.empty() || e.reason().starts_with("--")) throw;
    throw InvalidInput(e.reason(), {request.model});
  }
}

std::size_t balls_of(const model::Assembly& assembly) {
  return static_cast<std::size_t>(
      std::count_if(assembly.hinges.begin(), assembly.hinges.end(), [](const auto& h) { return h.ball; }));
}

std::string tiles_text(const TileImport& import) {
  const model::Assembly& a = *import.design.structure.assembly();
  std::string out = fmt::format("{}\n", import.design.name);
  const auto line = [&](const char* label, const std::string& text) {
    out += fmt::format("  {:<10} {}\n", label, text);
  };
  line("tiles", fmt::format("{}, {:.3g} mm thick, cut {:.3g} mm wide", a.bodies.size(),
                            import.make.thickness_mm, import.make.kerf_mm));
  line("scale", fmt::format("{:.4g} mm a unit of the file", import.make.scale_mm));
  line("joints", fmt::format("{}: {} about the tiles' normal, {} balls", a.hinges.size(),
                             a.hinges.size() - balls_of(a), balls_of(a)));
  if (import.motions) line("mobility", fmt::format("{} first-order motions at rest", *import.motions));
  line("pull",
       import.target_off
           ? fmt::format("to its target, which rigid tiles miss by {:.1e} of an edge", *import.target_off)
           : fmt::format("apart, to {:.3g} times the distance from the middle: it has no target",
                         usual_expand));
  return out;
}

nlohmann::ordered_json tiles_json(const TileImport& import) {
  const model::Assembly& a = *import.design.structure.assembly();
  nlohmann::ordered_json out = {{"name", import.design.name},
                                {"bodies", a.bodies.size()},
                                {"hinges", a.hinges.size()},
                                {"balls", balls_of(a)},
                                {"scale_mm", import.make.scale_mm},
                                {"thickness_mm", import.make.thickness_mm},
                                {"kerf_mm", import.make.kerf_mm},
                                {"mobility", {{"flat", nullptr}}},
                                {"target_off", nullptr}};
  if (import.motions) out["mobility"]["flat"] = *import.motions;
  if (import.target_off) out["target_off"] = *import.target_off;
  return out;
}

}  // namespace

int import_tiles(const CommandOptions& options, const ImportRequest& request) {
  refuse_options_of_models(request);
  Console console(options.quiet, false);
  console.stage("reading tiles", -1);
  const TileImport import = located_import(request);
  write_import(options, import.design, tiles_json(import), tiles_text(import));
  return done;
}

}  // namespace kinetix::app
