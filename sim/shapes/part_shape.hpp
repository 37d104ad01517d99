#pragma once

#include <memory>
#include <unordered_map>

#include "model/linkage/linkage.hpp"

namespace kinetix::sim {

/// Corners of a convex prism; cell edges, in the frame of its body (rest orientation, origin on the vertex).
using Prism = std::array<Eigen::Vector3d, 8>;

/// Half wall as a collision shape.
struct WallPrism {
  int hinge = 0;  ///< index of the hinge at its end
  Prism prism;
};

/// Returns the half walls of each body (model/contact/wall_contact.hpp), with the end at the hinge cut along the
/// hinge axis: slanted unless alpha is 90 deg.
/// @param inset distance by which the faces are moved inwards, except the one at the vertex; cell edges,
/// below half the thickness
std::vector<std::vector<WallPrism>> wall_prisms(const model::Linkage& structure, double inset = 0);

}  // namespace kinetix::sim

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
  static void ignore_contact(const btCollisionObject& a, int piece_of_a, const btCollisionObject& b,
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

class btPersistentManifold;

namespace kinetix::sim {

using PointCounts = std::unordered_map<const void*, int>;

/// Counts the engine's points on each wall tip edge that presses along its height, by point. Two or more
/// points of an edge share the stiffness of one contact. @pre the manifold is of two PartShapes
void count_points_on_edges(const btPersistentManifold& manifold, PointCounts& counts);

}  // namespace kinetix::sim
