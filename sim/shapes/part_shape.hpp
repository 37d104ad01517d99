#pragma once

#include <memory>
#include <vector>

#include "sim/shapes/wall_prisms.hpp"

class btCollisionObject;
class btCollisionShape;
class btVector3;

namespace kinetix::sim {

/// Method to find where half walls touch in the engine.
enum class WallSurface {
  rounded,  ///< by the nearest points of two walls with a small margin: those of tilted walls do not jump
  sharp,    ///< by clipping touching faces, to the exact depth, even if deep: all corners of upright walls
};

/// Collision shape of one rigid part: a compound of one convex hull per half wall, which it owns.
///
/// The engine's default collision margin (0.04) is half a wall's thickness, so a small one is set. It is
/// outside the prisms. They must be inset by it for the touching surface to be that of the walls.
class PartShape {
 public:
  /// Cell edges.
  static constexpr double margin(WallSurface surface) { return surface == WallSurface::sharp ? 0 : 2e-3; }

  PartShape(const std::vector<WallPrism>& walls, WallSurface surface);
  /// Makes the shape of any convex pieces, by their corners, cell edges; each is margin() larger on all
  /// sides.
  /// @param first number of the first piece, unique among all parts of a world
  PartShape(const std::vector<std::vector<Eigen::Vector3d>>& pieces, int first);
  ~PartShape();
  PartShape(PartShape&&) noexcept;

  btCollisionShape* get() const;
  /// Lets two pieces, numbered as the engine's children of their parts, pass through each other from now on.
  static void let_pass(const btCollisionObject& a, int piece_of_a, const btCollisionObject& b,
                       int piece_of_b);

  /// Returns the direction of a half wall's height in the body's present pose, unit vector.
  /// @param part has a PartShape   @param wall index of the shape's child in the engine
  static btVector3 upright(const btCollisionObject& part, int wall);

 private:
  struct Shapes;
  std::unique_ptr<Shapes> shapes_;
};

/// Makes the engine ignore contact between the two half walls of one hinge, in every world.
void skip_walls_of_one_hinge();

}  // namespace kinetix::sim
