#pragma once

#include <memory>
#include <vector>

#include "model/assembly/assembly.hpp"
#include "model/contact/convex_bodies.hpp"
#include "sim/contact_parts.hpp"
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

}  // namespace kinetix::app
