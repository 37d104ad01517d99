#include "app/print/parts.hpp"

namespace kinetix::app {
namespace {

/// As files hold places: all formats, and the volume that is said of them, are of the same corners.
model::Polyhedron in_floats(model::Polyhedron solid) {
  // Number by number: Eigen 3.4 takes two casts of a vector in one expression for none.
  for (Eigen::Vector3d& p : solid.points)
    for (double& x : p) x = static_cast<float>(x);
  return solid;
}

}  // namespace

model::Polyhedron hard_part(const PrintJob& job) {
  model::Polyhedron all;
  for (int b = 0; b < static_cast<int>(job.sheet.meshes.size()); ++b)
    append(placed_body(job.sheet, job.state(), b), all);
  return in_floats(std::move(all));
}

model::Polyhedron soft_part(const PrintJob& job) {
  model::Polyhedron all;
  for (int h = 0; h < static_cast<int>(job.sheet.soft.size()); ++h)
    if (!job.sheet.soft[h].points.empty()) append(placed_soft(job.sheet, job.state(), h), all);
  return in_floats(std::move(all));
}

}  // namespace kinetix::app
