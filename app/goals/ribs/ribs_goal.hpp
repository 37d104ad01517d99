#pragma once

#include "app/run/goal.hpp"
#include "optim/ribs/fit_ribs.hpp"
#include "optim/ribs/ribs_cover.hpp"
#include "targets/helmet/head.hpp"

namespace kinetix::app {

/// One way to make a surface, for comparison. Distances are ratios to the diagonal of the surface.
struct SurfaceMethod {
  std::string name;         ///< "sheet", "fishbone", "loose ribs"
  double rms = 0, max = 0;  ///< distance of a sheet's vertices from their layers, or of a rib's bodies
  int pieces = 1;
  double open = 0;  ///< share of the surface left bare
};

/// Returns the distances of a fishbone design from the surface and the share of the area that it leaves open.
SurfaceMethod fishbone_method(const optim::RibsDesign& design, const targets::RibbedSurface& surface);

/// Fits loose ribs, and a fishbone first if `with_fishbone` is set. Returns an empty list if `stop` was requested.
/// @throws InvalidInput as optim::fit_ribs
std::vector<SurfaceMethod> rib_methods(const targets::RibbedSurface& surface, const optim::RibsSpec& spec,
                                       bool with_fishbone, const std::stop_token& stop);

nlohmann::ordered_json methods_json(const std::vector<SurfaceMethod>& methods);
/// Describes all ways in one line.
std::string describe(const std::vector<SurfaceMethod>& methods);

struct RibsMeasure final : Measure {
  optim::RibsError error;
  targets::WallsInside inside;  ///< walls inside the given head; helmets only
  std::vector<SurfaceMethod>
      methods;  ///< surfaces only: the fishbone, and for the model also the same ribs loose
};

class RibsOutcome;

/// Search for a fishbone over a surface, such as a head. All states are in the frame of the ribs, mm.
struct RibsTask {
  std::string name;
  GoalSettings settings;
  optim::RibsSpec spec;
  targets::MeshDistance over;
  Eigen::Isometry3d to_given;  ///< to the frame of the mesh
  std::function<optim::RibsLayout()> plan = {};
  optim::SolverOptions solver = {};
  double rms_mm = 0;  ///< allowed rms distance of bodies from the surface plus its clearance
  Tolerances tolerances = {};
  TurnBounds bounds = {};
  bool is_aligned = false;         ///< copied to Found::is_aligned
  Eigen::Vector3d folded_mm = {};  ///< expected folded size
  bool has_notes = false;          ///< whether the forecast includes the notes of the layout
  double lowest_z =
      -std::numeric_limits<double>::infinity();  ///< lower bound of the surface that ribs must cover, z in mm
  std::function<std::unique_ptr<RibsOutcome>(optim::RibsDesign)> outcome = {};
};

/// Rib section of a result, with the checks of the goal kind for its states.
class RibsOutcome : public GoalOutcome {
 public:
  RibsOutcome(const RibsTask& task, optim::RibsDesign found);

  optim::RibsDesign design;
  Eigen::Isometry3d to_given;
  optim::RibsReach reach;  ///< reach of the design's cells
  optim::RibsCover cover;  ///< coverage of the surface by these cells

  /// Adds the kind's measures of a state and its violations. @param state in the frame of the surface
  virtual void evaluate(const model::Lattice& sheet, StateOf of, const model::State& state,
                        RibsMeasure& measure) const = 0;
  /// Describes insufficient coverage of the surface. Empty if coverage is sufficient.
  virtual std::vector<std::string> bare() const = 0;
  /// Lists other ways to make the surface, for comparison with a measured design.
  virtual std::vector<SurfaceMethod> other_methods(const std::stop_token&) const { return {}; }

 protected:
  nlohmann::ordered_json line(const std::vector<Eigen::Vector3d>& points) const;
  nlohmann::ordered_json lines(const std::vector<std::vector<Eigen::Vector3d>>& each) const;
  /// Returns the parts of the lines without a rib nearby.
  nlohmann::ordered_json bare_lines(const std::vector<std::vector<Eigen::Vector3d>>& each) const;
  /// Lists for each rib its row on the spine, its number of cells, and the rms distance of its bodies in mm.
  nlohmann::ordered_json ribs() const;
};

std::unique_ptr<Goal> make_ribs_goal(RibsTask task);

}  // namespace kinetix::app
