#pragma once

#include <string_view>

#include "model/hinge/elasticity.hpp"
#include "model/linkage/linkage.hpp"
#include "model/linkage/state.hpp"

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

/// Kind of a manufactured hinge.
enum class HingeKind {
  pin,    ///< revolute joint: knuckles around a rod, with clearance
  block,  ///< elastomer hinge: soft material that fills the gap between two halves of a wall
  film,   ///< living hinge: a thin film that bridges the gap
  rod,    ///< pin whose rod is a separate part, printed or of wire, that is pushed through afterwards
};

/// Checks whether a hinge turns on a rod.
constexpr bool is_pin(HingeKind kind) { return kind == HingeKind::pin || kind == HingeKind::rod; }

/// Diameter of a rod that the file does not give, mm: common wire. Of steel, it is stiffer than a printed rod of 3 mm.
inline constexpr double usual_rod_mm = 1;

/// Returns "pin", "block", "film" or "rod", as in files.
std::string to_string(HingeKind kind);

/// Dimensions and material of a manufactured hinge. Elastomer and living hinges span the gap L along the
/// wall, with thickness t across it and height h along the hinge axis. A pin is a rod as high as the wall. All that
/// is stated of pins also applies to the kind rod.
struct ManufacturedHinge {
  HingeKind kind = HingeKind::block;
  Material material = {};
  double gap_mm = 0;        ///< block, film: L, > 0
  double thickness_mm = 0;  ///< block, film: t, > 0
  double height_mm = 0;     ///< h, > 0; for a pin the bearing length
  double diameter_mm = 0;   ///< pin: diameter of the rod, > 0
  double clearance_mm = 0;  ///< pin: per side, between rod and bore, >= 0
  bool with_play = false;   ///< pin: whether its energy includes the clearance
  /// Pin: whether knuckles are round caps about the middle of their walls, as large as the outermost axis
  /// needs.
  bool caps = false;

  bool operator==(const ManufacturedHinge&) const = default;
};

/// Returns the stiffness of a hinge in its frame.
///
/// Elastomer and living hinges are beams whose ends are held flat. With E' = E / (1 - nu^2), G = E / 2(1 +
/// nu), A = t h and I = h t^3 / 12:
/// - k_turn = E' I / L and k_axial = E' A / L;
/// - across the wall and along the axis, shear and bending act in series.
///
/// Three corrections extend the formulas to hinges that are no longer than thick:
/// - At the ends the material cannot contract. This shortens the hinge by 2 nu^3 t in tension and by 0.88
///   nu^3 t in bending.
/// - The free edges reduce tension by the fraction nu^2 (1 - exp(-1.7 L / h)) and bending by nu^2 (1 -
///   exp(-0.75 L / h)). So E' approaches E for long hinges of small height.
/// - Shear counts 0.86 + 0.4 nu^2 of the section across the wall, and 1 - 0.14 (1 - exp(-3.2 L / h)) along
///   the axis.
///
/// The numbers are fits to CalculiX. For L / t from 0.6 to 4, h / t from 5 to 10 and nu up to 0.48, errors
/// are within 2 % (axial, turn), 8 % (shear) and 4 % (along). Rock and twist are tension and shear with the
/// height as lever. Each has one more correction:
/// - Rock loads the edges most, so the free edges reduce it by nu^2 (1 - exp(-5.1 L / h)).
/// - Twist adds the torsion of a thin rectangle, G h t^3 / 3 (1 - 0.63 t / h) / L, times 1.2 (1 - exp(-0.4 L
///   / t)). The 1.2 is the ratio of mean square to squared mean of the twist rate. It holds for ends that do
///   not warp, where the rate follows the slope of a bent beam. A short hinge hardly twists inside.
///
/// Errors of rock and twist are within 8 % and 3 %.
///
/// A pin is a rod held in knuckles at both ends and loaded across in the middle: bending and shear in series.
/// Its shoulders are assumed to be equally stiff along the axis. About the axis it has friction only: 0.1 N
/// mm/rad, for a rod of 3 mm under 0.2 N. Clearance is not included: elasticity_of() adds it if the hinge is
/// with_play.
HingeStiffness stiffness(const ManufacturedHinge& hinge);

/// Returns half the distance of two points on the axis that resist tilting as the whole height does: h /
/// sqrt(12). For a pin with clearance it is h / 2, where the rod leaves the bore. The rod touches the bore
/// there when it tilts by clearance_tilt(). mm
double reach_mm(const ManufacturedHinge& hinge);

/// Returns the strain of an elastomer or living hinge of even curvature, t |turn| / (2 L); 0 for a pin.
/// @param turn rad
double strain(const ManufacturedHinge& hinge, double turn);
/// Returns the turn at which strain() reaches the limit of the material, rad, at most pi.
double largest_turn(const ManufacturedHinge& hinge);

/// Returns the turn, rad, at which the corners of the two halves of a wall of thickness T touch across the
/// gap: tan(phi / 2) = L / (T + 2 |offset|). pi for a pin, whose walls have round ends.
double contact_turn(const ManufacturedHinge& hinge, double wall_thickness_mm, double offset_mm);

/// Returns the clearance of a pin per side, mm; 0 for other hinges.
double play_mm(const ManufacturedHinge& hinge);
/// Returns the tilt that the clearance of a pin allows: atan(2 clearance / height), rad.
double clearance_tilt(const ManufacturedHinge& hinge);

/// Returns the largest offset from the middle of its wall at which a search places a hinge, mm. An elastomer or
/// living hinge stays between the wall's faces. Knuckles of pins may stand beside the wall, as far as two of walls
/// at a right angle do not meet.
double largest_offset_mm(const ManufacturedHinge& hinge, const CellSize& size);

/// Returns the diameter of the knuckle around a pin, mm: rod, clearance and the least wall of all processes.
double knuckle_mm(const ManufacturedHinge& pin);

/// Returns the hinge for walls of another size. Dimensions equal to the old wall's follow the new wall;
/// others are limited to it.
ManufacturedHinge fitted(ManufacturedHinge hinge, const CellSize& before, const CellSize& now);

/// Returns the elasticity of the hinge, for the elastic model and the simulation.
Elasticity elasticity_of(const ManufacturedHinge& hinge);

/// Checks a hinge against its cell. The gap must be below the cell edge and at least half the hinge's
/// thickness. The hinge must not be thicker or higher than its wall. A knuckle must not be wider than edge /
/// sqrt(2), where two in the middle of walls at a right angle meet.
/// @throws InvalidInput, naming the field as in files, its value and its range
void validate(const ManufacturedHinge& hinge, const CellSize& size);

/// Returns the stretch of an elastomer or living hinge at its upper or lower edge, half its height from the
/// middle, in mm. The larger of the two counts, in tension or compression.
double edge_stretch_mm(const Linkage& linkage, const State& state, int hinge, double height_mm);

/// Returns the largest strain of an elastomer or living hinge in a state: that of its bending, strain(), plus
/// edge_stretch_mm() / gap. 0 for a pin.
double hinge_strain(const ManufacturedHinge& made, const Linkage& linkage, const State& state, int hinge);

/// Hinge whose strain exceeds the limit of its material.
struct StrainedHinge {
  int hinge = 0;
  double strain = 0, borne = 0;  ///< dimensionless; borne: the limit of the material

  double share() const { return strain / borne; }
};

/// Returns the hinge with the largest ratio of strain to material limit, if any exceeds its limit.
/// @param made returns the dimensions of a hinge; nullptr: unknown, the hinge is skipped
std::optional<StrainedHinge> most_strained(const Linkage& linkage, const State& state,
                                           const std::function<const ManufacturedHinge*(int)>& made);

}  // namespace kinetix::model
