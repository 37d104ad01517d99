#pragma once

#include <nlohmann/json.hpp>

#include "app/files/goal_settings.hpp"
#include "app/files/hinge_section.hpp"
#include "app/run/goal_outcome.hpp"
#include "model/lattice/square/structure.hpp"
#include "optim/fold/fit_box.hpp"
#include "optim/fold/fit_fold.hpp"
#include "optim/solvers/solver.hpp"
#include "targets/fold/fold_goal.hpp"

namespace kinetix::app {

/// Content of a target.yaml of kind fold, with defaults filled in. Required are `kinetix: 1` and a `target`.
///
///     target: {kind: fold, box: [4, 4, 4]}                     # or box_mm, net, solid: targets/fold/fold_goal.hpp
///     structure: {cell_mm: 10, wall_mm: {thickness: 0.8, height: 6}}
///     variables: {beta: {range_deg: [-60, 60]}, theta: {range_deg: [2, 44]}}
///     tolerance: {angle_deg: 0.1, shape: 0.02, verify: 0.02}
struct FoldFile : GoalSettings {
  targets::FoldGoal goal;
  std::optional<optim::BoxOptions> box = {};  ///< for goal.box_mm: options of the search for its cells
  /// For goal.box_mm: edges that the cells fold to, mm, from a search of a small box.
  std::array<double, 3> box_folded_mm = {};
  model::CellSize size = {};  ///< structure.cell_mm (default 10), structure.wall_mm
  /// Rad, (0, 89] deg: the end of variables.beta.range_deg that is nearer to 0. The range includes 0, because tilts
  /// alternate in sign along a crease.
  double tilt = 60 * radians_per_degree;
  optim::AngleRange theta = {2 * radians_per_degree,
                             44 * radians_per_degree};  ///< rad, variables.theta, within (0, 45) deg
  double angle_tolerance = 0.1 * radians_per_degree;    ///< largest error of a crease, rad, (0, 90] deg
  double shape_tolerance = 0.02;                        ///< largest face_rms, over a face's edge, (0, 1]
  double size_tolerance = 0.02;  ///< largest error of an edge, over goal.box_mm, (0, 1]
  HingeLimits limits = {};       ///< tolerance.force_N and tolerance.strain
};

/// Returns all keys of a target.yaml of kind fold.
const targets::KeyTable& fold_keys();

/// Reads the target. @param root a target whose kind is fold
/// @throws InvalidInput for whatever formats.md does not allow
FoldFile read_fold_file(const targets::Node& root);

/// Makes the goal: the search, the closed form, and the simulation of its folding.
std::unique_ptr<Goal> make_goal(FoldFile file);

/// Search result: a net of rectangles of squares, or of the faces of a solid, in the state of its model.
struct FoldShape {
  struct Crease {
    std::string name;
    double angle = 0;                ///< required angle, rad
    std::vector<int> hinges;         ///< tilted hinges
    nlohmann::ordered_json section;  ///< position in the flat net
  };

  model::Lattice sheet;
  double theta = 0;  ///< rad
  nlohmann::ordered_json target = {};
  std::vector<nlohmann::ordered_json> faces = {};  ///< as Crease::section
  std::vector<Crease> creases = {};
  std::vector<std::vector<int>> outlines = {};  ///< closed outline of each face: bodies at its corners
  double side = 0;                              ///< mean side of the faces, cell edges

  targets::FoldError error = {};  ///< error of the closed form at theta
  std::vector<double> tilt = {};  ///< |tilt| of the hinges of each crease, rad
  std::vector<optim::FoldAttempt> attempts = {};
  int evaluations = 0;  ///< count of motions checked for collisions of walls
  bool folds = false, stopped = false;
  std::vector<std::string> obstacles = {};             ///< reasons if no attempt folds
  std::string why_not = {};                            ///< one sentence for the search if no attempt folds
  std::size_t unfoldings = 1;                          ///< number of unfoldings of the goal
  int unfolding = 0;                                   ///< index of the chosen unfolding
  std::optional<std::array<double, 3>> edges_mm = {};  ///< boxes only: faces plus the creases at their ends
  std::vector<SummaryLine> lines = {};                 ///< net and size

  std::function<targets::FoldError(const model::State&)> error_of = {};
  /// Positions of vertices on the ideal solid after alignment with a state. @pre the state is finite
  std::function<std::vector<targets::IdealPoint>(const model::Lattice& sheet, const model::State&)> ideal =
      {};

  /// Describes violations of the file's tolerances, one line each. @param who name of the state, such as "model"
  std::vector<std::string> violations(const FoldFile& file, const targets::FoldError& of,
                                      const std::string& who) const;
  /// Returns the largest angle error of a crease, rad.
  double largest_miss(const targets::FoldError& of) const;
  /// Returns the mean edge of the folded faces, mm.
  double face_mm() const;
  /// Limits of the angle error of a crease and of the rms error of faces.
  struct Limits {
    double angle_deg = 0;  ///< deg
    double shape = 0;      ///< ratio to the edge of a face
  };
  /// Describes the error: "12 creases within 0.001 deg, faces 0.02 mm rms off". @param limits are added if given
  std::string describe(const targets::FoldError& of, const std::optional<Limits>& limits = {}) const;
};

/// Returns the edges of the ideal box in mm; an open box ends at its rim. @pre goal.box
std::array<double, 3> edges_mm(const targets::FoldGoal& goal, const optim::FoldDesign& design);

FoldShape shape_of(const targets::FoldGoal& goal, const optim::FoldDesign& design);
FoldShape shape_of(const targets::SolidGoal& goal, const optim::SolidDesign& design);

}  // namespace kinetix::app
