#include "model/matter/material.hpp"

namespace kinetix::model {

const std::vector<Material>& materials() {
  static const std::vector<Material> all{
      {"tango", 1, 0.48, 0.5,
       "PolyJet rubber of Shore 27 A (TangoPlus FLX930 has 26 to 28): E from the hardness by A. N. Gent, On "
       "the relation "
       "between indentation hardness and Young's modulus, IRI Transactions 34, 1958, and by Ruess' lg E = "
       "0.0235 S - 0.6403 alike; nu of rubbers in "
       "general; "
       "the strain is an estimate, well below that at break, for notches and repeated bending"},
      {"tpu95a", 26, 0.48, 0.5,
       "TPU filament of Shore 95 A: D. M. Haid, O. Duncan, J. Hart, L. Foster, Characterisation of "
       "thermoplastic "
       "polyurethane for additive manufacturing, 14. Symposium der dvs-Sektion Sportinformatik und "
       "Sporttechnologie: 24 to "
       "247 MPa of four printed ones; E is of the softest, nu and the strain are estimates"},
      {"pp", 1300, 0.42, 0.1,
       "polypropylene: Modern Plastics Encyclopedia 99, 165 000 to 225 000 psi, which is 1140 to 1550 MPa; "
       "nu and the "
       "strain, a little below yield, are estimates"},
      {"pa12", 1700, 0.4, 0.04,
       "polyamide 12 of powder: Materials Technical Fact Sheet of HP 3D High Reusability PA 12, 1800 MPa, "
       "nu "
       "0.43 to 0.47, "
       "yield at 0.1; E and nu are taken a little lower; the strain is an estimate, under half of that at "
       "yield"}};
  return all;
}

const Material* find_material(std::string_view name) {
  for (const Material& material : materials())
    if (material.name == name) return &material;
  return nullptr;
}

}  // namespace kinetix::model
