#include "app/print/parts.hpp"

namespace kinetix::app {

model::Polyhedron hard_part(const PrintJob& job) {
  model::Polyhedron all;
  for (int b = 0; b < static_cast<int>(job.sheet.meshes.size()); ++b)
    append(placed_body(job.sheet, job.state(), b), all);
  return all;
}

model::Polyhedron soft_part(const PrintJob& job) {
  model::Polyhedron all;
  for (int h = 0; h < static_cast<int>(job.sheet.soft.size()); ++h)
    if (!job.sheet.soft[h].points.empty()) append(placed_soft(job.sheet, job.state(), h), all);
  return all;
}

}  // namespace kinetix::app
