#pragma once

#include <random>

#include "model/lattice/square/family/classification.hpp"

namespace kinetix::testing {

/// A random design of a family with all its degrees of freedom in use. Tilts up to 50 deg, fractions 0.1 to
/// 0.9, theta +-44 deg.
inline model::ExactDesign<double> random_design(model::Family family, int columns, int rows,
                                                std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  auto design = model::ExactDesign<double>::basic(columns, rows);
  const auto tilt = [&] { return 50 * radians_per_degree * unit(random); };
  const auto fraction = [&] { return 0.5 + 0.4 * unit(random); };
  if (family == model::Family::F1) {
    for (double& t : design.t) t = fraction();
    for (double& s : design.s) s = fraction();
  } else {
    for (int c = 0; c < columns; ++c) {
      const bool planar = family == model::Family::F2 && unit(random) < -0.5;
      (planar ? design.t[c] : design.beta[c]) = planar ? fraction() : tilt();
    }
  }
  if (family == model::Family::F3) design.gamma = tilt();
  design.theta = 44 * radians_per_degree * unit(random);
  return design;
}

inline model::Structure structure_of(const model::ExactDesign<double>& design,
                                     const model::CellSize& size = {}) {
  model::Structure structure = make_structure(model::rectangle(design.columns(), design.rows()), size);
  apply(design, structure);
  return structure;
}

}  // namespace kinetix::testing
