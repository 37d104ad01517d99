#pragma once

#include "app/print/print_format.hpp"

namespace kinetix::app {

/// All bodies of a job as one list of triangles, each body a closed surface of its own; mm.
model::Polyhedron hard_part(const PrintJob& job);
/// All blocks and films likewise; empty where there are none.
model::Polyhedron soft_part(const PrintJob& job);

}  // namespace kinetix::app
