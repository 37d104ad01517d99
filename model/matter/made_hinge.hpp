#pragma once

#include <string>

#include "model/hinge/elasticity.hpp"
#include "model/linkage/cell_size.hpp"
#include "model/matter/material.hpp"

namespace kinetix::model {

/// How a hinge is made.
enum class HingeKind {
  pin,    ///< knuckles round a rod, with play
  block,  ///< a block of soft material that fills the gap between two halves of a wall
  film,   ///< a thin film that bridges the gap, a living hinge
};

/// "pin", "block" or "film", as files say it.
std::string to_string(HingeKind kind);

/// A hinge as made. Blocks and films span the gap L along the wall, with thickness t across it and height h along
/// the hinge's axis; a pin is a rod of the wall's height.
struct MadeHinge {
  HingeKind kind = HingeKind::block;
  Material material = {};
  double gap_mm = 0;        ///< block, film: L, > 0
  double thickness_mm = 0;  ///< block, film: t, > 0
  double height_mm = 0;     ///< h, > 0; of a pin the length that bears
  double diameter_mm = 0;   ///< pin: of the rod, > 0
  double clearance_mm = 0;  ///< pin: a side, between rod and bore, >= 0
  bool with_play = false;   ///< pin: whether its equilibrium has that play
  /// Pin: whether knuckles are round caps about the middle of their walls, as large as the furthest axis asks for.
  bool caps = false;

  bool operator==(const MadeHinge&) const = default;
};

/// What it resists with.
///
/// Blocks and films are beams whose ends are held flat, with E' = E / (1 - nu^2), G = E / 2(1 + nu), A = t h, I =
/// h t^3 / 12: k_turn = E' I / L, k_axial = E' A / L, across the wall shear and bending in series, and along the
/// axis likewise. Three corrections make them hold for blocks no longer than thick as well:
/// - the ends, where the material cannot contract, make a block shorter by 2 nu^3 t where it is pulled and by
///   0.88 nu^3 t where it is bent;
/// - its free edges take away the share nu^2 (1 - exp(-1.7 L / h)) of the pull and nu^2 (1 - exp(-0.75 L / h)) of
///   the bending, which bring E' down to E where a block is long for its height;
/// - shear across the wall counts 0.86 + 0.4 nu^2 of the section, along the axis 1 - 0.14 (1 - exp(-3.2 L / h)).
///
/// The numbers are fits to CalculiX, and within 2 % (axial, turn), 8 % (shear) and 4 % (along) of it for L / t from
/// 1 to 4, h / t from 5 to 10 and nu to 0.48; down to L / t = 0.6, too. Rocking and twist have a correction each over
/// what a pull and a shear with the lever of the height give:
/// - rocking pulls most at the edges, and has three times the share of the edges in its section: 1 - exp(-5.1 L / h);
/// - twist has besides the torsion of a thin rectangle, G h t^3 / 3 (1 - 0.63 t / h) / L, times 1.2 (1 - exp(-0.4 L /
///   t)): 1.2 is the mean square of its rate over the squared mean where the ends do not warp and the rate follows a
///   bent beam's slope; a short block hardly twists inside.
/// They are within 8 % and 3 %.
///
/// A pin is a rod held in knuckles at both ends and pulled across in the middle, bending and shear in series; its
/// shoulders are taken to hold along the axis as much. About the axis it has friction only: 0.1 N mm/rad, of a
/// rod of 3 mm that is pulled by 0.2 N. Play is not in it: elasticity_of has it where the hinge is with_play.
HingeStiffness stiffness(const MadeHinge& hinge);

/// Half distance of two points on the axis that hold a tilted hinge as its whole height does: h / sqrt(12). Of a pin
/// with play h / 2, where its rod leaves the bore: there it meets it when it tilts by tilt_play().
double reach_mm(const MadeHinge& hinge);

/// Largest strain where a block or film of even curvature has turned, t |turn| / (2 L); 0 of a pin. @param turn rad
double strain(const MadeHinge& hinge, double turn);
/// The turn at which that is what the material bears, rad, at most pi.
double largest_turn(const MadeHinge& hinge);

/// The turn at which the corners of the two halves of a wall of thickness T meet over the gap, tan(phi / 2) =
/// L / (T + 2 |offset|): of a block as thick as its wall that is L / t. pi of a pin, whose walls end round. Rad.
double contact_turn(const MadeHinge& hinge, double wall_thickness_mm, double offset_mm);

/// How far the two halves of a wall can be moved against each other before a pin bears: its clearance. mm
double play_mm(const MadeHinge& hinge);
/// Likewise tilted: atan(2 clearance / height), rad.
double tilt_play(const MadeHinge& hinge);

/// How far from the middle of its wall a hinge can be made, mm: a block or film up to the wall's face; a pin by an
/// eccentric bore in the round end of a wall that is thicker than a knuckle must be, or in a cap, where two caps in the
/// middle of walls at a right angle do not meet.
double largest_offset_mm(const MadeHinge& hinge, const CellSize& size);

/// Diameter of the knuckle around a pin: rod, clearance and the least wall that every process prints. mm
double knuckle_mm(const MadeHinge& pin);

/// The hinge for walls of another thickness and height: what was the wall's is the new wall's, and nothing is more.
MadeHinge fitted(MadeHinge hinge, const CellSize& before, const CellSize& now);

/// The hinge in the elastic model and the physics run.
Elasticity elasticity_of(const MadeHinge& hinge);

/// @throws InvalidInput, naming the field as files do, its value and its range: also for a gap as long as a cell's
/// edge, a hinge thicker or higher than its wall, a knuckle wider than edge / sqrt(2), where two in the middle of walls at a right angle meet
void validate(const MadeHinge& hinge, const CellSize& size);

}  // namespace kinetix::model
