#include "model/material/manufactured_hinge.hpp"

#include <cmath>

#include "model/base/invalid_input.hpp"
#include "model/closure/closure.hpp"

namespace kinetix::model {

const std::vector<Material>& materials() {
  static const std::vector<Material> all{
      {"tango", 1, 0.48, 0.5,
       "PolyJet rubber of Shore 27 A (TangoPlus FLX930 has 26 to 28): E from the hardness by A. N. Gent, On "
       "the relation "
       "between indentation hardness and Young's modulus, IRI Transactions 34, 1958, and Ruess' lg E = "
       "0.0235 S - 0.6403 gives the same; nu of rubbers in "
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
       "yield at 0.1; E and nu are set a little lower; the strain is an estimate, under half of that at "
       "yield"},
      {"acrylic", 2900, 0.37, 0.02,
       "cast sheet of PMMA: Lange's Handbook of Chemistry, 15th edition, table 10.2, 380 000 to 450 000 psi, "
       "which is 2620 to 3100 MPa, and 2 to 10 % elongation at break; nu is an estimate"},
      {"steel", 200000, 0.3, 0.001,
       "wire of stainless steel: EN 1993-1-4, section 2.1.3, 200 000 MPa and 0.3 of austenitic grades; the "
       "strain is that of 200 MPa, an estimate near their proof strength"}};
  return all;
}

const Material* find_material(std::string_view name) {
  for (const Material& material : materials())
    if (material.name == name) return &material;
  return nullptr;
}

namespace {

constexpr double pin_turn = 0.1;  // N mm/rad: friction 0.3 at a radius of 1.5 mm under 0.2 N
constexpr double min_wall = 0.8;  // mm: for FDM, SLA and SLS (hinges.md section 3)
// Ratio of gap to thickness. Shorter elastomer hinges bulge sideways, which the formulas here neglect.
constexpr double min_slenderness = 0.5;
constexpr double rod_shear =
    0.9;  // fraction of a round section that counts in shear (Cowper 1966, nu 0.3 to 0.5)

double in_series(double a, double b) { return 1 / (1 / a + 1 / b); }

/// Returns the factor on E' because of the free edges at the top and bottom. @param by factor on L / h,
/// fitted
double between_edges(const ManufacturedHinge& b, double by) {
  return 1 - b.material.nu * b.material.nu * (1 - std::exp(-by * b.gap_mm / b.height_mm));
}

/// Returns E' over the length that the held ends leave, MPa/mm. @param by factor on nu^3 t, fitted
double over_length(const ManufacturedHinge& b, double by) {
  const double nu = b.material.nu;
  const double length = b.gap_mm / b.thickness_mm - by * nu * nu * nu;
  return b.material.E_mpa / (1 - nu * nu) / (length * b.thickness_mm);
}

/// Returns the stiffness of shear and bending in series, for bending stiffness k_turn with parallel ends.
/// @param section fraction of the section that counts in shear
double beam_shear(const ManufacturedHinge& b, double section, double k_turn) {
  const double area = b.thickness_mm * b.height_mm;
  return in_series(section * shear_modulus(b.material) * area / b.gap_mm,
                   12 * k_turn / (b.gap_mm * b.gap_mm));
}

/// Returns the stiffness in torsion of a thin rectangular section whose ends are held flat, N mm/rad. It adds
/// to the twist by shear over the height.
double torsion(const ManufacturedHinge& b) {
  const double t = b.thickness_mm, h = b.height_mm;
  const double section = h * t * t * t / 3 * (1 - 0.63 * t / h);
  return 1.2 * (1 - std::exp(-0.4 * b.gap_mm / t)) * shear_modulus(b.material) * section / b.gap_mm;
}

HingeStiffness beam(const ManufacturedHinge& b) {
  const double t = b.thickness_mm, h = b.height_mm, nu = b.material.nu;
  HingeStiffness k;
  k.axial = t * h * over_length(b, 2) * between_edges(b, 1.7);
  k.turn = h * t * t * t / 12 * over_length(b, 0.88) * between_edges(b, 0.75);
  k.shear = beam_shear(b, 0.86 + 0.4 * nu * nu, k.turn);
  k.along = beam_shear(b, 1 - 0.14 * (1 - std::exp(-3.2 * b.gap_mm / h)), k.axial * h * h / 12);
  k.rock = t * h * h * h / 12 * over_length(b, 2) * between_edges(b, 3 * 1.7);
  k.twist = k.shear * h * h / 12 + torsion(b);
  return k;
}

HingeStiffness rod(const ManufacturedHinge& p) {
  const double d = p.diameter_mm, h = p.height_mm, area = pi / 4 * d * d, I = pi / 64 * d * d * d * d;
  const double bending = 192 * p.material.E_mpa * I / (h * h * h),
               shear = 4 * rod_shear * shear_modulus(p.material) * area / h;
  const double across = in_series(bending, shear);
  return {.axial = across, .shear = across, .along = across, .turn = pin_turn};
}

void check_up_to(const char* field, double value, double most, const char* what) {
  require(field, value, value > 0 && value <= most, "above 0 and at most " + number_text(most) + ", " + what);
}

void check(const Material& m) {
  require("E_mpa", m.E_mpa, m.E_mpa >= 1e-6 && m.E_mpa <= 1e7, "from 1e-6 to 1e7, MPa");
  require("nu", m.nu, m.nu >= 0 && m.nu < 0.5, "at least 0 and below 0.5");
  require("strain_max", m.strain_max, m.strain_max > 0 && m.strain_max <= 10, "above 0 and at most 10");
}

void check_beam(const ManufacturedHinge& b, const CellSize& size) {
  require("gap_mm", b.gap_mm, b.gap_mm > 0 && b.gap_mm < size.edge_mm,
          "above 0 and below the cell edge, " + number_text(size.edge_mm) + " mm");
  check_up_to("thickness_mm", b.thickness_mm, size.thickness_mm, "the thickness of the wall");
  const double least = min_slenderness * b.thickness_mm;
  require("gap_mm", b.gap_mm, b.gap_mm >= least,
          "at least half of the hinge's thickness, " + number_text(least) + " mm");
}

/// Returns the diameter at which two knuckles in the middle of walls at a right angle meet, mm.
double room_for_knuckles(const CellSize& size) { return size.edge_mm / std::sqrt(2.0); }

void check_pin(const ManufacturedHinge& p, const CellSize& size) {
  require("clearance_mm", p.clearance_mm, p.clearance_mm >= 0 && p.clearance_mm < size.edge_mm,
          "at least 0 and below the cell edge");
  require("clearance_mm", p.clearance_mm, !p.with_play || p.clearance_mm <= p.height_mm / 2,
          "at most half of the height of a pin with clearance");
  require("diameter_mm", p.diameter_mm, p.diameter_mm > 0, "above 0");
  const double room = room_for_knuckles(size);
  if (knuckle_mm(p) <= room) return;
  const double most = room - (knuckle_mm(p) - p.diameter_mm);
  if (!(most > 0))
    throw InvalidInput("a pin does not fit cells of " + number_text(size.edge_mm) + " mm: its clearance of " +
                       number_text(p.clearance_mm) +
                       " mm and walls of 0.8 mm leave no room for a rod next to two knuckles of one body");
  require("diameter_mm", p.diameter_mm, false,
          "at most " + number_text(most) +
              " mm: with its clearance and walls of 0.8 mm, two knuckles of one body are then next to each "
              "other");
}

}  // namespace

std::string to_string(HingeKind kind) {
  switch (kind) {
    case HingeKind::pin:
      return "pin";
    case HingeKind::block:
      return "block";
    case HingeKind::film:
      return "film";
    case HingeKind::rod:
      return "rod";
  }
  return "";
}

HingeStiffness stiffness(const ManufacturedHinge& hinge) {
  return is_pin(hinge.kind) ? rod(hinge) : beam(hinge);
}

double reach_mm(const ManufacturedHinge& hinge) {
  return hinge.with_play ? hinge.height_mm / 2 : hinge.height_mm / std::sqrt(12.0);
}

double strain(const ManufacturedHinge& b, double turn) {
  return is_pin(b.kind) ? 0 : std::abs(turn) * b.thickness_mm / (2 * b.gap_mm);
}

double largest_turn(const ManufacturedHinge& b) {
  if (is_pin(b.kind)) return pi;
  return std::min(pi, 2 * b.gap_mm * b.material.strain_max / b.thickness_mm);
}

double contact_turn(const ManufacturedHinge& b, double wall_thickness_mm, double offset_mm) {
  if (is_pin(b.kind)) return pi;
  return 2 * std::atan2(b.gap_mm, wall_thickness_mm + 2 * std::abs(offset_mm));
}

double play_mm(const ManufacturedHinge& hinge) { return is_pin(hinge.kind) ? hinge.clearance_mm : 0; }

double clearance_tilt(const ManufacturedHinge& hinge) {
  return std::atan2(2 * play_mm(hinge), hinge.height_mm);
}

double largest_offset_mm(const ManufacturedHinge& hinge, const CellSize& size) {
  if (is_pin(hinge.kind)) return std::max(0.0, (room_for_knuckles(size) - knuckle_mm(hinge)) / 2);
  return std::max(0.0, (size.thickness_mm - hinge.thickness_mm) / 2);
}

double knuckle_mm(const ManufacturedHinge& p) { return p.diameter_mm + 2 * (p.clearance_mm + min_wall); }

Elasticity elasticity_of(const ManufacturedHinge& hinge) {
  Elasticity e = elasticity_of(stiffness(hinge), reach_mm(hinge));
  if (hinge.with_play) e.play_mm = play_mm(hinge);
  return e;
}

ManufacturedHinge fitted(ManufacturedHinge hinge, const CellSize& before, const CellSize& now) {
  const auto fit = [](double& own, double wall, double new_wall) {
    own = own == wall ? new_wall : std::min(own, new_wall);
  };
  fit(hinge.height_mm, before.height_mm, now.height_mm);
  fit(hinge.thickness_mm, before.thickness_mm, now.thickness_mm);
  return hinge;
}

void validate(const ManufacturedHinge& hinge, const CellSize& size) {
  check(hinge.material);
  check_up_to("height_mm", hinge.height_mm, size.height_mm, "the height of the wall");
  if (is_pin(hinge.kind))
    check_pin(hinge, size);
  else
    check_beam(hinge, size);
}

double edge_stretch_mm(const Linkage& linkage, const State& state, int hinge, double height_mm) {
  const double edge = linkage.size.edge_mm;
  const RestHinge& h = linkage.hinges[hinge];
  const Pose &lower = state[h.lower], &upper = state[h.upper];
  const Eigen::Vector3d pulled_mm = edge * point_mismatch(h, lower, upper, edge).gap;
  const Eigen::Vector3d leant_mm = height_mm / 2 * axis_mismatch(h, lower, upper).gap;
  return std::max((pulled_mm + leant_mm).norm(), (pulled_mm - leant_mm).norm());
}

double hinge_strain(const ManufacturedHinge& made, const Linkage& linkage, const State& state, int hinge) {
  if (is_pin(made.kind)) return 0;
  return strain(made, std::abs(hinge_turn(linkage, state, hinge))) +
         edge_stretch_mm(linkage, state, hinge, made.height_mm) / made.gap_mm;
}

std::optional<StrainedHinge> most_strained(const Linkage& linkage, const State& state,
                                           const std::function<const ManufacturedHinge*(int)>& made) {
  std::optional<StrainedHinge> worst;
  for (int h = 0; h < static_cast<int>(linkage.hinges.size()); ++h) {
    const ManufacturedHinge* const hinge = made(h);
    if (!hinge) continue;
    const StrainedHinge one{h, hinge_strain(*hinge, linkage, state, h), hinge->material.strain_max};
    if (one.strain <= one.borne) continue;
    if (!worst || one.share() > worst->share()) worst = one;
  }
  return worst;
}

}  // namespace kinetix::model
