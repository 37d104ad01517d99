#include "sim/part_shape.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCompoundCompoundCollisionAlgorithm.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>

#include <mutex>

namespace kinetix::sim {
namespace {

std::unique_ptr<btConvexHullShape> hull(const Prism& prism, WallSurface surface) {
  auto shape = std::make_unique<btConvexHullShape>();
  for (const Eigen::Vector3d& corner : prism) shape->addPoint({corner.x(), corner.y(), corner.z()}, false);
  shape->setMargin(PartShape::margin(surface));
  shape->recalcLocalAabb();
  if (surface == WallSurface::sharp) shape->initializePolyhedralFeatures();
  return shape;
}

bool may_collide(const btCollisionShape* a, const btCollisionShape* b) {
  return a->getUserIndex() != b->getUserIndex();
}

}  // namespace

struct PartShape::Shapes {
  std::vector<std::unique_ptr<btConvexHullShape>> hulls;
  btCompoundShape compound;
};

PartShape::PartShape(const std::vector<WallPrism>& walls, WallSurface surface)
    : shapes_(std::make_unique<Shapes>()) {
  for (const WallPrism& wall : walls) {
    shapes_->hulls.push_back(hull(wall.prism, surface));
    shapes_->hulls.back()->setUserIndex(wall.hinge);
    shapes_->compound.addChildShape(btTransform::getIdentity(), shapes_->hulls.back().get());
  }
  shapes_->compound.setMargin(margin(surface));
}

PartShape::~PartShape() = default;
PartShape::PartShape(PartShape&&) noexcept = default;

btCollisionShape* PartShape::get() const { return &shapes_->compound; }

btVector3 PartShape::upright(const btCollisionObject& part, int wall) {
  const auto& compound = static_cast<const btCompoundShape&>(*part.getCollisionShape());
  const auto& hull = static_cast<const btConvexHullShape&>(*compound.getChildShape(wall));
  const btVector3* const corners = hull.getUnscaledPoints();
  return part.getWorldTransform().getBasis() * (corners[4] - corners[0]).normalized();
}

void skip_walls_of_one_hinge() {
  static std::once_flag once;
  std::call_once(once, [] { gCompoundCompoundChildShapePairCallback = may_collide; });
}

}  // namespace kinetix::sim
