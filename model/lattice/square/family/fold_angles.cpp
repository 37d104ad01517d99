#include "model/lattice/square/family/fold_angles.hpp"

namespace kinetix::model {
namespace {

using Step = FoldAngleTree::Step;

/// Graph of the cells: each joins the crease of its x-walls and that of its y-walls.
using Crossings = std::vector<std::vector<Step>>;

Crossings crossings(const Structure& structure, const Creases& creases) {
  Crossings out(creases.list.size());
  for (const CellHinges& cell : structure.cell_members) {
    const int x_hinge = cell.hinges[0], y_hinge = cell.hinges[1];
    const int x = creases.of_hinge[x_hinge], y = creases.of_hinge[y_hinge];
    out[x].push_back({y, x, x_hinge, y_hinge, 1});
    out[y].push_back({x, y, x_hinge, y_hinge, -1});
  }
  return out;
}

/// Returns b and g of a step.
std::array<double, 2> tilts_at(const Structure& structure, const Step& step) {
  return {tilt_in_crease(structure.hinges[step.x_hinge]), tilt_in_crease(structure.hinges[step.y_hinge])};
}

double secant_squared(double angle) { return 1 / (std::cos(angle) * std::cos(angle)); }

}  // namespace

FoldAngleTree make_fold_angle_tree(const Structure& structure, const Creases& creases) {
  const Crossings near = crossings(structure, creases);
  FoldAngleTree tree{near.size(), {}};
  std::vector<bool> found(near.size(), false);
  std::vector<int> queue;
  for (const CellHinges& cell : structure.cell_members) {
    const int first = creases.of_hinge[cell.hinges[1]];
    if (found[first]) continue;
    found[first] = true;
    queue = {first};
    for (std::size_t k = 0; k < queue.size(); ++k)
      for (const Step& step : near[queue[k]]) {
        if (found[step.crease]) continue;
        found[step.crease] = true;
        queue.push_back(step.crease);
        tree.steps.push_back(step);
      }
  }
  return tree;
}

std::vector<double> fold_shifts(const FoldAngleTree& tree, const Structure& structure) {
  std::vector<double> shifts(tree.creases, 0.0);
  for (const Step& step : tree.steps) {
    const auto [b, g] = tilts_at(structure, step);
    shifts[step.crease] = shifts[step.from];
    if (b != 0 && g != 0) shifts[step.crease] += step.sign * std::tan(b) * std::tan(g);
  }
  return shifts;
}

std::vector<double> fold_shift_gradient(const FoldAngleTree& tree, const Structure& structure, int crease) {
  std::vector<double> derivatives(tree.creases, 0.0);
  for (const Step& step : tree.steps) {
    const auto [b, g] = tilts_at(structure, step);
    const bool onto_x = step.sign < 0;
    const int x = onto_x ? step.crease : step.from, y = onto_x ? step.from : step.crease;
    double rate = 0;
    if (x == crease) rate += secant_squared(b) * std::tan(g);
    if (y == crease) rate += std::tan(b) * secant_squared(g);
    derivatives[step.crease] = derivatives[step.from] + step.sign * rate;
  }
  return derivatives;
}

FoldAngle fold_angle(double theta, double shift) {
  if (shift == 0) return {theta, 1, 0};
  const double s = std::sin(theta), c = std::cos(theta) + shift * s, square = s * s + c * c;
  return {std::atan2(s, c), 1 / square, -s * s / square};
}

double half_turn(double tilt, double angle) {
  return std::atan2(std::sin(angle), std::cos(tilt) * std::cos(angle));
}

}  // namespace kinetix::model
