#include "app/studio/messages/templates.hpp"

#include "app/files/structure_section.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app::studio {
namespace {

using Squares = model::ExactDesign<double>;

constexpr double edge_mm = 10;  // per cell: fits a hand and most printers

Design design_of(const char* name, const Squares& squares) {
  Design design;
  design.name = name;
  design.structure = sheet_of(squares, default_size(edge_mm));
  return design;
}

Design panel() { return design_of("panel", Squares::basic(8, 8)); }

Design strip() {
  Squares squares = Squares::basic(12, 1);
  for (int c = 0; c < 12; ++c) squares.beta[c] = model::column_sign(c) * 20 * radians_per_degree;
  return design_of("strip", squares);
}

Design shear() {
  Squares squares = Squares::basic(8, 3);
  squares.t.assign(8, 0.35);
  return design_of("shear", squares);
}

Design crease() {
  Squares squares = Squares::basic(9, 4);
  squares.beta[4] = 45 * radians_per_degree;
  return design_of("crease", squares);
}

}  // namespace

const std::vector<Template>& templates() {
  static const std::vector<Template> all = {
      {"panel", "shrinks in both directions", panel},
      {"strip", "curls up", strip},
      {"shear", "leans over as it shrinks", shear},
      {"crease", "folds along one crease", crease},
  };
  return all;
}

Design template_design(std::string_view name) {
  std::vector<std::string_view> names;
  for (const Template& one : templates()) {
    if (one.name == name) return one.make();
    names.push_back(one.name);
  }
  throw InvalidInput("template: must be one of " + targets::joined(names));
}

}  // namespace kinetix::app::studio
