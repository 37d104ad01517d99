#pragma once

#include <nlohmann/json.hpp>

#include "app/goals/fold/fold_file.hpp"
#include "app/run/goal_outcome.hpp"
#include "optim/fold/fit_solid.hpp"

namespace kinetix::app {

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
  /// Describes the error: "12 creases within 0.001 deg, faces less than 0.001 of their edge from the solid (rms)".
  std::string in_words(const targets::FoldError& of) const;
};

/// Returns the edges of the ideal box in mm; an open box ends at its rim. @pre goal.box
std::array<double, 3> edges_mm(const targets::FoldGoal& goal, const optim::FoldDesign& design);

FoldShape shape_of(const targets::FoldGoal& goal, const optim::FoldDesign& design);
FoldShape shape_of(const targets::SolidGoal& goal, const optim::SolidDesign& design);

}  // namespace kinetix::app
