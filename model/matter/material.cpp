#include "model/matter/material.hpp"

namespace kinetix::model {

const std::vector<Material>& materials() {
  static const std::vector<Material> all{
      {"tango", 1, 0.48, 0.5,
       "PolyJet rubber of Shore 27 A: E from the hardness by Gent's relation; strain well below that at "
       "break, for notches and repeated bending"},
      {"tpu95a", 26, 0.48, 0.5,
       "TPU filament of Shore 95 A: data sheets give 26 to 50 MPa, yield at half its length"},
      {"pp", 1300, 0.42, 0.1, "polypropylene film: data sheets of sheet and film; strain at yield"},
      {"pa12", 1700, 0.4, 0.04,
       "laser-sintered polyamide 12: data sheets give 1650 to 1800 MPa; strain at yield"}};
  return all;
}

const Material* find_material(std::string_view name) {
  for (const Material& material : materials())
    if (material.name == name) return &material;
  return nullptr;
}

}  // namespace kinetix::model
