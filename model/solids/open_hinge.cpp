#include "model/solids/open_hinge.hpp"

#include <algorithm>
#include <cmath>

#include "model/solids/hinge_shape.hpp"

namespace kinetix::model {
namespace {

// Length of a block over its thickness: below it no stiffness formula is valid
constexpr double slender = 1.25;
constexpr double more_room = 1.1;  // ratio to the length at which the corners of a wall would meet
constexpr double film_mm = 0.4;  // thickness of a film: one nozzle line; strain 0.1 over 3 mm and 90 degrees
constexpr double widest_turn = 2.8;           // rad: at half a turn corners meet for any gap
constexpr double tenth = 10;                  // gaps are whole tenths of a mm
constexpr const char* rod_material = "pa12";  // material of rods of pins
constexpr const char* strip_material = "pp";  // material of films that are separate prints

}  // namespace

MadeHinge open_hinge(HingeKind kind, const Process& process, const CellSize& size) {
  MadeHinge hinge;
  hinge.kind = kind;
  hinge.height_mm = size.height_mm;
  if (kind == HingeKind::pin) {
    hinge.material = *find_material(rod_material);
    hinge.diameter_mm = process.least_pin_mm;
    hinge.clearance_mm = process.clearance_mm;
    return hinge;
  }
  const bool film = kind == HingeKind::film;
  hinge.material = *find_material(!film                  ? process.rubber
                                  : process.film.empty() ? strip_material
                                                         : process.film);
  hinge.thickness_mm = film ? std::min(film_mm, size.thickness_mm) : size.thickness_mm;
  return hinge;
}

double open_gap_mm(const MadeHinge& hinge, double wall_mm, double offset_mm, double turn, double stretch_mm) {
  const double bounded = std::clamp(turn, -widest_turn, widest_turn),
               half = std::max(corner_room(wall_mm / 2, offset_mm, bounded),
                               corner_room(hinge.thickness_mm / 2, 0, bounded)),
               corners = more_room * (2 * half + stretch_mm),
               strain = (std::abs(turn) * hinge.thickness_mm / 2 + stretch_mm) / hinge.material.strain_max;
  return std::ceil(tenth * std::max({slender * hinge.thickness_mm, corners, strain})) / tenth;
}

}  // namespace kinetix::model
