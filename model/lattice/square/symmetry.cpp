#include "model/lattice/square/symmetry.hpp"

#include <algorithm>

namespace kinetix::model {
namespace {

Vertex image(Vertex v, PlaneMotion motion, Vertex corner) {
  switch (motion) {
    case PlaneMotion::mirror_x:
      return {corner.i - v.i, v.j};
    case PlaneMotion::mirror_y:
      return {v.i, corner.j - v.j};
    case PlaneMotion::half_turn:
      return {corner.i - v.i, corner.j - v.j};
    case PlaneMotion::quarter_turn:
      return {corner.j - v.j, v.i};
    case PlaneMotion::none:
      break;
  }
  return v;
}

}  // namespace

WallImage image(const Structure& panel, const Hinge& hinge, PlaneMotion motion) {
  const Vertex corner = panel.bodies.back();
  const Vertex from = image(hinge.wall.from, motion, corner), to = image(hinge.wall.to(), motion, corner);
  const Vertex low = std::min(from, to);
  return {*panel.hinge_at({low, from.j == to.j ? Axis::x : Axis::y}), low != from};
}

}  // namespace kinetix::model
