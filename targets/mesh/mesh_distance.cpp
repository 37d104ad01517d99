#include "targets/mesh/mesh_distance.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;

/// Largest distance of a closest point on the mesh, as a fraction of the distance to the inner point. For nearer
/// points the direction to them would be that of rounding errors.
constexpr double on_the_mesh = 1e-10;

/// Returns the unit vector along the direction, turned to face away from the inner point; along `away` for a zero
/// direction.
Vector3d outward(const Vector3d& direction, const Vector3d& away) {
  const double size = direction.norm();
  if (!(size > 0)) return away.normalized();
  return direction.dot(away) < 0 ? Vector3d(-direction / size) : Vector3d(direction / size);
}

}  // namespace

MeshDistance::MeshDistance(TriangleMesh mesh, const Vector3d& inside)
    : mesh_(std::move(mesh)), tree_(mesh_), inside_(inside) {}

ClosestMeshPoint MeshDistance::closest(const Vector3d& p) const {
  const NearestPlace place = tree_.nearest(p);
  const Vector3d away = place.point - inside_, offset = p - place.point;
  const double size = std::sqrt(place.squared_distance);
  ClosestMeshPoint closest;
  closest.triangle = place.triangle;
  closest.point = place.point;
  closest.distance = offset.dot(away) < 0 ? -size : size;
  closest.face_normal = outward(area_normal(mesh_, place.triangle), away);
  const bool is_on_it = !(size > on_the_mesh * away.norm());
  closest.normal = is_on_it ? closest.face_normal : Vector3d(offset / closest.distance);
  return closest;
}

}  // namespace kinetix::targets
