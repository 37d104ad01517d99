#pragma once

#include <random>

#include "model/closure/closure.hpp"
#include "model/contact/wall_contact.hpp"
#include "model/lattice/square/structure.hpp"

namespace kinetix::testing {

/// Returns a panel with hinges anywhere: t in 0.2..0.8, alpha within 0.4 rad of upright, beta up to 0.5 rad; flat, no
/// walls overlap.
inline model::Structure random_panel(int columns, int rows, std::mt19937& random, bool planar = false) {
  std::uniform_real_distribution<double> unit(-1, 1);
  model::Structure s = make_structure(model::rectangle(columns, rows), {10, 0.8, 6});
  do {
    for (model::Hinge& hinge : s.hinges) {
      hinge.parameters.t = 0.5 + 0.3 * unit(random);
      if (planar) continue;
      hinge.parameters.alpha = pi / 2 + 0.4 * unit(random);
      hinge.parameters.beta = 0.5 * unit(random);
    }
  } while (model::WallContact(s).overlap_at_rest());
  return s;
}

/// Returns the state with every body moved at random, by up to `size` rad and cell edges per coordinate.
inline model::State shaken(const model::Linkage& s, const model::State& state, double size,
                           std::mt19937& random, bool planar = false) {
  std::uniform_real_distribution<double> unit(-size, size);
  Eigen::VectorXd twists(6 * state.size());
  for (Eigen::Index k = 0; k < twists.size(); ++k) {
    const bool in_plane = k % 6 == 2 || k % 6 == 3 || k % 6 == 4;
    twists[k] = planar && !in_plane ? 0 : unit(random);
  }
  return retract_straight(s, state, twists);
}

}  // namespace kinetix::testing
