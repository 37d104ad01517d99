#include "app/imports/import_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/console/console.hpp"
#include "app/imports/hinge_choices.hpp"
#include "app/imports/import_tiles.hpp"
#include "app/imports/mobility_report.hpp"
#include "app/imports/model_parts.hpp"
#include "app/imports/tile_files.hpp"
#include "app/imports/written_import.hpp"
#include "model/base/angle.hpp"
#include "model/base/invalid_input.hpp"
#include "targets/document/number.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {
namespace {

constexpr double first_turn_deg = 30;  // degrees, of the drive that a design starts with: enough to see
constexpr double written_mm =
    1e9;  // parts of a mm, of points in the design: far below what a mesh of floats knows
constexpr double written_size = 1e6;        // likewise, of diameters and clearances
constexpr double written_direction = 1e12;  // parts of the length of a direction, which is 1

model::HingeChoices choices_of(const ImportRequest& request) {
  model::HingeChoices choices =
      request.hinges.empty() ? model::HingeChoices{} : read_hinge_choices(request.hinges);
  if (request.material.empty()) return choices;
  const model::Material* material = model::find_material(request.material);
  if (!material) {
    std::vector<std::string_view> names;
    for (const model::Material& m : model::materials()) names.push_back(m.name);
    throw InvalidInput("--material: unknown material " + targets::in_ticks(request.material) +
                       targets::did_you_mean(request.material, names) +
                       "; allowed: " + targets::joined(names));
  }
  choices.material = *material;
  return choices;
}

// Of a file whose parts are all hard, with no rod in a bore.
constexpr const char* if_films =
    ". If it is a sheet whose films are printed of the walls' own material (export does so for fdm and sls), "
    "its file "
    "does not tell them apart: give both parts as files of their own, --hard hard.stl --soft soft.stl";

/// Bad input that is found after reading gets the files' names.
model::Assembly assembled(const ModelParts& parts, const model::HingeChoices& choices) {
  try {
    return make_assembly(parts.parts, choices);
  } catch (const model::NoHinges& e) {
    throw InvalidInput(e.reason() + if_films, {parts.source});
  } catch (const InvalidInput& e) {
    throw InvalidInput(e.reason(), {parts.source});
  }
}

double rounded(double x, double parts) { return std::round(x * parts) / parts + 0.0; }

Eigen::Vector3d rounded(const Eigen::Vector3d& v, double parts) {
  return {rounded(v.x(), parts), rounded(v.y(), parts), rounded(v.z(), parts)};
}

/// What rounding left of zeros reads badly.
void tidy_up(model::Assembly& assembly) {
  for (model::AssemblyBody& b : assembly.bodies) b.position = rounded(b.position, written_mm);
  for (model::AssemblyHinge& h : assembly.hinges) {
    h.point = rounded(h.point, written_mm);
    h.rod_mm = rounded(h.rod_mm, written_size);
    h.clearance_mm = rounded(h.clearance_mm, written_size);
    h.axis = rounded(h.axis, written_direction);
    h.along = rounded(h.along, written_direction);
  }
}

std::string hinges_text(const model::Assembly& assembly) {
  const auto pins =
      std::count_if(assembly.hinges.begin(), assembly.hinges.end(),
                    [](const model::AssemblyHinge& h) { return h.kind == model::HingeKind::pin; });
  const auto least =
      std::min_element(assembly.hinges.begin(), assembly.hinges.end(),
                       [](const auto& a, const auto& b) { return a.confidence < b.confidence; });
  return fmt::format("{}: {} soft, {} pins; least sure `{}`, confidence {:.2f}", assembly.hinges.size(),
                     assembly.hinges.size() - static_cast<std::size_t>(pins), pins, least->name,
                     least->confidence);
}

std::string summary_text(const ModelParts& parts, const Design& design, const AssemblyMobility& mobility) {
  const model::Assembly& a = *design.structure.assembly();
  std::string out = fmt::format("{}\n", design.name);
  const auto line = [&](const char* label, const std::string& text) {
    out += fmt::format("  {:<10} {}\n", label, text);
  };
  line("unit", parts.unit);
  line("soft parts", parts.softness);
  line("bodies", std::to_string(a.bodies.size()));
  line("hinges", hinges_text(a));
  line("mobility", mobility.why);
  for (const std::string& note : a.notes) line("note", note);
  return out;
}

nlohmann::ordered_json summary_json(const ModelParts& parts, const Design& design,
                                    const AssemblyMobility& mobility) {
  nlohmann::ordered_json hinges = nlohmann::ordered_json::array();
  const model::Assembly& a = *design.structure.assembly();
  for (const model::AssemblyHinge& h : a.hinges)
    hinges.push_back({{"name", h.name},
                      {"bodies", {a.bodies[h.lower].name, a.bodies[h.upper].name}},
                      {"kind", to_string(h.kind)},
                      {"point_mm", {h.point.x(), h.point.y(), h.point.z()}},
                      {"axis", {h.axis.x(), h.axis.y(), h.axis.z()}},
                      {"confidence", h.confidence}});
  return {{"name", design.name},
          {"unit", parts.unit},
          {"bodies", a.bodies.size()},
          {"hinges", hinges},
          {"mobility", mobility_json(mobility, a)},
          {"notes", a.notes}};
}

void refuse_options_of_tiles(const ImportRequest& r) {
  for (const auto& [name, value] :
       {std::pair("--tile-mm", r.tile_mm), std::pair("--thickness-mm", r.thickness_mm),
        std::pair("--kerf-mm", r.kerf_mm)})
    if (value)
      throw InvalidInput(
          fmt::format("{} is of a folder of tiles, with vertices.txt and constraints.txt", name));
}

}  // namespace

int import_command(const CommandOptions& options, const ImportRequest& request) {
  if (is_tile_folder(request.model)) return import_tiles(options, request);
  refuse_options_of_tiles(request);
  Console console(options.quiet, false);
  const model::HingeChoices choices = choices_of(request);
  console.stage("reading parts", -1);
  const ModelParts parts = read_model_parts(request);
  console.stage("finding hinges", -1);
  model::Assembly bodies = assembled(parts, choices);
  tidy_up(bodies);
  console.stage("how it moves", -1);
  const AssemblyMobility mobility = examine(bodies);
  Design design{.name = import_name(request), .structure = model::Sheet(std::move(bodies))};
  if (mobility.hinge >= 0) {
    const double turn = std::min(targets::radians_of(first_turn_deg), mobility.turn);
    design.drive = model::HingeTurn{mobility.hinge, std::copysign(turn, mobility.sense)};
  }
  write_import(options, design, summary_json(parts, design, mobility), summary_text(parts, design, mobility));
  return done;
}

}  // namespace kinetix::app
