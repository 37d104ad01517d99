#pragma once

#include <cmath>
#include <vector>

#include "model/elastic/path/stable_states.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/square/unit_laws.hpp"
#include "model/material/manufactured_hinge.hpp"
#include "tests/support/needed_play.hpp"

/// The paper's twist unit as it was printed (section 5.1): a cell of 30 mm, walls 2 mm thick, with clearance in its
/// pins. Values that the paper does not state are assumed: walls 6 mm high, and rods of 1 mm in a plastic of 2.5 GPa.
namespace kinetix::testing {

constexpr double twist_unit_modulus = 2500;  // MPa: data sheets of VeroBlack, 2000 to 3000
// N mm/rad: next to nothing, so that barriers are those of stretch alone.
constexpr double twist_unit_turn = 1e-4;

inline model::Structure paper_twist_unit(double alpha) {
  model::Structure s = make_structure(model::rectangle(1, 1), {30, 2, 6});
  const model::CellTuple unit{.A_in = {pi / 2, alpha, pi / 2, alpha}};
  apply_pattern(s, unit, unit, model::SharedWalls::must_agree);
  return s;
}

/// Returns pins that resist stretch alone. @param stiffer factor on the modulus
inline model::Elasticity played_pins(const model::Structure& unit, double play_mm, double stiffer = 1) {
  model::Elasticity pins = elasticity_of(model::ManufacturedHinge{
      .kind = model::HingeKind::pin,
      .material = {.E_mpa = stiffer * twist_unit_modulus, .nu = 0.35, .strain_max = 0.1},
      .height_mm = unit.size.height_mm,
      .diameter_mm = 1,
      .clearance_mm = play_mm,
      .with_play = true});
  pins.k_turn = twist_unit_turn;
  return pins;
}

/// Returns the drive of an upright hinge to the side on which the unit flips. @param theta rad; pi / 4: to where it is
/// twisted
inline model::DrivenLinkage flipping(const model::Structure& unit, double theta = pi / 4) {
  return driven(unit, search_drives(unit, theta)).back();
}

inline model::EquilibriumPathOptions flip_options() {
  model::EquilibriumPathOptions options;
  options.contact = false;
  options.longest_jump = 0.5;  // rad: within its play a hinge falls from one side of its bore to the other
  return options;
}

/// Returns the largest energy on the path from flat to twisted, N mm. It is that of the summit, or of the path's states
/// if there is no summit. NaN if the path neither gets there nor falls into the valley beyond a summit.
inline double flip_barrier(double alpha, double play_mm, double stiffer = 1) {
  const model::Structure unit = paper_twist_unit(alpha);
  const model::DrivenLinkage flip = flipping(unit);
  const model::Elasticity pins = played_pins(unit, play_mm, stiffer);
  model::EnergyTurns turns(flip.drive);
  double most = 0;
  const model::EquilibriumPath path = trace_equilibrium(
      flip, pins, flip_options(), [&](const model::EquilibriumStep& step, const model::State& state) {
        turns.see(step, state);
        most = std::max(most, step.energy);
      });
  const bool fell = path.steps.back().energy < 0.01 * most && std::abs(path.theta) > pi / 8;
  if (path.stop != model::EquilibriumPath::Stop::reached && !fell) return NAN;
  for (const model::EnergyTurn& turn : turns.turns())
    if (turn.maximum)
      most = std::max(most, energy_summit(unit, pins, flip.drive, flip_options(), turn).energy);
  return most;
}

/// Returns the clearance that the flip needs if nothing yields, by geometry (needed_play), mm.
inline LeastGap::Bracket flip_play(double alpha) {
  const model::Structure unit = paper_twist_unit(alpha);
  const model::DrivenLinkage flip = flipping(unit);
  std::vector<double> turns;  // to a right angle, where the unit is twisted
  const double side = flip.drive.angle > 0 ? 1 : -1;
  for (int k = 1; k <= 100; ++k) turns.push_back(side * pi / 200 * k);
  return needed_play(flip.linkage, played_pins(unit, 0).reach_mm / unit.size.edge_mm, flip.drive.hinge,
                     turns);
}

/// Returns the clearance at which the barrier of two clearances extrapolates to 0, mm. The barrier grows as the square
/// of the missing clearance.
inline double vanishing_play(double alpha, double play_mm, double more_mm) {
  const double a = std::sqrt(flip_barrier(alpha, play_mm)), b = std::sqrt(flip_barrier(alpha, more_mm));
  return (a * more_mm - b * play_mm) / (a - b);
}

}  // namespace kinetix::testing
