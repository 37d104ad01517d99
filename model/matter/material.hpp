#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kinetix::model {

/// Material of hinges, linear and isotropic. The moduli of printed plastics and rubbers scatter by 30 % and
/// more.
struct Material {
  std::string name = {};    ///< as in files; empty for a custom material
  double E_mpa = 1;         ///< Young's modulus, MPa, > 0
  double nu = 0.45;         ///< Poisson's ratio, [0, 0.5)
  double strain_max = 0.5;  ///< largest strain that it withstands repeatedly, > 0
  std::string source = {};  ///< source of the numbers

  bool operator==(const Material& other) const {
    return name == other.name && E_mpa == other.E_mpa && nu == other.nu && strain_max == other.strain_max;
  }
};

/// Returns the materials that have a name.
const std::vector<Material>& materials();
/// Finds a material by name. @return null for an unknown name
const Material* find_material(std::string_view name);

/// Returns the shear modulus of an isotropic material, MPa.
inline double shear_modulus(const Material& m) { return m.E_mpa / (2 * (1 + m.nu)); }

}  // namespace kinetix::model
