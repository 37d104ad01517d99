#include "app/goals/outline/outline_search.hpp"

#include <cmath>

#include "model/base/box.hpp"
#include "model/lattice/planar/regular_lattices.hpp"
#include "optim/outline/fit_outline.hpp"

namespace kinetix::app {
namespace {

constexpr double as_drawn = 1e-9;  // rad: smaller angles do not turn the outline
// Ratio: a boundary along the walls of larger cells contains the smaller cells whose middle is on it.
constexpr double inwards = 0.999;

std::pair<const model::PlanarLattice*, double> lattice_of(const OutlineFile& file) {
  return file.lattice.lattice ? std::pair(file.lattice.lattice, file.lattice.angle)
                              : std::pair(&model::rhombus_lattice, pi / 2);
}

}  // namespace

double edge_of(const OutlineFile& file, const Cells& cells) {
  if (file.cell_mm) return *file.cell_mm;
  const model::PlanarStructure panel = planar_structure(make_sheet(file.lattice, cells, {1, 0.1, 1}));
  double area = 0;
  for (const model::GraphFace& face : panel.faces)
    area += signed_area(face.vertices.size(),
                        [&](std::size_t k) { return panel.graph.vertices[face.vertices[k]]; });
  if (file.flat) return std::sqrt(file.flat->area() / area);
  return std::sqrt(file.folded.area() / area) / std::cos(file.theta[1]);
}

std::vector<Cells> cuts_of(const OutlineFile& file, const targets::Outline& folded) {
  const auto [lattice, angle] = lattice_of(file);
  std::vector<Cells> cuts = optim::trimmed_cells(*lattice, angle, file.columns, file.rows, folded);
  if (cuts.empty())
    throw InvalidInput("no cells of the lattice are within the outline. Give more `structure.cells`");
  return cuts;
}

Cells cells_within(const OutlineFile& file, const model::PlanarStructure& coarse, double ratio) {
  std::vector<Eigen::Vector2d> corners;
  for (const int v : outer_boundary(coarse.graph).vertices) corners.push_back(coarse.graph.vertices[v]);
  const targets::Outline boundary(corners);
  const auto [lattice, angle] = lattice_of(file);
  const Eigen::Vector2d from = model::lattice_box(*lattice, file.columns, file.rows, angle).center(),
                        to = model::box_of(corners).center();
  return model::cut_cells(*lattice, file.columns, file.rows, angle, [&](const Eigen::Vector2d& middle) {
    return boundary.contains(to + inwards * ratio * (middle - from));
  });
}

std::vector<double> turns_of(const targets::Outline& outline, int steps) {
  const std::optional<double> direction = direction_of(outline);
  if (!direction) return {0};
  std::vector<double> out;
  for (int k = 0; k < steps; ++k) {
    const double turn = std::remainder(k * pi / 4 - *direction, 2 * pi);
    out.push_back(std::abs(turn) < as_drawn ? 0 : turn);
  }
  return out;
}

std::vector<Eigen::Vector2d> boundary_over(const targets::Outline& outline,
                                           const model::PlanarStructure& panel) {
  std::vector<Eigen::Vector2d> rim;
  for (const int v : outer_boundary(panel.graph).vertices) rim.push_back(panel.graph.vertices[v]);
  const double area = signed_area(rim.size(), [&](std::size_t k) { return rim[k]; });
  Eigen::AlignedBox2d box;
  for (Eigen::Vector2d& p : rim) box.extend(p *= std::sqrt(outline.area() / area));
  for (Eigen::Vector2d& p : rim) p += outline.middle() - box.center();
  return rim;
}

OutlineStart outline_start(const OutlineFile& file) {
  OutlineStart start{file.trims ? cuts_of(file, file.folded).front()
                                : model::lattice_cells(file.columns, file.rows)};
  start.edge_mm = edge_of(file, start.cells);
  return start;
}

}  // namespace kinetix::app
