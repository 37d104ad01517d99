#include "targets/helmet/walls_inside.hpp"

#include "model/linkage/half_wall.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;

void add_corners(const OrientedBox& box, const MeshSolid& solid, WallsInside& found) {
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d side(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const double distance = solid.distance(box.center + box.axes * side.cwiseProduct(box.half));
    if (!(distance < 0)) continue;
    ++found.corners;
    found.depth_mm = std::max(found.depth_mm, -distance);
  }
}

/// Whether each plate meets the solid. The plates of a body hang together at its vertex: where none of them
/// meets the skin, all lie on one side of it.
std::vector<bool> which_meet(const std::vector<model::HalfWall>& plates, const model::State& state,
                             const MeshSolid& solid) {
  std::vector<bool> meets(plates.size()), is_cut(state.size(), false), is_within(state.size(), false);
  for (std::size_t k = 0; k < plates.size(); ++k) {
    meets[k] = solid.tree().touches(placed(plates[k], state[plates[k].body]));
    if (meets[k]) is_cut[plates[k].body] = true;
  }
  for (std::size_t b = 0; b < state.size(); ++b) is_within[b] = !is_cut[b] && solid.contains(state[b].p);
  for (std::size_t k = 0; k < plates.size(); ++k) {
    const int body = plates[k].body;
    if (!meets[k])
      meets[k] = is_cut[body] ? solid.contains(placed(plates[k], state[body]).center) : is_within[body];
  }
  return meets;
}

}  // namespace

WallsInside walls_inside(const model::Linkage& structure, const model::State& state, const MeshSolid& solid) {
  WallsInside found;
  const std::vector<model::HalfWall> plates = half_walls(structure);
  const std::vector<bool> meets = which_meet(plates, state, solid);
  for (std::size_t k = 0; k < plates.size(); ++k) {
    if (!meets[k]) continue;
    const model::HalfWall& half = plates[k];
    const OrientedBox box = placed(half, state[half.body]);
    if (found.hinges.empty() || found.hinges.back() != half.hinge) found.hinges.push_back(half.hinge);
    add_corners(box, solid, found);
  }
  return found;
}

}  // namespace kinetix::targets
