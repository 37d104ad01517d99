#include "sim/part_shape.hpp"

#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>

namespace kinetix {
namespace {

std::unique_ptr<btConvexHullShape> hull(const Prism& prism) {
  auto shape = std::make_unique<btConvexHullShape>();
  for (const Eigen::Vector3d& corner : prism) shape->addPoint({corner.x(), corner.y(), corner.z()}, false);
  shape->setMargin(PartShape::margin);
  shape->recalcLocalAabb();
  return shape;
}

}  // namespace

struct PartShape::Shapes {
  std::vector<std::unique_ptr<btConvexHullShape>> hulls;
  btCompoundShape compound;
};

PartShape::PartShape(const std::vector<Prism>& prisms) : shapes_(std::make_unique<Shapes>()) {
  for (const Prism& prism : prisms) {
    shapes_->hulls.push_back(hull(prism));
    shapes_->compound.addChildShape(btTransform::getIdentity(), shapes_->hulls.back().get());
  }
  shapes_->compound.setMargin(margin);
}

PartShape::~PartShape() = default;
PartShape::PartShape(PartShape&&) noexcept = default;

btCollisionShape* PartShape::get() const { return &shapes_->compound; }

}  // namespace kinetix
