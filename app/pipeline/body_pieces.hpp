#pragma once

#include <memory>
#include <vector>

#include "model/assembly/assembly.hpp"
#include "model/contact/convex_bodies.hpp"
#include "sim/contact_parts.hpp"
#include "sim/shapes/convex_cuts.hpp"

namespace kinetix::app {

/// Convex pieces of the bodies of an assembly, by which these collide: in the physics run and in equilibrium.
struct BodyPieces {
  std::vector<std::vector<sim::CutPiece>> of_body;  ///< in the model's coordinates, mm
  std::vector<std::vector<sim::FilledBore>> bores;  ///< of each body, that were filled
  double seconds = 0;                               ///< that they took, s

  std::size_t count() const;
  /// Whether those of another assembly of the same bodies are the same: its pins have the same bores.
  bool fit(const model::Assembly& assembly) const;
};

/// @param threads as of RunOptions
BodyPieces pieces_of(const model::Assembly& assembly, int threads);

/// By their corners, about the rest positions of the bodies.
sim::ContactParts contact_parts(const BodyPieces& pieces, const model::Assembly& assembly);

/// With their faces, and the pairs that touch at rest as the physics run finds them. The engine runs: one thread at a time.
model::ConvexBodies convex_bodies(const BodyPieces& pieces, const model::Assembly& assembly,
                                  const model::Linkage& linkage);

}  // namespace kinetix::app
