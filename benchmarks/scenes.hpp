#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "model/lattice/square/structure.hpp"
#include "optim/curve/fit_curve.hpp"
#include "targets/curve/read_curve.hpp"
#include "tests/support/curves.hpp"

namespace kinetix::bench {

struct Scene {
  std::string name;
  targets::Curve goal;
};

/// The curves of the regression, from targets/shapes: half circle, helmet rib, S curve.
inline std::vector<Scene> regression_scenes() {
  std::vector<Scene> scenes;
  for (const char* name : {"half_circle", "helmet_rib", "s_curve"})
    scenes.push_back({name, targets::read_curve_csv(std::string(KINETIX_SHAPES "/") + name + ".csv")});
  return scenes;
}

/// A strip whose straight length at theta = 30 deg is the goal's.
inline optim::CurveVariables strip(const Scene& scene, int columns) {
  optim::CurveVariables variables;
  variables.columns = columns;
  variables.cell_mm = testing::fitting_cell(scene.goal, columns);
  return variables;
}

/// Walls a tenth of the cell thick and three fifths of it high.
inline model::CellSize walls_of(double edge_mm) { return {edge_mm, edge_mm / 10, 0.6 * edge_mm}; }

/// A strip fitted to a scene's curve, its walls free of each other. @param structure becomes the strip
inline optim::FreeCurveDesign fitted_strip(const Scene& scene, int columns, model::Structure& structure) {
  const optim::CurveVariables variables = strip(scene, columns);
  const model::CellSize size = walls_of(variables.cell_mm);
  optim::FreeCurveDesign found = fit_free_curve(scene.goal, variables, size, {});
  structure = make_structure(model::rectangle(columns, 1), size);
  apply(found.design.design, structure);
  return found;
}

/// A strip or sheet that bends into an arc of 0.16 rad a column, at theta 0.5; half a circle at most.
inline model::Structure arc(int columns, int rows, model::ExactDesign<double>& design) {
  design = model::ExactDesign<double>::basic(columns, rows);
  for (int c = 0; c < columns; ++c) design.beta[c] = (c % 2 ? -1 : 1) * std::min(0.16, 3.2 / columns);
  design.theta = 0.5;
  model::Structure structure = make_structure(model::rectangle(columns, rows), walls_of(10));
  apply(design, structure);
  return structure;
}

}  // namespace kinetix::bench
