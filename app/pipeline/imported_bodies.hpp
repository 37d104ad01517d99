#pragma once

#include "app/run/run.hpp"
#include "app/run/run_options.hpp"
#include "model/assembly/assembly.hpp"
#include "model/assembly/deployment.hpp"
#include "model/elastic/contact/piece_contact.hpp"
#include "sim/physics_options.hpp"
#include "sim/shapes/convex_cuts.hpp"

namespace kinetix::app {

/// Convex pieces of the bodies of an assembly, which collide in place of the bodies in the simulation and in
/// equilibrium.
struct BodyPieces {
  std::vector<std::vector<sim::CutPiece>> of_body;  ///< in the model's coordinates, mm
  std::vector<std::vector<sim::FilledBore>> bores;  ///< filled bores of each body
  double seconds = 0;                               ///< computing time, s

  std::size_t count() const;
  /// Whether the pieces suit another assembly of the same bodies: its pins have the same bores.
  bool fit(const model::Assembly& assembly) const;
};

/// Cuts the bodies into convex pieces. @param threads as in RunOptions
BodyPieces pieces_of(const model::Assembly& assembly, int threads);

/// Returns the corners of the pieces relative to the rest positions of their bodies.
sim::ContactParts contact_parts(const BodyPieces& pieces, const model::Assembly& assembly);

/// Returns the pieces with their faces, and the pairs that touch at rest according to the physics engine. The engine
/// runs, so only one thread at a time may call this.
model::ConvexBodies convex_bodies(const BodyPieces& pieces, const model::Assembly& assembly,
                                  const model::Linkage& linkage);

/// Returns the pull of a design of imported bodies, moved to where they are; empty if the drive turns a hinge.
std::optional<model::Pull> pull_of(const Design& design);

/// Rejects what the equilibrium model cannot solve: it turns one hinge, and supports only hinges with an axis.
/// @throws InvalidInput for bodies that are pulled, and for ball hinges
void require_one_axis(const model::Assembly& bodies, bool are_pulled);

/// Adds the states along the drive to a run of imported bodies: closed states or, if the plan says so, the
/// equilibrium of its elastic hinges. Its drive then names the hinge that is turned.
/// @throws InvalidInput for a drive that turns a hinge which cannot turn at rest; in equilibrium for bodies that are
/// pulled, and for hinges without an axis
Run with_closed_path(Run run, const RunOptions& options);

/// Adds the convex pieces by which the bodies of the run collide: those of the options if they fit. @pre imported
/// bodies
Run with_pieces(Run run, const RunOptions& options);

}  // namespace kinetix::app
