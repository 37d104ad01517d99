#pragma once

#include <stop_token>

#include "model/assembly/deployment.hpp"
#include "model/linkage/linkage_drive.hpp"
#include "model/linkage/state.hpp"
#include "sim/physics_options.hpp"
#include "sim/physics_result.hpp"

namespace kinetix::sim {

/// Returns the first-order motion of the flat structure nearest to planar folding: sublattice A turning about
/// z at unit speed, sublattice B at minus that. Bodies started in this way leave flat on the branch of
/// positive theta without a jolt. Spins alone would not do for a long strip, whose tilted walls must lift its
/// far end at once.
/// @return one twist per body, v in cell edges; the bare spins if the structure has no first-order motion
/// near them
std::vector<model::Twist> start_motion(const model::Linkage& structure);

/// Adds a random motion to each body's: up to `by` in each direction, rad and cell edges. If planar, only
/// turns about z and shifts in the plane. The same seed gives the same motion.
void disturb(std::vector<model::Twist>& motion, double by, unsigned seed, bool planar);

/// Callbacks of a run in progress. Unused ones stay empty.
struct PhysicsObserver {
  std::function<void(double done)> progress;  ///< share of the run, rising from 0 to 1
  std::function<void(double simulated_s, const model::State& mm)>
      frame;                       ///< from the flat state to the last one
  std::stop_token stop = {};       ///< on request, the run ends as if its time were up
  double frame_interval_s = 0.02;  ///< simulated time between frames, > 0
};

/// Compresses a structure from flat in the rigid-body engine, lets it settle, and checks the result.
///
/// Every vertex is a rigid part, every hinge two point constraints at +- reach on its axis; no gravity, no
/// friction. The exact families are not used: the folded state follows from the hinges alone. The drive's
/// theta goes from 0 to its goal along tau (2 - tau). It is fast at first so that the bodies leave the flat
/// position on the chosen branch, and at rest in the end. Then the speeds are damped until nothing moves.
///
/// Elastic hinges (PhysicsOptions::elastic) pull as springs. The turning springs relax along the start motion
/// at first and at flat in the end, so they do not push a sheet back through flat. After the drive, parts
/// move downhill and are stopped whenever their kinetic energy decreases. Their steps become shorter if they
/// pass the equilibrium. The run ends when the forces of hinges, drive and contacts balance on every part.
/// A repeated run gives the same bits. Not thread-safe: the engine has global state, so run one at a time.
///
/// @return the last state and a status; a failed run is never reported as settled.
/// @throws InvalidInput for bad options, for plates that press and springs on a sheet without elastic hinges,
/// and anything that a callback throws
PhysicsResult run_compression(const model::Linkage& structure, const model::LinkageDrive& drive,
                              const PhysicsOptions& options = {}, const PhysicsObserver& observer = {});

/// Works like run_compression with bodies that collide by these pieces instead of walls. Each piece is
/// enlarged by 0.002 cell edges on all sides.
/// @pre as many bodies as the linkage has   @throws InvalidInput as run_compression, and for elastic hinges
PhysicsResult run_with_parts(const model::Linkage& structure, const model::LinkageDrive& drive,
                             const PhysicsOptions& options, const ContactParts& parts,
                             const PhysicsObserver& observer = {});

/// Returns the pairs of pieces that pass through each other because they touch at rest, sorted. Uses the
/// engine: one thread at a time.
std::vector<TouchingPieces> touching_pieces(const model::Linkage& structure, const ContactParts& parts);

/// Pulls every body of a structure towards its own target in the engine until nothing moves. Springs act at
/// pull_points(), with rigid hinges and contact. Their targets move from rest to the pull as the drive of a
/// compression run does. The run uses the hinges only, not the closed states.
/// @return as run_compression; there is no drive, so no drive_missed
/// @throws InvalidInput as run_with_parts
PhysicsResult run_pull(const model::Linkage& structure, const model::Pull& pull,
                       const PhysicsOptions& options, const ContactParts& parts,
                       const PhysicsObserver& observer = {});

}  // namespace kinetix::sim
