#include "app/files/design_file.hpp"

#include <fmt/format.h>
#include <filesystem>

#include "app/files/bodies_section.hpp"
#include "app/files/file_header.hpp"
#include "app/files/lattice_section.hpp"
#include "app/files/process_section.hpp"
#include "model/lattice/square/unit_laws.hpp"
#include "targets/document/edit_document.hpp"
#include "targets/document/number.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;
using model::SharedWalls;

// Ranges of t (a fraction), alpha and beta (degrees). They exclude their ends, which would put a hinge on a vertex,
// or its axis along the wall or in the sheet.
const targets::Bounds fraction = targets::between(0, 1);
const targets::Bounds in_plane = targets::between(0, 180, "degrees");
const targets::Bounds tilt = targets::between(-90, 90, "degrees");
// Half a wall to either side: any further, the hinge would be nearer to another wall.
const targets::Bounds offset = targets::between(-0.5, 0.5, "mm (within half a cell to either side)");

// Words of the key `shared`.
constexpr targets::Word<SharedWalls> shared_wall_choices[] = {{"average", SharedWalls::average},
                                                              {"must_agree", SharedWalls::must_agree}};

targets::ValueType four(const targets::ValueType& entry) {
  return value::list(entry, "`[bottom, right, top, left]`", 4, 4);
}

targets::Default four_times(const std::string& text) {
  return targets::by_default(("[" + text + ", " + text + ", " + text + ", " + text + "]").c_str());
}

targets::KeyTable tuple_keys() {
  return targets::KeyTable({
      {"P", four(value::number(fraction)), four_times("0.5"),
       "positions of the hinges on the cell's walls, counted around the cell"},
      {"A_in_deg", four(value::angle(in_plane)), four_times("90"), "angles of the hinges within the sheet"},
      {"A_out_deg", four(value::angle(tilt)), four_times("0"), "tilts of the hinges out of the sheet"},
  });
}

targets::KeyTable pattern_keys() {
  return targets::KeyTable({
      {"even", tuple_keys(), "cells whose i + j is even"},
      {"odd", tuple_keys(), "cells whose i + j is odd"},
      {"shared", value::choice(shared_wall_choices), targets::by_default("must_agree"),
       "action if two cells disagree about the wall between them: refuse the file, or use the average"},
  });
}

targets::KeyTable state_keys() {
  return targets::KeyTable({
      targets::Key("fold_angle_deg", value::angle(tilt), targets::by_default_deg(0),
                   "fold angle of the state that is shown. 0 is flat")
          .formerly("theta_deg"),
      {"pattern", pattern_keys(),
       "hinges of all cells by the paper's tuples, alternating like a checkerboard"},
      {"hinges", value::list(value::map(hinge_entry_keys()), "a list of hinges", 0), targets::no_default,
       "single hinges. They replace those of the pattern"},
  });
}

void check_kind_of_file(const targets::Node& root) {
  refuse_result(root);
  if (root.kind() == targets::Node::Kind::map && !root.optional("design") && root.optional("target"))
    throw root.error("this file is a target, not a design. Search it first with `kinetix-opt TARGET.yaml`");
}

model::Lattice read_structure(const targets::Section& root, std::vector<std::string>& notes) {
  return read_sheet(root.required("structure", "e.g. `structure: {cells: [6, 1], cell_mm: 10}`"), notes);
}

std::array<double, 4> read_four(const targets::Section& tuple, const char* key,
                                const std::array<double, 4>& fallback, const auto& read_value) {
  const auto node = tuple.optional(key);
  if (!node) return fallback;
  const auto entries = node->list_of(4, "four values: bottom, right, top, left");
  return {read_value(entries[0]), read_value(entries[1]), read_value(entries[2]), read_value(entries[3])};
}

model::CellTuple read_tuple(const targets::Section& section) {
  model::CellTuple tuple;
  tuple.P = read_four(section, "P", tuple.P, [](const targets::Node& n) { return n.number(fraction); });
  tuple.A_in =
      read_four(section, "A_in_deg", tuple.A_in, [](const targets::Node& n) { return n.angle(in_plane); });
  tuple.A_out =
      read_four(section, "A_out_deg", tuple.A_out, [](const targets::Node& n) { return n.angle(tilt); });
  return tuple;
}

void read_pattern(const targets::Section& design, model::Lattice& sheet) {
  const targets::Section pattern = design.section("pattern");
  if (!pattern.given()) return;
  model::Structure* squares = sheet.squares();
  if (!squares)
    throw pattern.node().key_error("a pattern needs cells of four walls, and the lattice is `" +
                                   lattice_name(sheet) + "`. List single `hinges` instead");
  const model::CellTuple even = read_tuple(pattern.section("even")), odd = read_tuple(pattern.section("odd"));
  SharedWalls shared = SharedWalls::must_agree;
  pattern.read("shared", shared, shared_wall_choices);
  pattern.node().located([&] { apply_pattern(*squares, even, odd, shared); });
}

model::HingeParameters read_parameters(const targets::Section& hinge, double edge_mm) {
  model::HingeParameters p;
  hinge.read_into(p);
  double offset_mm = 0;
  hinge.read_length("offset_mm", offset_mm, edge_mm);
  p.offset = offset_mm / edge_mm;
  return p;
}

void read_hinges(const targets::Section& design, Design& file) {
  model::Lattice& structure = file.structure;
  const auto list = design.optional("hinges");
  if (!list) return;
  const WallReader walls(structure);
  std::vector<int> line_of(static_cast<std::size_t>(structure.hinges()), 0);
  for (const targets::Node& node :
       list->list("a list of hinges, e.g. `- {wall: [[0, 0], [1, 0]], tilt_deg: 30}`")) {
    const targets::Section hinge(node, hinge_entry_keys());
    const int k = walls.hinge_of(hinge);
    if (line_of[k] > 0)
      throw node.error("the wall " + wall_name(structure, k) + " is listed twice, first in line " +
                       std::to_string(line_of[k]) + ". Remove one of the two entries");
    line_of[k] = node.place().line;
    structure.hinge(k) = read_parameters(hinge, structure.size().edge_mm);
    if (const targets::Section own = hinge.section("hinge"); own.given())
      file.hinge_overrides[k] = read_single_hinge(own, structure.size());
  }
  list->located([&] { validate_hinges(structure); });
}

void read_state(const targets::Section& root, Design& file) {
  const targets::Section design = root.section("design");
  read_pattern(design, file.structure);
  read_hinges(design, file);
  design.read("fold_angle_deg", file.theta);
}

/// Reads the section `hinge`. If single walls have stiffnesses, all hinges are elastic unless the section names its
/// model.
HingeSection read_common_hinge(const targets::Section& root, const Design& file) {
  HingeSection hinge = read_hinge_section(root, file.structure.size());
  if (!file.hinge_overrides.empty() && !root.section("hinge").optional("model"))
    hinge.model = HingeSection::Model::elastic;
  if (hinge.model == HingeSection::Model::elastic && !(hinge.k_turn > 0))
    throw root.section("hinge").optional("k_turn")->error(
        "0 is out of range for elastic hinges. Give a number above 0, in N mm/rad");
  return hinge;
}

/// Checks that gaps are shorter than their walls. Walls of a graph differ in length, but gaps are read against their
/// mean, the cell edge.
void check_gaps(const targets::Section& root, const Design& file) {
  for (int h = 0; h < file.structure.hinges(); ++h) {
    const auto& made = hinge_at(file.hinge, file.hinge_overrides, h).made;
    if (!made || is_pin(made->kind)) continue;
    const model::HingedWall wall = file.structure.wall(h);
    const double length =
        (file.structure.rest_position(wall.upper) - file.structure.rest_position(wall.lower)).norm();
    if (made->gap_mm < length) continue;
    const auto at = root.optional(file.hinge_overrides.contains(h) ? "design" : "hinge");
    throw at->error(
        fmt::format("the gap of {:.4g} mm does not fit on wall {}, which is {:.4g} mm long. "
                    "Give a smaller gap_mm, or a longer wall",
                    made->gap_mm, wall_name(file.structure, h), length));
  }
}

bool is_basic(const model::HingeParameters& p) {
  const model::HingeParameters basic;
  return p.t == basic.t && p.alpha == basic.alpha && p.beta == basic.beta && p.offset == basic.offset;
}

std::string offset_text(double offset, double edge_mm) {
  return offset == 0 ? "" : ", offset_mm: " + targets::shortest_text(mm_of(offset, edge_mm));
}

std::string format_hinge_overrides(const Design& design, int hinge) {
  const auto own = design.hinge_overrides.find(hinge);
  return own == design.hinge_overrides.end() ? "" : ", hinge: {" + hinge_text(own->second) + "}";
}

std::string hinges_text(const Design& design) {
  const model::Lattice& structure = design.structure;
  std::string text;
  for (int h = 0; h < structure.hinges(); ++h)
    if (const model::HingeParameters& hinge = structure.hinge(h);
        !is_basic(hinge) || design.hinge_overrides.contains(h))
      text +=
          fmt::format("    - {{wall: {}, t: {}, alpha_deg: {}, beta_deg: {}{}{}}}\n", wall_name(structure, h),
                      targets::shortest_text(hinge.t), targets::degrees_text(hinge.alpha),
                      targets::degrees_text(hinge.beta), offset_text(hinge.offset, structure.size().edge_mm),
                      format_hinge_overrides(design, h));
  if (text.empty()) return {};
  return "  hinges:  # walls that are not named have t: 0.5, alpha_deg: 90, beta_deg: 0\n" + text;
}

std::string hinge_section_text(const HingeSection& hinge) {
  if (hinge.kind && !hinge.made) return fmt::format("hinge: {{kind: {}}}\n", to_string(*hinge.kind));
  const std::string contact =
      hinge.k_contact ? ", k_contact: " + targets::shortest_text(*hinge.k_contact) : "";
  return fmt::format("hinge: {{model: {}, {}{}}}\n",
                     hinge.model == HingeSection::Model::rotary ? "rotary" : "elastic", hinge_text(hinge),
                     contact);
}

std::string bed_text(const model::Process& process) {
  if (!process.is_bed_given) return "";
  return fmt::format("bed_mm: [{}, {}]\n", targets::shortest_text(process.bed_mm[0]),
                     targets::shortest_text(process.bed_mm[1]));
}

std::string physics_text(const PhysicsSection& physics) {
  const std::string text = physics_keys().text(physics);
  return text.empty() ? "" : "physics: {" + text + "}\n";
}

}  // namespace

const targets::KeyTable& hinge_entry_keys() {
  using Hinge = model::HingeParameters;
  static const targets::KeyTable keys({
      wall_key(),
      targets::Key("hinge_position", &Hinge::t, value::number(fraction),
                   "position of the hinge along the wall, from its lower vertex (0) to its upper vertex (1)")
          .formerly("t"),
      {"alpha_deg", &Hinge::alpha, value::angle(in_plane),
       "angle of the hinge's axis to the wall's edge, in the plane of the wall"},
      targets::Key("tilt_deg", &Hinge::beta, value::angle(tilt),
                   "tilt of the wall from upright. Its hinge tilts with it")
          .formerly("beta_deg"),
      {"offset_mm", value::length(offset), targets::by_default(Hinge{}.offset),
       "distance of the hinge from the middle of the wall, to the left as seen from its lower vertex "
       "(towards z x e)"},
      {"hinge", single_hinge_keys(), "material and shape of this wall's hinge, if it differs from `hinge`"},
  });
  return keys;
}

const model::HingeTurn* turn_of(const Design& design) {
  return design.drive ? std::get_if<model::HingeTurn>(&*design.drive) : nullptr;
}

const model::BodyPull* body_pull_of(const Design& design) {
  return design.drive ? std::get_if<model::BodyPull>(&*design.drive) : nullptr;
}

std::string design_at(const std::string& source) {
  namespace fs = std::filesystem;
  std::error_code failure;  // ignored: reading the file reports a name that no file can have
  const fs::path path(source), beside = path.parent_path() / "design.yaml", inside = path / "design.yaml";
  if (path.filename() == "result.json" && fs::exists(beside, failure)) return beside.string();
  if (!fs::is_directory(path, failure)) return source;
  if (fs::exists(inside, failure)) return inside.string();
  throw InvalidInput(source + ": this folder has no design.yaml. Give a design, or the folder of a result");
}

Design read_design(const std::string& path) {
  return read_design(targets::read_document(path, max_design_bytes));
}

const targets::KeyTable& design_keys() {
  static const targets::KeyTable keys = file_keys({
      lattice_structure_key(),
      {"design", state_keys(), "position and tilt of every hinge, and the state that is shown"},
      drive_key(),
      {"hinge", hinge_keys(), "kind, material and stiffness of the hinges"},
      {"physics", physics_keys(), "settings of the simulation"},
      design_process_key(),
      bed_key(),
      lock_key(),
  });
  return keys;
}

Design read_design(const targets::Node& node) {
  check_kind_of_file(node);
  if (lists_bodies(node)) return read_bodies(node);
  if (const auto height_mm = open_wall_height_mm(node)) {
    targets::DocumentEditor with_height(node);
    with_height.put(targets::parse_path("structure.wall_mm.height"), targets::shortest_text(*height_mm));
    return read_design(with_height.root());
  }
  const targets::Section root = read_root(node, design_keys());
  std::vector<std::string> notes;
  Design file{.name = read_name(root), .structure = read_structure(root, notes)};
  file.notes = std::move(notes);
  read_state(root, file);
  file.hinge_overrides.merge(
      read_hinge_overrides(root, file.structure));  // entries of single walls take precedence
  file.drive = read_drive_section(root, file.structure);
  file.side = read_side(root);
  file.hinge = read_common_hinge(root, file);
  check_gaps(root, file);
  file.physics = read_physics(root, file.structure.size().edge_mm);
  file.process = read_process(root);
  file.lock = read_lock(root);
  return file;
}

std::vector<const HingeSection*> hinge_sections(const Design& design) {
  std::vector<const HingeSection*> all;
  if (static_cast<int>(design.hinge_overrides.size()) < design.structure.hinges())
    all.push_back(&design.hinge);
  for (const auto& [h, own] : design.hinge_overrides) all.push_back(&own);
  return all;
}

std::string design_text(const Design& design) {
  if (design.structure.assembly()) return bodies_text(design);
  return fmt::format("kinetix: 1\nname: \"{}\"\n", design.name) + structure_text(design.structure) +
         fmt::format("design:\n  theta_deg: {}\n", targets::degrees_text(design.theta)) +
         hinges_text(design) + drive_text(design.structure, design.drive, design.side) +
         hinge_section_text(design.hinge) + physics_text(design.physics) +
         (design.process == model::processes().front() ? ""
                                                       : "process: " + process_text(design.process) + "\n") +
         bed_text(design.process) + (design.lock ? "lock: " + to_string(*design.lock) + "\n" : "");
}

}  // namespace kinetix::app
