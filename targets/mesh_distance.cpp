#include "targets/mesh_distance.hpp"

namespace kinetix {
namespace {

using Eigen::Vector3d;

/// Feet nearer than this part of the distance to the inner point are on the mesh.
constexpr double on_the_mesh = 1e-10;

/// The direction, turned to face away from the inner point; that way itself when there is no direction.
Vector3d outward(const Vector3d& direction, const Vector3d& away) {
  const double size = direction.norm();
  if (!(size > 0)) return away.normalized();
  return direction.dot(away) < 0 ? Vector3d(-direction / size) : Vector3d(direction / size);
}

}  // namespace

MeshDistance::MeshDistance(TriangleMesh mesh, const Vector3d& inside)
    : mesh_(std::move(mesh)), tree_(mesh_), inside_(inside) {}

MeshFoot MeshDistance::foot(const Vector3d& p) const {
  const NearestPlace place = tree_.nearest(p);
  const Vector3d away = place.point - inside_, offset = p - place.point;
  const double size = std::sqrt(place.squared_distance);
  MeshFoot foot;
  foot.triangle = place.triangle;
  foot.point = place.point;
  foot.distance = offset.dot(away) < 0 ? -size : size;
  foot.face_normal = outward(area_normal(mesh_, place.triangle), away);
  const bool is_on_it = !(size > on_the_mesh * away.norm());
  foot.normal = is_on_it ? foot.face_normal : Vector3d(offset / foot.distance);
  return foot;
}

}  // namespace kinetix
