#pragma once

#include <functional>
#include <stop_token>

#include "model/linkage/linkage_drive.hpp"
#include "sim/contact_parts.hpp"
#include "sim/physics_options.hpp"
#include "sim/physics_result.hpp"

namespace kinetix::sim {

/// What a caller may want to see of a run while it goes on. Leave empty what is not wanted.
struct PhysicsObserver {
  std::function<void(double done)> progress;  ///< share of the run, rising from 0 to 1
  std::function<void(double simulated_s, const model::State& mm)>
      frame;                       ///< from the flat state to the last one
  std::stop_token stop = {};       ///< where it asks to, the run ends as one whose time is up
  double frame_interval_s = 0.02;  ///< simulated time between frames, > 0
};

/// Compresses a structure from flat in the rigid-body engine, lets it settle, and judges what came out.
///
/// Every vertex is a rigid part, every hinge two point constraints at +- reach on its axis; no gravity, no
/// friction. The run knows nothing of the exact families: it finds the folded state from the hinges alone.
/// The drive's theta goes from 0 to its goal along tau (2 - tau), fast at first so that the bodies leave the
/// flat position on the chosen branch, at rest in the end; then the speeds are damped until nothing moves.
///
/// With elastic hinges (PhysicsOptions::elastic), the hinges pull as springs, and the turning springs relax
/// along the start motion at first and at flat in the end, so that they do not push a sheet back through
/// flat. After the drive, parts run downhill and are stopped whenever their kinetic energy falls, and then go less
/// far where steps lead past the equilibrium, until on every part the forces of hinges, drive and contacts
/// balance. The same run gives the same bits. Not thread-safe: the engine has global state, so run one at a time.
///
/// @return the last state and a status; a failure is never passed off as a result
/// @throws InvalidInput for bad options, for plates that press on a sheet, and springs
/// in one, whose hinges are not elastic; whatever a callback throws
PhysicsResult run_compression(const model::Linkage& structure, const model::LinkageDrive& drive,
                              const PhysicsOptions& options = {}, const PhysicsObserver& observer = {});

/// run_compression, with bodies that collide by these pieces instead of walls. Each is 0.002 cell edges larger to all sides.
/// @pre as many bodies as the linkage has   @throws InvalidInput as run_compression, and for elastic hinges
PhysicsResult run_with_parts(const model::Linkage& structure, const model::LinkageDrive& drive,
                             const PhysicsOptions& options, const ContactParts& parts,
                             const PhysicsObserver& observer = {});

/// Pairs of pieces that pass through each other because they touch at rest, sorted. The engine runs: one thread at a time.
std::vector<TouchingPieces> touching_pieces(const model::Linkage& structure, const ContactParts& parts);

}  // namespace kinetix::sim
