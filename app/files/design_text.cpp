#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/files/bodies_section.hpp"
#include "app/files/lattice_section.hpp"
#include "app/files/process_section.hpp"

namespace kinetix::app {
namespace {

bool is_basic(const model::HingeParameters& p) {
  const model::HingeParameters basic;
  return p.t == basic.t && p.alpha == basic.alpha && p.beta == basic.beta && p.offset == basic.offset;
}

std::string offset_text(double offset, double edge_mm) {
  return offset == 0 ? "" : ", offset_mm: " + targets::shortest_text(mm_of(offset, edge_mm));
}

std::string own_hinge_text(const Design& design, int hinge) {
  const auto own = design.own_hinges.find(hinge);
  return own == design.own_hinges.end() ? "" : ", hinge: {" + hinge_text(own->second) + "}";
}

std::string hinges_text(const Design& design) {
  const model::Sheet& structure = design.structure;
  std::string text;
  for (int h = 0; h < structure.hinges(); ++h)
    if (const model::HingeParameters& hinge = structure.hinge(h);
        !is_basic(hinge) || design.own_hinges.contains(h))
      text += fmt::format("    - {{wall: {}, t: {}, alpha_deg: {}, beta_deg: {}{}{}}}\n",
                          wall_name(structure, h), targets::shortest_text(hinge.t),
                          targets::degrees_text(hinge.alpha), targets::degrees_text(hinge.beta),
                          offset_text(hinge.offset, structure.size().edge_mm), own_hinge_text(design, h));
  if (text.empty()) return {};
  return "  hinges:  # walls that are not named have t: 0.5, alpha_deg: 90, beta_deg: 0\n" + text;
}

std::string walls_text(const model::Sheet& structure, const std::vector<int>& hinges) {
  std::string text;
  for (const int h : hinges) text += (text.empty() ? "" : ", ") + wall_name(structure, h);
  return "[" + text + "]";
}

std::string cord_text(const model::Sheet& structure, const DriveSection& cord) {
  return fmt::format("drive: {{kind: cord, through: {}, shorten_mm: {}{}",
                     walls_text(structure, cord.through), targets::shortest_text(cord.shorten_mm),
                     cord.branch ? fmt::format(", branch: {}", *cord.branch) : "");
}

std::string shape_memory_text(const model::Sheet& structure, const DriveSection& drive) {
  return fmt::format("drive: {{kind: shape_memory, angle_deg: {}, k_turn: {}{}",
                     targets::degrees_text(drive.angle), targets::shortest_text(drive.k_turn),
                     drive.springs.empty() ? "" : ", walls: " + walls_text(structure, drive.springs));
}

std::string drive_text(const model::Sheet& structure, const std::optional<DriveSection>& drive, int side) {
  const std::string aside = side == 1 ? "" : fmt::format("side: {}", side);
  const std::string end = (aside.empty() ? "" : ", " + aside) + "}\n";
  if (!drive) return aside.empty() ? "" : "drive: {" + aside + "}\n";
  if (drive->kind == DriveSection::Kind::cord) return cord_text(structure, *drive) + end;
  if (drive->kind == DriveSection::Kind::shape_memory) return shape_memory_text(structure, *drive) + end;
  if (drive->kind == DriveSection::Kind::plates)
    return fmt::format("drive: {{kind: plates, axis: {}, compression: {}{}{}{}",
                       drive->axis == model::Axis::x ? "x" : "y", targets::shortest_text(drive->compression),
                       drive->branch ? fmt::format(", branch: {}", *drive->branch) : "",
                       drive->grip ? ", grip: " + to_string(*drive->grip) : "",
                       drive->press ? ", press: true" : "") +
           end;
  return fmt::format("drive: {{kind: hinge, wall: {}, angle_deg: {}", wall_name(structure, drive->hinge),
                     targets::degrees_text(drive->angle)) +
         end;
}

std::string hinge_section_text(const HingeSection& hinge) {
  const std::string contact =
      hinge.k_contact ? ", k_contact: " + targets::shortest_text(*hinge.k_contact) : "";
  return fmt::format("hinge: {{model: {}, {}{}}}\n",
                     hinge.model == HingeSection::Model::rotary ? "rotary" : "elastic", hinge_text(hinge),
                     contact);
}

std::string physics_text(const PhysicsSection& physics) {
  const std::string text = physics_keys().text(physics);
  return text.empty() ? "" : "physics: {" + text + "}\n";
}

}  // namespace

std::string design_text(const Design& design) {
  if (design.structure.assembly()) return bodies_text(design);
  return fmt::format("kinetix: 1\nname: \"{}\"\n", design.name) + structure_text(design.structure) +
         fmt::format("design:\n  theta_deg: {}\n", targets::degrees_text(design.theta)) +
         hinges_text(design) + drive_text(design.structure, design.drive, design.side) +
         hinge_section_text(design.hinge) + physics_text(design.physics) +
         (design.process == model::processes().front() ? ""
                                                       : "process: " + process_text(design.process) + "\n");
}

}  // namespace kinetix::app
