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
