#include "sim/shapes/wall_tip_edges.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <algorithm>

#include "sim/shapes/part_shape.hpp"

namespace kinetix::sim {
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
