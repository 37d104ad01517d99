#pragma once

#include <string>
#include <vector>

#include "optim/fit_curve.hpp"
#include "targets/read_curve.hpp"
#include "tests/support/curves.hpp"

namespace kinetix::bench {

struct Scene {
  std::string name;
  Curve goal;
};

/// The curves of the regression, from targets/shapes: half circle, helmet rib, S curve.
inline std::vector<Scene> regression_scenes() {
  std::vector<Scene> scenes;
  for (const char* name : {"half_circle", "helmet_rib", "s_curve"})
    scenes.push_back({name, read_curve_csv(std::string(KINETIX_SHAPES "/") + name + ".csv")});
  return scenes;
}

/// A strip whose straight length at theta = 30 deg is the goal's.
inline CurveVariables strip(const Scene& scene, int columns) {
  CurveVariables variables;
  variables.columns = columns;
  variables.cell_mm = testing::fitting_cell(scene.goal, columns);
  return variables;
}

}  // namespace kinetix::bench
