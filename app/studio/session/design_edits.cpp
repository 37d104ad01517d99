#include "app/studio/session/design_edits.hpp"

#include <fmt/format.h>

#include "app/files/structure_section.hpp"
#include "app/run/design_hinges.hpp"
#include "model/lattice/square/changed_cells.hpp"
#include "model/lattice/square/sheet_symmetry.hpp"

namespace kinetix::app::studio {
namespace {

constexpr double rounded_share = 1e-9;      // of a length: error of its digits in a file
constexpr double farthest_stiffness = 1e9;  // N/mm and N mm/rad, and its inverse: beyond all hinges
constexpr int max_cells_per_side = 200;     // a page shows this many at 15 frames per second

const targets::KeyTable& only_hinge() {
  static const targets::KeyTable keys(
      {{"hinge", targets::value::map(hinge_keys()), {}, "kind and size of the hinges"}});
  return keys;
}

std::vector<int> hinges_of(const Message& message, int count) {
  if (message.has("indices")) return message.integers("indices", 0, count - 1);
  return {message.integer("index", 0, count - 1)};
}

void change(model::HingeParameters& hinge, const Message& message, double edge_mm) {
  if (message.has("t")) hinge.t = message.number("t", 0, 1);
  if (message.has("alpha_deg")) hinge.alpha = message.number("alpha_deg", 0, 180) * radians_per_degree;
  if (message.has("beta_deg")) hinge.beta = message.number("beta_deg", -90, 90) * radians_per_degree;
  if (message.has("offset_mm")) hinge.offset = message.number("offset_mm", -edge_mm, edge_mm) / edge_mm;
}

/// Changes a hinge of bodies. Values that the message lacks keep their imported value.
void change(model::AssemblyHinge& hinge, const Message& message) {
  for (const char* key : {"t", "alpha_deg", "beta_deg", "offset_mm"})
    if (message.has(key))
      throw InvalidInput(
          std::string(key) +
          ": only applies to sheets. For bodies, give `turn`, `axial`, `shear`, `along` or `reach_mm`");
  if (hinge.ball)
    throw InvalidInput("index: " + hinge.name + " is a spherical joint, which has no stiffness");
  const auto take = [&](const char* key, auto& value) {
    if (message.has(key)) value = message.number(key, 1 / farthest_stiffness, farthest_stiffness);
  };
  take("axial", hinge.k.axial);
  take("shear", hinge.k.shear);
  take("along", hinge.k.along);
  take("turn", hinge.k.turn);
  take("reach_mm", hinge.reach_mm);
}

model::SheetSymmetry symmetry_of(const Message& message, const Design& design) {
  const std::string name = message.has("symmetry") ? message.text("symmetry") : "none";
  if (name == "none") return {};
  const model::Structure* squares = design.structure.squares();
  if (!squares) throw InvalidInput("symmetry: only applies to sheets of squares");
  if (name == "mirror_x") return {*squares, true, false};
  if (name == "mirror_y") return {*squares, false, true};
  if (name == "rotate_2") return {*squares, true, true};
  throw InvalidInput("symmetry: must be none, mirror_x, mirror_y or rotate_2");
}

void copy_requested_fields(const Message& message, const model::HingeParameters& from,
                           model::HingeParameters& to) {
  if (message.has("t")) to.t = from.t;
  if (message.has("alpha_deg")) to.alpha = from.alpha;
  if (message.has("beta_deg")) to.beta = from.beta;
  if (message.has("offset_mm")) to.offset = from.offset;
}

/// Copies the changes to the mirrored hinges. If two changed hinges mirror each other, the first one decides.
void change_images(const std::vector<int>& hinges, const model::SheetSymmetry& symmetry,
                   const Message& message, model::Lattice& sheet) {
  const model::Structure before = *sheet.squares();
  std::set<int> listed;
  for (const int h : hinges) {
    const auto other = symmetry.image(before, h);
    if (!other || *other == h || listed.count(h) > 0) continue;
    listed.insert(*other);
    copy_requested_fields(message, symmetry.image(before, h, *other), sheet.hinge(*other));
  }
}

const model::Structure& squares_of(const Design& design) {
  if (const model::Structure* squares = design.structure.squares()) return *squares;
  throw InvalidInput("cells can be painted on a sheet of squares only");
}

/// Scales sizes of the hinge that equal the wall's thickness and height.
/// @throws InvalidInput for a hinge that does not fit into such walls and cells
void fit_to_walls(HingeSection& hinge, const model::CellSize& before, const model::CellSize& now) {
  if (!hinge.made) return;
  hinge.made = fitted(*hinge.made, before, now);
  validate(*hinge.made, now);
}

/// Replaces the cells. Other cells remove the drive; other sizes scale it with the edge.
Design with_cells(Design design, std::vector<model::Cell> cells, const model::CellSize& size) {
  const model::CellSize before = design.structure.size();
  auto [structure, from] = model::with_changed_cells(squares_of(design), std::move(cells), size);
  std::map<int, HingeSection> own;
  for (std::size_t h = 0; h < from.size(); ++h)
    if (const auto section = from[h] ? design.hinge_overrides.find(*from[h]) : design.hinge_overrides.end();
        section != design.hinge_overrides.end())
      own[static_cast<int>(h)] = section->second;
  fit_to_walls(design.hinge, before, size);
  for (auto& [h, section] : own) fit_to_walls(section, before, size);
  if (structure.cells != squares_of(design).cells) design.drive.reset();
  if (design.drive) design.drive = scaled(*design.drive, size.edge_mm / before.edge_mm);
  design.structure = std::move(structure);
  design.hinge_overrides = std::move(own);
  return design;
}

/// Applies the message to the first hinge, and to hinges on walls along its axis alternately, as exact sheets
/// require. Every second wall gets tilts of the other sign and the opposite part of the wall. Hinges along
/// the other axis get the first hinge's values.
void alternate(const model::Structure& squares, const std::vector<int>& hinges, const Message& message,
               double edge_mm, model::Lattice& sheet) {
  if (hinges.empty()) return;
  model::Hinge first = squares.hinges[hinges.front()];
  change(first.parameters, message, edge_mm);
  const std::vector<model::Hinge> before = squares.hinges;
  for (const int h : hinges) {
    const bool is_along = before[h].wall.axis == first.wall.axis;
    const model::HingeParameters now = is_along ? carried_to(before[h].wall, first) : first.parameters;
    model::HingeParameters& hinge = sheet.hinge(h);
    copy_requested_fields(message, now, hinge);
  }
}

/// Reads one `cell`, or the `cells` of a stroke.
std::vector<model::Cell> painted(const Message& message) {
  const bool many = message.has("cells");
  const std::vector<int> at = message.integers(many ? "cells" : "cell", 0, max_cells_per_side - 1);
  if (at.empty() || at.size() % 2 != 0 || (!many && at.size() != 2))
    throw InvalidInput(many ? "cells: must be [i, j, i, j, ...]" : "cell: must be [i, j]");
  std::vector<model::Cell> out;
  for (std::size_t k = 0; k < at.size(); k += 2) out.push_back({at[k], at[k + 1]});
  return out;
}

Design with_one_cell(Design design, const model::Cell& cell, bool on) {
  std::vector<model::Cell> cells = model::with_cell(squares_of(design), cell, on);
  const model::CellSize size = design.structure.size();
  return with_cells(std::move(design), std::move(cells), size);
}

std::string kind_text(const Message& message) {
  const std::string kind = message.text("kind");
  for (const char* known : {"pin", "block", "film", "rod"})
    if (kind == known) return kind;
  throw InvalidInput("kind: must be stiff, pin, block, film or rod");
}

/// Returns sizes of a made hinge that the page leaves out. A block is a little longer than thick, the range
/// where its stiffness is well known. A living hinge has two nozzle lines (0.4 mm) and twice the wall's
/// thickness as its gap. A pin is as thick as its wall, at least 1 mm. A rod has its
/// usual diameter.
std::string sizes_text(const Message& message, const model::CellSize& size) {
  const std::string kind = message.text("kind");
  if (kind == "rod") return "";
  if (kind == "pin") return fmt::format(", diameter_mm: {:.3g}", std::max(1.0, size.thickness_mm));
  const double gap = message.has("gap_mm") ? message.number("gap_mm", 0.01, size.edge_mm)
                     : kind == "block"     ? 1.25 * size.thickness_mm
                                           : 2 * size.thickness_mm;
  const std::string thickness = kind == "film" ? ", thickness_mm: 0.4" : "";
  return fmt::format(", gap_mm: {:.3g}{}", gap, thickness);
}

}  // namespace

Design with_hinges(Design design, const Message& message) {
  const std::vector<int> hinges = hinges_of(message, design.structure.hinges());
  if (const model::Assembly* imported = design.structure.assembly()) {
    model::Assembly bodies = *imported;
    for (const int h : hinges) change(bodies.hinges[h], message);
    design.structure = model::Lattice(std::move(bodies));
    design.cuts.reset();  // cuts do not determine these hinges
    return design;
  }
  const double edge_mm = design.structure.size().edge_mm;
  if (message.has("alternate") && message.boolean("alternate"))
    alternate(squares_of(design), hinges, message, edge_mm, design.structure);
  else
    for (const int h : hinges) change(design.structure.hinge(h), message, edge_mm);
  if (const model::SheetSymmetry symmetry = symmetry_of(message, design); symmetry.any())
    change_images(hinges, symmetry, message, design.structure);
  validate_hinges(design.structure);
  return with_open_joints(std::move(design));  // another turn needs other hinges
}

Design with_cell(Design design, const Message& message) {
  const bool on = message.boolean("on");
  const model::SheetSymmetry symmetry = symmetry_of(message, design);
  for (const model::Cell& cell : painted(message)) {
    design = with_one_cell(std::move(design), cell, on);
    const model::Cell image = symmetry.image(cell);
    const bool is_there = model::has_cell(squares_of(design), image);
    if (symmetry.any() && model::is_countable(image) && is_there != on)
      design = with_one_cell(std::move(design), image, on);
  }
  return design;
}

/// Scales thickness and height that have their default for the cell size; other values keep their
/// millimetres.
model::CellSize with_edge(const model::CellSize& size, double edge_mm) {
  const model::CellSize usual = default_size(size.edge_mm), now = default_size(edge_mm);
  const auto follow = [](double own, double usual_before, double usual_now) {
    return std::abs(own - usual_before) <= rounded_share * usual_before ? usual_now : own;
  };
  return {edge_mm, follow(size.thickness_mm, usual.thickness_mm, now.thickness_mm),
          follow(size.height_mm, usual.height_mm, now.height_mm)};
}

Design with_sheet(Design design, const Message& message) {
  const model::Structure& squares = squares_of(design);
  std::array<int, 2> extent = model::extent(squares);
  const bool is_new = message.has("columns") || message.has("rows");
  if (message.has("columns")) extent[0] = message.integer("columns", 1, max_cells_per_side);
  if (message.has("rows")) extent[1] = message.integer("rows", 1, max_cells_per_side);
  model::CellSize size = squares.size;
  if (message.has("cell_mm")) size = with_edge(size, message.number("cell_mm", 0.1, 1000));
  if (message.has("thickness_mm")) size.thickness_mm = message.number("thickness_mm", 0.01, 100);
  if (message.has("height_mm")) size.height_mm = message.number("height_mm", 0.01, 1000);
  std::vector<model::Cell> cells = is_new ? model::full_sheet(extent) : squares.cells;
  return with_cells(std::move(design), std::move(cells), size);
}

Design with_manufactured_hinges(Design design, const Message& message) {
  if (design.structure.assembly())
    throw InvalidInput("made: only applies to sheets. Give hinges of bodies their stiffness with `hinge`");
  design.hinge_overrides.clear();
  if (message.text("kind") == "stiff") {
    design.hinge = {};
    return design;
  }
  std::string entries = "kind: " + kind_text(message) + sizes_text(message, design.structure.size());
  if (message.has("material")) entries += ", material: " + message.text("material");
  const std::string text = fmt::format("hinge: {{{}}}\n", entries);
  const targets::Section document(targets::parse_document(text, "the studio"), only_hinge());
  design.hinge = read_hinge_section(document, design.structure.size());
  return design;
}

Design with_driven_hinge(Design design, const Message& message) {
  const model::Assembly* bodies = design.structure.assembly();
  if (!bodies) throw InvalidInput("driven: only applies to designs of bodies");
  const int hinge = message.integer("hinge", 0, static_cast<int>(bodies->hinges.size()) - 1);
  if (bodies->hinges[hinge].ball)
    throw InvalidInput("hinge: is a spherical joint, which has no axis to be turned about");
  design.drive = model::HingeTurn{hinge, 0};
  return design;
}

namespace {

constexpr std::size_t longest = 100;           // steps back: more than anybody remembers
constexpr std::size_t most_bytes = 128 << 20;  // bytes of all designs; limits the number of steps

constexpr std::size_t hinge_bytes = 56, body_bytes = 8, cell_bytes = 40;  // bytes, in a sheet of squares
constexpr std::size_t point_bytes = 24, triangle_bytes = 12;  // bytes, three doubles and three ints of a mesh

std::size_t size_of(const model::Polyhedron& solid) {
  return solid.points.size() * point_bytes + solid.triangles.size() * triangle_bytes;
}

/// Estimates the memory of a design, bytes.
std::size_t size_of(const Design& design) {
  const model::Lattice& sheet = design.structure;
  std::size_t bytes = sheet.hinges() * hinge_bytes + sheet.bodies() * body_bytes + sheet.cells() * cell_bytes;
  if (const model::Assembly* bodies = sheet.assembly()) {
    for (const model::AssemblyBody& body : bodies->bodies) bytes += size_of(body.solid);
    for (const model::AssemblyHinge& hinge : bodies->hinges) bytes += size_of(hinge.soft);
  }
  return bytes;
}

}  // namespace

DesignHistory::DesignHistory(Design first) {
  designs_.reserve(longest + 1);  // allocates now: add() needs no memory for the list
  designs_.push_back({std::move(first), 0, {}});
}

void DesignHistory::add(Design design, int thing, DesignResult design_result) {
  designs_.resize(at_ + 1);
  if (saved_ > static_cast<int>(at_)) saved_ = -1;
  designs_.push_back({std::move(design), thing, std::move(design_result)});
  std::size_t bytes = 0;
  for (const Entry& entry : designs_) bytes += size_of(entry.design);
  while (designs_.size() > longest || (bytes > most_bytes && designs_.size() > 2)) {
    bytes -= size_of(designs_.front().design);
    designs_.erase(designs_.begin());
    saved_ = std::max(saved_ - 1, -1);
  }
  at_ = designs_.size() - 1;
}

bool DesignHistory::undo() {
  if (!can_undo()) return false;
  --at_;
  return true;
}

bool DesignHistory::redo() {
  if (!can_redo()) return false;
  ++at_;
  return true;
}

}  // namespace kinetix::app::studio
