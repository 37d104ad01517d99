#pragma once

#include "app/files/design_file.hpp"
#include "model/base/invalid_input.hpp"
#include "model/linkage/exact_motion.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::app {

/// Steps of the path from flat to the fold.
inline constexpr int path_steps = 20;  // as the contracts of the figures require

/// Path of a design from flat to its fold.
struct PrintPath {
  std::vector<double> thetas;                       ///< rad, from 0 on
  std::vector<model::State> states;                 ///< for each theta, for a cell edge of 1 mm
  std::function<model::State(double)> motion = {};  ///< state at a theta, cell edge of 1 mm; empty: not exact
  std::vector<model::TurnLaw> turns = {};           ///< of each hinge along that motion
  std::vector<int> jumps = {};  ///< states from which it jumps to the next, as in snap-through
  bool is_exact = true;         ///< by the closed form; else by the equilibrium under the design's drive
  std::string flat_only_reason = {};  ///< reason if only the flat state is known
};

/// Returns the path by the closed form, at path_steps even steps. Without a closed form it is the equilibrium of the
/// design's elastic hinges under its drive, at steps at most as long. These are halved up to three times, until the
/// path between two states is known to 0.005 mm.
PrintPath print_path(const Design& design);

/// Describes how far the equilibrium of elastic hinges under the design's drive is from the fold of the closed form,
/// or that it does not get there. Empty if the two agree, without a closed form, and for revolute joints.
/// @param edge_mm of the cells as printed
std::optional<std::string> equilibrium_beside_exact(const Design& design, double edge_mm);

/// Scales states to another cell edge, mm: lengths grow with it, angles stay.
std::vector<model::State> with_edge(std::vector<model::State> states, double edge_mm);

/// Sheet cut into tiles that a printer's bed holds, in a grid whose columns and rows are about equally wide.
struct Tiles {
  int columns = 1, rows = 1;
  int with_bodies = 1;                         ///< places of the grid that hold any: only these are tiles
  std::vector<int> of_body;                    ///< the tile of each body, row by row from the lower left
  std::optional<Eigen::Vector2d> bed_mm = {};  ///< requested bed, mm
  bool turned = false;                         ///< whether tiles lie on that bed turned by a quarter

  int count() const { return with_bodies; }
};

/// Error for a bed that does not hold one body: larger cells make it worse.
class BedTooSmall : public InvalidInput {
 public:
  using InvalidInput::InvalidInput;
};

/// Checks whether a rectangle fits on a bed, as it is or turned by a quarter, both mm.
bool fits_on_bed(const Eigen::Vector2d& size_mm, const Eigen::Vector2d& bed_mm);

/// Cuts a sheet into the fewest columns and rows that hold all bodies: one of each if the bed holds the whole. The bed
/// is turned by a quarter if that takes fewer tiles.
/// @param boxes of the bodies with what is printed with each, at their places in the flat sheet, mm. Nothing is
/// printed of a body with an empty box.
/// @param bed_mm along x and y.   @throws BedTooSmall for a bed that does not hold each body
Tiles cut_into_tiles(const std::vector<Eigen::AlignedBox2d>& boxes, const Eigen::Vector2d& bed_mm);

}  // namespace kinetix::app
