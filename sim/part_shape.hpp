#pragma once

#include <memory>
#include <vector>

#include "sim/wall_prisms.hpp"

class btCollisionShape;

namespace kinetix {

/// Collision shape of one rigid part: a compound of one convex hull per half wall, which it owns.
///
/// The engine's default collision margin (0.04) is half a wall's thickness, so a small one is set. It lies
/// outside the prisms, which must be drawn in by it for the touching surface to be that of the walls.
class PartShape {
 public:
  static constexpr double margin = 2e-3;  ///< cell edges

  explicit PartShape(const std::vector<WallPrism>& walls);
  ~PartShape();
  PartShape(PartShape&&) noexcept;

  btCollisionShape* get() const;

 private:
  struct Shapes;
  std::unique_ptr<Shapes> shapes_;
};

/// Tells the engine to let the two half walls of one hinge pass through each other, in every world.
void skip_walls_of_one_hinge();

}  // namespace kinetix
