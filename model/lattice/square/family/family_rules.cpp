#include "model/lattice/square/family/family_rules.hpp"

#include <cmath>

namespace kinetix::model {

const char* broken_rule(Family family, Axis axis, double t, double beta, double tolerance) {
  const bool along_x = axis == Axis::x;
  const bool halved = std::abs(t - 0.5) <= tolerance, upright = std::abs(beta) <= tolerance;
  if (family == Family::F1) return upright ? nullptr : "planar motion (F1) needs beta = 0";
  if (!along_x && !halved) return "a bending sheet needs t = 1/2 on the walls along its rows";
  if (family == Family::F2 && !along_x && !upright)
    return "a cylindrical sheet (F2) needs beta = 0 on the walls along its rows";
  if (along_x && !halved && (family == Family::F3 || !upright)) return "a bending column needs t = 1/2";
  return nullptr;
}

}  // namespace kinetix::model
