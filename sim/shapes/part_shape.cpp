#include "sim/shapes/part_shape.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCompoundCompoundCollisionAlgorithm.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <cmath>
#include <mutex>
#include <set>

#include "model/contact/wall_contact.hpp"

namespace kinetix::sim {
namespace {

/// @param half of the plate, cell edges; @param slant length gained by the end at the hinge per height
Prism prism(const Eigen::Matrix3d& axes, const Eigen::Vector3d& half, double slant, double inset) {
  const double length = 2 * half.x() - inset * std::hypot(1, slant), height = half.y() - inset,
               thickness = half.z() - inset;
  Prism corners;
  int k = 0;
  for (const double h : {-height, height})
    for (const double w : {-thickness, thickness})
      for (const double u : {0.0, length + h * slant}) corners[k++] = axes * Eigen::Vector3d(u, h, w);
  return corners;
}

}  // namespace

std::vector<std::vector<WallPrism>> wall_prisms(const model::Linkage& structure, double inset) {
  std::vector<std::vector<WallPrism>> prisms(structure.bodies.size());
  const std::vector<model::HalfWall> walls = half_walls(structure);
  for (std::size_t k = 0; k < walls.size(); ++k) {
    const model::HalfWall& wall = walls[k];
    const Eigen::Vector3d half = wall.box.half / structure.size.edge_mm;
    const double slant = structure.plates[k].slant;
    prisms[wall.body].push_back({wall.hinge, prism(wall.box.axes, half, slant, inset)});
  }
  return prisms;
}

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

void PartShape::ignore_contact(const btCollisionObject& a, int piece_of_a, const btCollisionObject& b,
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

namespace {

constexpr double one_place = 0.02;  // cell edges: far below the thickness of a usual wall, 0.08

struct Uprights {
  btVector3 first, second;
};

Uprights uprights(const btPersistentManifold& manifold, const btManifoldPoint& point) {
  return {PartShape::upright(*manifold.getBody0(), point.m_index0),
          PartShape::upright(*manifold.getBody1(), point.m_index1)};
}

double distance_across(const btVector3& shift, const btVector3& upright) {
  return (shift - shift.dot(upright) * upright).length();
}

bool on_one_edge(const btManifoldPoint& a, const btManifoldPoint& b, const Uprights& up) {
  const btVector3 shift = a.getPositionWorldOnB() - b.getPositionWorldOnB();
  return std::min(distance_across(shift, up.first), distance_across(shift, up.second)) < one_place;
}

}  // namespace

void count_points_on_edges(const btPersistentManifold& manifold, PointCounts& counts) {
  for (int k = 0; k < manifold.getNumContacts(); ++k) {
    const btManifoldPoint& point = manifold.getContactPoint(k);
    const Uprights up = uprights(manifold, point);
    int count = 1;
    for (int l = 0; l < manifold.getNumContacts(); ++l) {
      const btManifoldPoint& other = manifold.getContactPoint(l);
      if (l != k && other.getDistance() < 0 && on_one_edge(point, other, up)) ++count;
    }
    counts[&point] = count;
  }
}

}  // namespace kinetix::sim
