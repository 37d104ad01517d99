#pragma once

#include <string>
#include <vector>

#include "model/elastic/path/equilibrium_path.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/square/family/classification.hpp"

namespace kinetix::bench {

/// A structure, the drive that folds it from flat, and the answer that every method is measured against.
struct SpeedErrorScene {
  std::string name;
  model::Structure structure;
  model::Drive drive;
  model::Classification family;
  model::State reference;      ///< the closed form, or the finest equilibrium where there is none
  double reference_error = 0;  ///< of the reference, cell edges: rounding, or what the last halving changed
  model::Elasticity elasticity = {};  ///< of a scene without a closed form

  bool is_exact() const { return family.family != model::Family::none; }
};

/// Returns all scenes: helmet rib and half circle in 40 columns, cube, helmet, letter T and circle, sheets of 10 x 10,
/// 20 x 20 and 50 x 50 cells. Strips are fitted to the curves of targets/shapes. Displays follow the paper's rule
/// without a search: cells of the picture scale (k = 0.15), the others are basic. Their compression is 14 %, at which
/// a few walls touch.
std::vector<SpeedErrorScene> speed_error_scenes();

}  // namespace kinetix::bench
