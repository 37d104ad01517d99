#pragma once

#include <limits>

#include "app/goals/ribs/beside.hpp"
#include "app/run/goal.hpp"
#include "optim/ribs/ribs_cover.hpp"
#include "targets/helmet/walls_inside.hpp"

namespace kinetix::app {

struct RibsMeasure final : Measure {
  optim::RibsError error;
  targets::WallsInside inside;   ///< walls in the head that was given
  std::vector<SurfaceWay> ways;  ///< of a surface: the fishbone, and of the model's state the same ribs loose
};

class RibsOutcome;

/// A fishbone that is to lie over a surface, head or other. All states are in the frame of the ribs, mm.
struct RibsTask {
  std::string name;
  GoalSettings settings;
  optim::RibsSpec spec;
  targets::MeshDistance over;
  Eigen::Isometry3d to_given;  ///< to the frame of the mesh
  std::function<optim::RibsLayout()> plan = {};
  optim::SolverOptions solver = {};
  double rms_mm = 0;  ///< that bodies may be off the surface and its clearance
  Tolerances tolerances = {};
  TurnBounds bounds = {};
  bool is_laid_over = false;       ///< equilibria are, as Found::is_laid_over
  Eigen::Vector3d folded_mm = {};  ///< size to expect
  bool has_notes = false;          ///< whether a forecast has those of the layout
  double lowest_z =
      -std::numeric_limits<double>::infinity();  ///< the surface counts as covered above this, mm
  std::function<std::unique_ptr<RibsOutcome>(optim::RibsDesign)> outcome = {};
};

/// What a search for ribs contributes to a result, and how the kind judges states of them.
class RibsOutcome : public GoalOutcome {
 public:
  RibsOutcome(const RibsTask& task, optim::RibsDesign found);

  optim::RibsDesign design;
  Eigen::Isometry3d to_given;
  optim::RibsReach reach;  ///< of the design's cells
  optim::RibsCover cover;  ///< the surface against them

  /// Adds what the kind measures of a state and its violations. @param state on the surface
  virtual void judge(const model::Lattice& sheet, StateOf of, const model::State& state,
                     RibsMeasure& measure) const = 0;
  /// Describes a surface that is covered too little; empty where it is covered.
  virtual std::vector<std::string> bare() const = 0;
  /// Lists other ways to make the surface, for comparison with a design that was judged.
  virtual std::vector<SurfaceWay> other_ways(const std::stop_token&) const { return {}; }

 protected:
  nlohmann::ordered_json line(const std::vector<Eigen::Vector3d>& points) const;
  nlohmann::ordered_json lines(const std::vector<std::vector<Eigen::Vector3d>>& each) const;
  /// The parts of lines that no rib is near to.
  nlohmann::ordered_json bare_lines(const std::vector<std::vector<Eigen::Vector3d>>& each) const;
  /// The row of the spine that each rib leaves, its cells, and the rms distance of its bodies, mm.
  nlohmann::ordered_json ribs() const;
};

std::unique_ptr<Goal> make_ribs_goal(RibsTask task);

}  // namespace kinetix::app
