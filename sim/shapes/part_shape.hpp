#pragma once

#include <memory>
#include <vector>

#include "sim/shapes/wall_prisms.hpp"

class btCollisionObject;
class btCollisionShape;
class btVector3;

namespace kinetix::sim {

/// How the engine finds where half walls touch.
enum class WallSurface {
  rounded,  ///< by the nearest points of two walls with a small margin: those of tilted walls do not jump
  sharp,    ///< by clipping touching faces, to the exact depth, however deep: all corners of upright walls
};

/// Collision shape of one rigid part: a compound of one convex hull per half wall, which it owns.
///
/// The engine's default collision margin (0.04) is half a wall's thickness, so a small one is set. It lies
/// outside the prisms, which must be drawn in by it for the touching surface to be that of the walls.
class PartShape {
 public:
  /// Cell edges.
  static constexpr double margin(WallSurface surface) { return surface == WallSurface::sharp ? 0 : 2e-3; }

  PartShape(const std::vector<WallPrism>& walls, WallSurface surface);
  /// Of any convex pieces, by their corners, cell edges; they are margin() larger to all sides.
  /// @param first number of the first piece, once among all parts of a world
  PartShape(const std::vector<std::vector<Eigen::Vector3d>>& pieces, int first);
  ~PartShape();
  PartShape(PartShape&&) noexcept;

  btCollisionShape* get() const;
  /// From now on two pieces of parts, as the engine counts their children, pass through each other.
  static void let_pass(const btCollisionObject& a, int piece_of_a, const btCollisionObject& b,
                       int piece_of_b);

  /// Direction in which the height of a half wall runs, as placed; unit. @param part has a PartShape
  /// @param wall as the engine counts the shape's children
  static btVector3 upright(const btCollisionObject& part, int wall);

 private:
  struct Shapes;
  std::unique_ptr<Shapes> shapes_;
};

/// Tells the engine to let the two half walls of one hinge pass through each other, in every world.
void skip_walls_of_one_hinge();

}  // namespace kinetix::sim
