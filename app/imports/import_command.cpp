#include "app/imports/import_command.hpp"

#include <fmt/format.h>
#include <cctype>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/files/bodies_section.hpp"
#include "app/imports/model_parts.hpp"
#include "app/io/atomic_file.hpp"
#include "app/models/model_file.hpp"
#include "model/assembly/assembly.hpp"
#include "model/assembly/assembly_motion.hpp"
#include "model/assembly/deployment.hpp"
#include "model/closure/mobility.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {

std::string import_name(const ImportRequest& request) {
  std::filesystem::path path(request.model.empty() ? request.hard : request.model);
  if (!path.has_filename()) path = path.parent_path();
  std::string stem = path.stem().string().substr(0, 100);
  for (char& c : stem)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-' && c != '.') c = '_';
  return stem.empty() || stem[0] == '.' ? "_" + stem : stem;
}

void write_import(const CommandOptions& options, const Design& design, const nlohmann::ordered_json& json,
                  ShortForm form) {
  OutputFolder folder(options.folder_of(design.name));
  FileSet files(folder.path());
  for (const NamedContent& content : design_files(design)) files.add(content.name, content.content);
  files.commit();
  folder.keep();
  form.ends = {fmt::format("Written: {}/design.yaml, parts", folder.path()),
               "Next: kinetix-opt view " + folder.path()};
  if (options.json)
    std::cout << json.dump(1) << "\n";
  else
    print_on_stdout(form, options.verbose);
}

namespace {

/// Mobility of an imported assembly.
struct AssemblyMobility {
  int gruebler = 0;            ///< degrees of freedom by counting bodies and hinges
  std::optional<int> at_rest;  ///< first-order motions at rest; empty: too many bodies to count
  int hinge = -1;              ///< hinge that is turned to examine it; -1: nothing turns
  double sense = 1;            ///< sign of its turn, 1 or -1, dimensionless
  double turn = 0;             ///< largest one with all hinges closed, rad
  int broken = -1;             ///< hinge that makes it rigid, or that opens first beyond `turn`; -1: none
  std::string why;             ///< the result in a sentence
};

constexpr double looked_at = 60 * radians_per_degree;  // rad of a hinge: most sheets fold no further.
// Singular value of a closure Jacobian. Axes from meshes of floats are off by 1e-6 rad, and a mechanism's zeros are
// about as large. Rigid structures have 1e-3 and more.
constexpr double smallest = 1e-4;
constexpr double min_turn = 2 * radians_per_degree;  // rad: a smaller turn is only clearance
constexpr double max_strain = 1e-3;  // rad and cell edges per rad: faster opening is not a motion

std::size_t balls_of(const model::Assembly& assembly) {
  return static_cast<std::size_t>(
      std::count_if(assembly.hinges.begin(), assembly.hinges.end(), [](const auto& h) { return h.ball; }));
}

/// Turns the hinge that turns most in the first motion by up to 60 degrees. All hinges count as rigid revolute joints or
/// balls.
AssemblyMobility examine(const model::Assembly& assembly) {
  const model::Linkage linkage = linkage_of(assembly);
  AssemblyMobility out;
  const int hinges = static_cast<int>(linkage.hinges.size()), balls = static_cast<int>(balls_of(assembly));
  out.gruebler = model::gruebler_spatial(static_cast<int>(linkage.bodies.size()), hinges, hinges + 2 * balls);
  out.at_rest = degrees_of_freedom(linkage, rest_state(linkage), linkage.hinges.size(), smallest);
  if (balls == hinges) {
    out.why = out.at_rest
                  ? fmt::format("{} first-order motions at rest; balls have no axis to turn", *out.at_rest)
                  : "balls have no axis to turn";
    return out;
  }
  const model::FirstMotion first = first_motion(linkage);
  if ((out.at_rest && *out.at_rest <= 0) || first.fastest < 0 || first.strain > max_strain) {
    if (out.at_rest && *out.at_rest <= 0) out.broken = first_rigid_hinge(linkage, smallest);
    out.why = "rigid: every motion at rest would open a hinge";
    if (out.broken >= 0)
      out.why += fmt::format("; in the order of the hinges, `{}` is the first that blocks the motion",
                             assembly.hinges[out.broken].name);
    return out;
  }
  out.hinge = first.fastest;
  out.sense = first.rate < 0 ? -1 : 1;
  const model::AssemblyMotion motion = follow_turn(linkage, first, out.hinge, out.sense * looked_at);
  out.turn = std::abs(motion.turns.back());
  out.broken = motion.broken;
  const std::string count = out.at_rest ? fmt::format("{} first-order motion{} at rest; ", *out.at_rest,
                                                      *out.at_rest == 1 ? "" : "s")
                                        : "";
  const std::string& driven = assembly.hinges[out.hinge].name;
  if (motion.reached)
    out.why = fmt::format(
        "{}`{}` turns by {:.0f} degrees and all hinges stay closed, within {:.1e} cell edges and {:.1e} rad",
        count, driven, to_degrees(out.turn), motion.gap, motion.axis_gap);
  else
    out.why = fmt::format("{}`{}` turns by {:.0f} degrees{}; beyond, `{}` opens first", count, driven,
                          to_degrees(out.turn), out.turn < min_turn ? ": hardly at all" : "",
                          assembly.hinges[motion.broken].name);
  return out;
}

nlohmann::ordered_json mobility_json(const AssemblyMobility& m, const model::Assembly& assembly) {
  nlohmann::ordered_json out = {{"gruebler", m.gruebler},       {"flat", nullptr},   {"hinge", nullptr},
                                {"turn_rad", m.sense * m.turn}, {"broken", nullptr}, {"why", m.why}};
  if (m.at_rest) out["flat"] = *m.at_rest;
  if (m.hinge >= 0) out["hinge"] = assembly.hinges[m.hinge].name;
  if (m.broken >= 0) out["broken"] = assembly.hinges[m.broken].name;
  return out;
}

constexpr double default_edge_mm = 20;    // mm: tiles that a hand can hold
constexpr double thickness_share = 0.05;  // of the median edge: 1 mm of board at the usual one
constexpr double kerf_share = 0.03;       // of the median edge, a wide laser cut: above the contact tolerance
constexpr double default_expand = 3;      // times: no tiling opens that far, so tiles move as far as they can
constexpr double no_motion = 1e-6;  // rad and cell edges: a closure's singular value of 0 in rounded files

void refuse_options_of_models(const ImportRequest& r) {
  for (const auto& [name, value] :
       {std::pair("--hard", &r.hard), std::pair("--soft", &r.soft),
        std::pair("--soft-material", &r.soft_material), std::pair("--unit", &r.unit),
        std::pair("--material", &r.material), std::pair("--hinges", &r.hinges)})
    if (!value->empty())
      throw InvalidInput(
          fmt::format("{} only applies to models with hard and soft parts. Use --tile-mm, --thickness-mm and "
                      "--kerf-mm for tiles",
                      name));
}

double checked(const std::optional<double>& asked, double usual, double least, const char* option) {
  const double value = asked.value_or(usual);
  if (!(value >= least && value <= 1e6))
    throw InvalidInput(fmt::format("{} is {} mm. Give {} to 1000000 mm", option, value, least));
  return value;
}

model::TileMake make_of(const ImportRequest& request, const model::TileSheet& sheet) {
  constexpr double least = 1e-3;  // mm: nothing is manufactured finer
  const double edge = model::median_edge(sheet),
               mm = checked(request.tile_mm, default_edge_mm, least, "--tile-mm");
  if (!(edge > 0)) throw InvalidInput("the tiles have no size. Give tiles with an area");
  return {.scale_mm = mm / edge,
          .thickness_mm = checked(request.thickness_mm, thickness_share * mm, least, "--thickness-mm"),
          .kerf_mm = checked(request.kerf_mm, kerf_share * mm, 0, "--kerf-mm")};
}

/// Design of tiles with data for its summary.
struct TileImport {
  Design design;
  model::TileMake make;
  std::optional<double> target_off =
      {};                           ///< largest miss of the target by rigid tiles' corners, median edges
  std::optional<int> motions = {};  ///< first-order motions at rest
};

TileImport import_of_tiles(const model::TileSheet& sheet, const ImportRequest& request) {
  TileImport out;
  out.make = make_of(request, sheet);
  out.design.name = import_name(request);
  out.design.structure = model::Lattice(assembly_of_tiles(sheet, out.make));
  const model::Linkage linkage = out.design.structure;
  model::BodyPull pull;
  if (sheet.target.empty()) {
    pull.expand = default_expand;
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

TileImport located_import(const ImportRequest& request, const model::TileSheet& sheet) {
  try {
    return import_of_tiles(sheet, request);
  } catch (const InvalidInput& e) {
    if (!e.place().file.empty() || e.reason().starts_with("--")) throw;
    throw InvalidInput(e.reason(), {request.model});
  }
}

ShortForm tiles_form(const TileImport& import) {
  const model::Assembly& a = *import.design.structure.assembly();
  ShortForm out{.title = fmt::format("{}: imported, {} tiles", import.design.name, a.bodies.size())};
  out.lines = {
      {"tiles", fmt::format("{:.3g} mm thick, cut {:.3g} mm wide; scale {:.4g} mm per unit of the file",
                            import.make.thickness_mm, import.make.kerf_mm, import.make.scale_mm)},
      {"joints", fmt::format("{}: {} about the normal of the tiles, {} balls", a.hinges.size(),
                             a.hinges.size() - balls_of(a), balls_of(a))}};
  if (import.motions)
    out.lines.push_back({"mobility", fmt::format("{} first-order motions at rest", *import.motions)});
  out.lines.push_back(
      {"pull",
       import.target_off
           ? fmt::format("to its target, which rigid tiles miss by {:.1e} of an edge", *import.target_off)
           : fmt::format("apart, to {:.3g} times the distance from the middle; no target given",
                         default_expand)});
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

/// Reads a folder of tiles, or an OBJ file of faces that share vertices alone; empty for other models.
std::optional<model::TileSheet> read_sheet(const ImportRequest& request) {
  if (is_tile_folder(request.model)) return read_tiles(request.model);
  return request.model.empty() ? std::nullopt : read_tiles_of_obj(request.model);
}

/// Imports tiles as a design of prisms and their joints. The drive pulls them to the target, or apart if
/// there is none.
/// @return the exit code.   @throws InvalidInput for invalid files, tiles and joints, and for options of other models
int import_tiles(const CommandOptions& options, const ImportRequest& request, const model::TileSheet& sheet) {
  refuse_options_of_models(request);
  const TileImport import = located_import(request, sheet);
  write_import(options, import.design, tiles_json(import), tiles_form(import));
  return done;
}

constexpr double first_turn_deg = 30;       // degrees, of a new design's drive: enough to see the motion
constexpr double written_mm = 1e9;          // parts per mm, for points: far finer than a mesh of floats
constexpr double written_size = 1e6;        // parts per mm, for diameters and clearances
constexpr double written_direction = 1e12;  // parts per unit length, for directions

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

// Advice for a file whose parts are all hard, with no rod in a bore.
constexpr const char* if_films =
    ". Give both parts in separate files, --hard hard.stl --soft soft.stl, if the living hinges have the "
    "material of the walls. export writes such files for fdm and sls";

/// Builds the assembly. Adds the files' names to bad input that is found after reading.
model::Assembly assembled(const ModelParts& parts, const model::HingeChoices& choices) {
  try {
    return make_assembly(parts.parts, choices);
  } catch (const model::NoHinges& e) {
    throw InvalidInput(parts.unclear.empty() ? e.reason() + if_films : parts.unclear, {parts.source});
  } catch (const InvalidInput& e) {
    throw InvalidInput(
        e.reason() +
            (parts.unclear.empty() ? "" : ". Name a soft material with --soft-material, if there is one"),
        {parts.source});
  }
}

double rounded(double x, double parts) { return std::round(x * parts) / parts + 0.0; }

Eigen::Vector3d rounded(const Eigen::Vector3d& v, double parts) {
  return {rounded(v.x(), parts), rounded(v.y(), parts), rounded(v.z(), parts)};
}

/// Rounds numbers of the assembly: remainders of zeros are hard to read in its file.
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
                    [](const model::AssemblyHinge& h) { return h.kind == model::HingeKind::pin && !h.ball; });
  const std::size_t balls = balls_of(assembly);
  const auto least =
      std::min_element(assembly.hinges.begin(), assembly.hinges.end(),
                       [](const auto& a, const auto& b) { return a.confidence < b.confidence; });
  return fmt::format("{}: {} soft, {} pins{}; least certain `{}`, confidence {:.2f}", assembly.hinges.size(),
                     assembly.hinges.size() - static_cast<std::size_t>(pins) - balls, pins,
                     balls == 0 ? "" : fmt::format(", {} balls", balls), least->name, least->confidence);
}

ShortForm import_form(const ModelParts& parts, const Design& design, const AssemblyMobility& mobility) {
  const model::Assembly& a = *design.structure.assembly();
  ShortForm out{.title = fmt::format("{}: imported, {} bodies", design.name, a.bodies.size()),
                .lines = {{"hinges", hinges_text(a)},
                          {"mobility", mobility.why},
                          {"unit", parts.unit},
                          {"soft", parts.softness}}};
  for (const std::string& note : a.notes) out.problems.push_back({"warning", note});
  return out;
}

nlohmann::ordered_json summary_json(const ModelParts& parts, const Design& design,
                                    const AssemblyMobility& mobility) {
  nlohmann::ordered_json hinges = nlohmann::ordered_json::array();
  const model::Assembly& a = *design.structure.assembly();
  for (const model::AssemblyHinge& h : a.hinges)
    hinges.push_back({{"name", h.name},
                      {"bodies", {a.bodies[h.lower].name, a.bodies[h.upper].name}},
                      {"kind", h.ball ? "ball" : to_string(h.kind)},
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
      throw InvalidInput(fmt::format(
          "{} only applies to tiles: a folder with vertices.txt and constraints.txt, or an OBJ file of faces "
          "that share vertices alone. Remove it",
          name));
}

}  // namespace

int import_command(const CommandOptions& options, const ImportRequest& request) {
  Console console(options.quiet, false);
  console.stage("reading", -1);
  if (const auto sheet = read_sheet(request)) return import_tiles(options, request, *sheet);
  refuse_options_of_tiles(request);
  const model::HingeChoices choices = choices_of(request);
  console.stage("reading parts", -1);
  const ModelParts parts = read_model_parts(request);
  console.stage("finding hinges", -1);
  model::Assembly bodies = assembled(parts, choices);
  tidy_up(bodies);
  console.stage("motion", -1);
  const AssemblyMobility mobility = examine(bodies);
  Design design{.name = import_name(request), .structure = model::Lattice(std::move(bodies))};
  if (mobility.hinge >= 0) {
    const double turn = std::min(targets::radians_of(first_turn_deg), mobility.turn);
    design.drive = model::HingeTurn{mobility.hinge, std::copysign(turn, mobility.sense)};
  }
  write_import(options, design, summary_json(parts, design, mobility), import_form(parts, design, mobility));
  return done;
}

}  // namespace kinetix::app
