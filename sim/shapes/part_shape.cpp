#include "sim/shapes/part_shape.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCompoundCompoundCollisionAlgorithm.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>

#include <mutex>
#include <set>

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

/// Returns the numbers of the other pieces that a piece does not collide with; null for walls.
std::set<int>* passed_by(const btCollisionShape* piece) {
  return static_cast<std::set<int>*>(piece->getUserPointer());
}

bool may_collide(const btCollisionShape* a, const btCollisionShape* b) {
  const std::set<int>* const passes = passed_by(a);
  return a->getUserIndex() != b->getUserIndex() && !(passes && passes->contains(b->getUserIndex()));
}

const btCollisionShape* piece_of(const btCollisionObject& part, int piece) {
  return static_cast<const btCompoundShape*>(part.getCollisionShape())->getChildShape(piece);
}

}  // namespace

struct PartShape::Shapes {
  std::vector<std::unique_ptr<btConvexHullShape>> hulls;
  std::vector<std::unique_ptr<std::set<int>>> passes;
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

PartShape::PartShape(const std::vector<std::vector<Eigen::Vector3d>>& pieces, int first)
    : shapes_(std::make_unique<Shapes>()) {
  for (const auto& piece : pieces) {
    auto hull = std::make_unique<btConvexHullShape>();
    for (const Eigen::Vector3d& corner : piece) hull->addPoint({corner.x(), corner.y(), corner.z()}, false);
    hull->setMargin(margin(WallSurface::rounded));
    hull->recalcLocalAabb();
    hull->setUserIndex(first++);
    hull->setUserPointer(shapes_->passes.emplace_back(std::make_unique<std::set<int>>()).get());
    shapes_->compound.addChildShape(btTransform::getIdentity(), hull.get());
    shapes_->hulls.push_back(std::move(hull));
  }
  shapes_->compound.setMargin(margin(WallSurface::rounded));
}

void PartShape::let_pass(const btCollisionObject& a, int piece_of_a, const btCollisionObject& b,
                         int piece_of_b) {
  const btCollisionShape* const first = piece_of(a, piece_of_a);
  const btCollisionShape* const second = piece_of(b, piece_of_b);
  passed_by(first)->insert(second->getUserIndex());
  passed_by(second)->insert(first->getUserIndex());
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
