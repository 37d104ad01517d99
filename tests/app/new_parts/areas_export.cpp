#include <Eigen/Geometry>

#include "app/exports/registry.hpp"

/// An exporter in one file: the area of every cell in the first state, mm^2, a line each.
namespace kinetix::app {
namespace {

double area(const model::CellHinges& cell, const model::State& state) {
  const auto& b = cell.bodies;
  return 0.5 * (state[b[2]].p - state[b[0]].p).cross(state[b[3]].p - state[b[1]].p).norm();
}

std::vector<NamedContent> write(const Run& run) {
  std::string text;
  for (const model::CellHinges& cell : run.structure.cell_members)
    text += std::to_string(area(cell, run.states.front().poses)) + "\n";
  return {{"areas/flat.txt", text}};
}

// Name, extensions, whether every run writes it, and how.
const Exporter areas_export = {"areas", {"txt"}, false, write};

[[maybe_unused]] const bool registered = (add_exporter(areas_export), true);

}  // namespace
}  // namespace kinetix::app
