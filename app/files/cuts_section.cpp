#include "app/files/cuts_section.hpp"

#include <fmt/format.h>
#include <limits>

#include "app/files/drawing_section.hpp"
#include "app/files/process_section.hpp"
#include "model/assembly/assembly.hpp"
#include "targets/document/number.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double bridge_reach =
    0.18;                           // cell edges, half distance of a hinge's points, as for hinges of sheets
constexpr double pulled_apart = 3;  // times: no sheet opens that far, so pieces move as far as they can
// Ratio of a bridge's length to its width at least (joint_hinge).
constexpr double short_bridge = 0.5;

constexpr double least_kerf_mm = 0.01;  // mm: narrower cuts separate no pieces

// mm: from the finest cut to the largest sheet.
const targets::Bounds bridge_bounds = targets::from_to(0.01, 20'000, "mm");

Vector3d in_sheet(const Vector2d& p, double height = 0) { return {p.x(), p.y(), height}; }

/// Returns the part of the sheet between two pieces: a bridge, or the strip of a crease.
model::Polyhedron joint_solid(const targets::SheetJoint& joint, const model::Process& process) {
  const Vector2d along = (joint.to - joint.from).normalized(), inwards = process.kerf_mm / 2 * along,
                 across(-inwards.y(), inwards.x());
  const Vector2d from = joint.from + inwards, to = joint.to - inwards;
  const model::FlatRing ring = joint.is_crease
                                   ? model::FlatRing{from - across, to - across, to + across, from + across}
                                   : targets::bridge_outline(joint.from, joint.to, process.kerf_mm);
  return model::make_prism(std::vector<model::FlatRing>{ring}, -process.sheet_mm / 2, process.sheet_mm / 2);
}

model::AssemblyHinge sheet_hinge(const targets::SheetJoint& joint, int number, const model::Assembly& bodies,
                                 const model::Process& process) {
  model::AssemblyHinge hinge{.name = fmt::format("{}_{}", joint.is_crease ? "crease" : "bridge", number),
                             .lower = joint.lower,
                             .upper = joint.upper,
                             .point = in_sheet((joint.from + joint.to) / 2)};
  const Vector2d along = (joint.to - joint.from).normalized();
  hinge.axis = joint.is_crease ? in_sheet(along) : Vector3d(Vector3d::UnitZ());
  const Vector3d across(-along.y(), along.x(), 0);
  const double sense = across.dot(bodies.bodies[joint.upper].position - bodies.bodies[joint.lower].position);
  hinge.along = sense < 0 ? Vector3d(-across) : across;
  hinge.soft = joint_solid(joint, process);
  const model::ManufacturedHinge made = joint_hinge(joint, process);
  hinge.kind = made.kind;
  if (!joint.is_crease) hinge.k = stiffness(made);
  return hinge;
}

/// Makes prisms of the pieces, half of the sheet to each side of the plane z = 0, and hinges of what joins them.
model::Assembly assembly_of_cuts(const targets::CutSheet& sheet, const model::Process& process) {
  model::Assembly out;
  for (const auto& piece : sheet.pieces) {
    model::Polyhedron solid = model::make_prism(piece, -process.sheet_mm / 2, process.sheet_mm / 2);
    const Vector3d center = model::mass_properties(solid).center;
    out.bodies.push_back({fmt::format("piece_{}", out.bodies.size() + 1), center, std::move(solid)});
  }
  for (const targets::SheetJoint& joint : sheet.joints)
    out.hinges.push_back(sheet_hinge(joint, static_cast<int>(out.hinges.size()) + 1, out, process));
  out.edge_mm = hinge_distance(out);
  for (model::AssemblyHinge& hinge : out.hinges) hinge.reach_mm = bridge_reach * out.edge_mm;
  return out;
}

model::Process cutting_process(const targets::Section& root) {
  const auto given = root.optional("process");
  if (!given) return *model::find_process("laser");
  model::Process process = read_process(root);
  if (!process.cuts_sheets())
    throw given->key_error(
        fmt::format("{} prints, and a sheet with cuts is cut. Give `laser`, or a section with `base: laser`",
                    process.name));
  if (!(process.kerf_mm >= least_kerf_mm))
    throw given->error(fmt::format("kerf_mm is {:g} mm. Give {:g} mm or more, the width of the cuts",
                                   process.kerf_mm, least_kerf_mm));
  return process;
}

/// Returns the number in AutoCAD's index of the colours that have a meaning; 7 is black or white.
int colour_index(int colour) {
  switch (colour) {
    case 0xFF0000:
      return 1;
    case 0xFFFF00:
      return 2;
    case 0x00FF00:
      return 3;
    case 0x0000FF:
      return 5;
    case 0xFF00FF:
      return 6;
    default:
      return 7;
  }
}

}  // namespace

const targets::KeyTable& cuts_keys() {
  static const targets::KeyTable keys([] {
    std::vector<targets::Key> all = {
        {"cuts", value::text("path of a DXF or SVG file, from the folder of the design"), targets::needed,
         "drawing whose visible lines are cuts in a sheet. The line that encloses all others is its outline. "
         "Pieces between cuts are bodies, and bridges between the ends of cuts are hinges. Without "
         "`process`, a laser cuts it"},
        {"bridge_mm", value::number(bridge_bounds), targets::otherwise("half of the median cut"),
         "for `cuts`: largest gap between a cut's end and another line that is a bridge"}};
    for (targets::Key& key : drawing_size_keys()) all.push_back(std::move(key));
    return all;
  }());
  return keys;
}

void read_cuts(const targets::Section& root, Design& design) {
  const targets::Section structure(root.required("structure", "a section"), cuts_keys());
  design.process = cutting_process(root);
  targets::DrawnWalls drawn = examine_drawn_structure(structure);
  if (drawn.fault) throw InvalidInput(*drawn.fault);
  targets::CutSettings settings{.kerf_mm = design.process.kerf_mm};
  structure.read("bridge_mm", settings.bridge_mm);
  structure.read("join_mm", settings.join_mm);
  try {
    const targets::CutSheet sheet = targets::make_cut_sheet(std::move(drawn.lines), settings);
    design.structure = model::Lattice(assembly_of_cuts(sheet, design.process));
    design.cuts = std::make_shared<const targets::CutSheet>(sheet);
  } catch (const InvalidInput& e) {
    if (!e.place().file.empty()) throw;
    throw InvalidInput(e.reason(), {drawn.file});
  }
  design.drive = model::BodyPull{.expand = pulled_apart};
}

model::ManufacturedHinge joint_hinge(const targets::SheetJoint& joint, const model::Process& process) {
  const double width = joint.length() - process.kerf_mm;
  return {.kind = joint.is_crease ? model::HingeKind::pin : model::HingeKind::film,
          .material = *model::find_material(process.film),
          .gap_mm = std::max(process.kerf_mm, short_bridge * width),
          .thickness_mm = width,
          .height_mm = process.sheet_mm,
          .diameter_mm = 1};
}

std::string cuts_text(const Design& design) {
  return fmt::format("structure:\n  cuts: {}\n  bridge_mm: {}\n  join_mm: {}\nprocess: {}\n",
                     cuts_file(design).name, targets::shortest_text(design.cuts->bridge_mm),
                     targets::shortest_text(design.cuts->join_mm), process_text(design.process));
}

NamedContent cuts_file(const Design& design) {
  using targets::shortest_text;
  std::string out = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";  // mm
  for (const targets::DrawnLine& line : design.cuts->lines)
    out += fmt::format("0\nLINE\n8\n0\n62\n{}\n10\n{}\n20\n{}\n11\n{}\n21\n{}\n", colour_index(line.colour),
                       shortest_text(line.from.x()), shortest_text(line.from.y()), shortest_text(line.to.x()),
                       shortest_text(line.to.y()));
  return {design.name + "_cuts.dxf", out + "0\nENDSEC\n0\nEOF\n"};
}

std::string describe_cuts(const targets::CutSheet& sheet, double kerf_mm) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  int creases = 0;
  for (const targets::SheetJoint& joint : sheet.joints) {
    creases += joint.is_crease ? 1 : 0;
    if (joint.is_crease) continue;
    least = std::min(least, joint.length() - kerf_mm);
    most = std::max(most, joint.length() - kerf_mm);
  }
  const int bridges = static_cast<int>(sheet.joints.size()) - creases;
  std::string out = fmt::format("{} pieces", sheet.pieces.size());
  if (bridges > 0)
    out += fmt::format(", {} bridges {:.3g} to {:.3g} mm wide after the cut", bridges, least, most);
  if (creases > 0) out += fmt::format(", {} creases", creases);
  if (sheet.loose > 0) out += fmt::format("; {} loose pieces are not part of it", sheet.loose);
  if (!sheet.is_outlined) out += "; no line encloses all others, so a rectangle is the outline";
  return out;
}

}  // namespace kinetix::app
