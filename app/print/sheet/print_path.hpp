#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/files/design_file.hpp"
#include "model/linkage/state.hpp"
#include "model/linkage/turn_law.hpp"

namespace kinetix::app {

/// Steps of the path from flat to the fold.
inline constexpr int path_steps = 20;  // that contracts of the figures ask for

/// How a design comes from flat to its fold.
struct PrintPath {
  std::vector<double> thetas;        ///< rad, from 0 on
  std::vector<model::State> states;  ///< for each of them; of a cell edge of 1 mm
  std::function<model::State(double)> motion =
      {};                                  ///< state at a theta, likewise; empty where it is not exact
  std::vector<model::TurnLaw> turns = {};  ///< of each hinge along that motion
  std::vector<int> jumps = {};             ///< states from which it jumps to the next, as snaps do
  bool is_exact = true;             ///< by the closed form; else by the equilibrium under the design's drive
  std::string why_flat_alone = {};  ///< where it is flat alone
};

/// By the closed form at path_steps even steps; where there is none by the equilibrium of the design's elastic hinges
/// under its drive, at steps at most as long, which are halved up to three times until it is known to 0.005 mm between two of
/// them.
PrintPath print_path(const Design& design);

/// What is to be said of a fold by the closed form where hinges are elastic: how far their equilibrium under the design's drive is
/// from it, or that it does not get there. Nothing where they are alike, there is no closed form, or hinges are rotary.
/// @param edge_mm of the cells as they are made
std::optional<std::string> equilibrium_beside_exact(const Design& design, double edge_mm);

/// Of another cell edge, mm: lengths grow with it, angles stay.
std::vector<model::State> with_edge(std::vector<model::State> states, double edge_mm);

}  // namespace kinetix::app
