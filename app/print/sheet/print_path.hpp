#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/files/design_file.hpp"
#include "model/base/invalid_input.hpp"
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

/// A sheet cut into tiles that a printer's bed holds, in a grid whose columns and rows are about equally wide.
struct Tiles {
  int columns = 1, rows = 1;
  int with_bodies = 1;       ///< places of the grid that hold any: each is a tile, the others are none
  std::vector<int> of_body;  ///< the tile of each body, row by row from the lower left
  std::optional<Eigen::Vector2d> bed_mm = {};  ///< that was asked for, mm
  bool turned = false;                         ///< on that bed, by a quarter

  int count() const { return with_bodies; }
};

/// A bed that does not hold one body: larger cells make it worse.
class BedTooSmall : public InvalidInput {
 public:
  using InvalidInput::InvalidInput;
};

/// Whether a rectangle fits on a bed, as it lies or turned by a quarter, both mm.
bool fits_on_bed(const Eigen::Vector2d& size_mm, const Eigen::Vector2d& bed_mm);

/// As few columns and rows as hold all bodies, one of each where the bed holds the whole; turned on the bed by a quarter
/// where that takes fewer.
/// @param boxes of the bodies with what is printed with each, where they are in the flat sheet, mm; empty: nothing is
/// printed of it   @param bed_mm along x and y
/// @throws BedTooSmall
Tiles cut_into_tiles(const std::vector<Eigen::AlignedBox2d>& boxes, const Eigen::Vector2d& bed_mm);

}  // namespace kinetix::app
