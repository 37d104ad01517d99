#include <Eigen/Geometry>

#include "app/exports/exporters.hpp"

/// An exporter in one file: the area of every cell in the first state, mm^2, one line per cell.
namespace kinetix::app {
namespace {

double area(std::span<const int> b, const model::State& state) {
  return 0.5 * (state[b[2]].p - state[b[0]].p).cross(state[b[3]].p - state[b[1]].p).norm();
}

std::vector<NamedContent> write(const Run& run, const nlohmann::ordered_json&) {
  std::string text;
  for (int c = 0; c < run.design.structure.cells(); ++c)
    text += std::to_string(area(run.design.structure.cell_bodies(c), run.states.front().poses)) + "\n";
  return {{"areas/flat.txt", text}};
}

// Name, extensions, whether every run writes it, and the function that writes it.
const Exporter areas_export = {"areas", {"txt"}, false, write};

[[maybe_unused]] const bool exporter_registered = (add_exporter(areas_export), true);

}  // namespace
}  // namespace kinetix::app
