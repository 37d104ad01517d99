#pragma once

#include <gtest/gtest.h>

#include "model/lattice/lattice_motion.hpp"
#include "sim/physics_run.hpp"
#include "tests/support/random_designs.hpp"

namespace kinetix::testing {

inline sim::PhysicsOptions physics_without_contact() {
  sim::PhysicsOptions options;
  options.contact = false;
  return options;
}

/// Design of a one-row strip from the tilts of its columns.
inline model::ExactDesign<double> strip(const std::vector<double>& tilts, double theta) {
  auto design = model::ExactDesign<double>::basic(static_cast<int>(tilts.size()), 1);
  design.beta = tilts;
  design.theta = theta;
  return design;
}

/// Tilts that add up: tilt, -tilt, tilt, ...
inline std::vector<double> curl(int columns, double tilt) {
  std::vector<double> tilts(columns, tilt);
  for (int c = 1; c < columns; c += 2) tilts[c] = -tilt;
  return tilts;
}

inline sim::PhysicsResult run(const model::ExactDesign<double>& design,
                              const sim::PhysicsOptions& options = {}) {
  const model::Structure structure = structure_of(design);
  return run_compression(structure, drive_on(structure, drive_to(structure, design.theta)), options);
}

/// The run settles, on the state that the reflections give.
inline void expect_exact(const model::ExactDesign<double>& design, const sim::PhysicsResult& result,
                         double tolerance = 1e-7) {
  const model::Structure structure = structure_of(design);
  EXPECT_EQ(result.status, sim::PhysicsResult::Status::settled) << result.why;
  EXPECT_LE(aligned_distance(structure, result.state, fold(design, structure)).max, tolerance);
}

}  // namespace kinetix::testing
