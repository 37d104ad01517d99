#pragma once

#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>

namespace kinetix::sim {

/// Memory that the engine lays out at once for pairs of parts that are near each other, by their number: by itself it
/// takes and fills 8 MB, which costs small scenes more than their run. Pairs beyond get memory of their own.
inline btDefaultCollisionConstructionInfo collision_memory(int parts) {
  constexpr int pairs_a_part = 8;  // walls of a cell and of the cells beside it
  btDefaultCollisionConstructionInfo memory;
  memory.m_defaultMaxPersistentManifoldPoolSize = pairs_a_part * parts;
  memory.m_defaultMaxCollisionAlgorithmPoolSize = pairs_a_part * parts;
  return memory;
}

}  // namespace kinetix::sim
