#pragma once

#include <random>

#include "model/base/invalid_input.hpp"
#include "model/lattice/origami/march.hpp"

/// Flat-foldable meshes near the Miura sheet, for tests.
namespace kinetix::testing {

/// A march whose data differ from a Miura sheet's by up to `amount` of them. It may lead to angles out of range.
inline model::MarchedMesh<double> disturbed_miura(int columns, int rows, double amount,
                                                  std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const double angle = 1.1 + 0.15 * unit(random);
  model::MarchData data = model::miura(columns, rows, angle, 1);
  for (auto* lengths : {&data.rising, &data.level, &data.bottom_length, &data.left_length})
    for (double& value : *lengths) value *= std::exp(amount * unit(random));
  for (auto* angles : {&data.left_angle, &data.bottom_angle})
    for (double& value : *angles) value += amount / 2 * unit(random);
  return model::march(data);
}

/// Returns the first disturbed_miura() that can be a sheet: sectors from 52 to 128 deg, edges of at least 0.3.
inline model::MarchedMesh<double> random_mesh(int columns, int rows, double amount, std::mt19937& random) {
  const double least = 52 * radians_per_degree;
  while (true) {
    model::MarchedMesh<double> out = disturbed_miura(columns, rows, amount, random);
    const auto within = [&](double angle) { return angle > least && angle < pi - least; };
    bool good = true;
    for (const auto& v : out.inner) good = good && within(v.a) && within(v.b);
    for (int j = 0; good && j <= rows; ++j)
      for (int i = 0; good && i <= columns; ++i) {
        if (i < columns) good = (out.mesh.at(i + 1, j) - out.mesh.at(i, j)).norm() > 0.3;
        if (good && j < rows) good = (out.mesh.at(i, j + 1) - out.mesh.at(i, j)).norm() > 0.3;
      }
    if (!good) continue;
    try {
      validate(out.mesh);
      return out;
    } catch (const InvalidInput&) {
    }
  }
}

}  // namespace kinetix::testing
