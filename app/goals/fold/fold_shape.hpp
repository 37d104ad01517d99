#pragma once

#include <nlohmann/json.hpp>

#include "app/goals/fold/fold_file.hpp"
#include "app/run/goal_outcome.hpp"
#include "optim/fold/fit_solid.hpp"

namespace kinetix::app {

/// A net that was searched for, of rectangles of squares or of the faces of a solid, in the state that its model holds it in.
struct FoldShape {
  struct Crease {
    std::string name;
    double angle = 0;                ///< that is asked for, rad
    std::vector<int> hinges;         ///< that lean
    nlohmann::ordered_json section;  ///< its place in the flat net
  };

  model::Lattice sheet;
  double theta = 0;  ///< rad
  nlohmann::ordered_json target = {};
  std::vector<nlohmann::ordered_json> faces = {};  ///< as Crease::section
  std::vector<Crease> creases = {};
  std::vector<std::vector<int>> outlines = {};  ///< of faces: bodies from corner to corner, closed
  double side = 0;                              ///< mean of faces, cell edges

  targets::FoldError error = {};  ///< of the closed form at theta
  std::vector<double> tilt = {};  ///< size of those along each crease, rad
  std::vector<optim::FoldAttempt> attempts = {};
  int evaluations = 0;  ///< motions that were checked for walls in the way
  bool folds = false, stopped = false;
  std::vector<std::string> obstacles = {};  ///< why none folds
  std::string why_not = {};                 ///< the same, for the search
  std::size_t unfoldings = 1;               ///< that the goal has
  int unfolding = 0;                        ///< of them
  std::optional<std::array<double, 3>> edges_mm =
      {};                               ///< of a box: faces, and what the creases add at their ends
  std::vector<SummaryLine> lines = {};  ///< net and size

  std::function<targets::FoldError(const model::State&)> error_of = {};
  /// Places of vertices on the ideal solid, laid over a state. @pre the state is finite
  std::function<std::vector<targets::IdealPoint>(const model::Lattice& sheet, const model::State&)> ideal =
      {};

  /// What a state lacks of what the file asks, a line each. @param who shows the state: "model"
  std::vector<std::string> violations(const FoldFile& file, const targets::FoldError& of,
                                      const std::string& who) const;
  /// The most that a crease folds too far or not far enough, rad.
  double largest_miss(const targets::FoldError& of) const;
  /// "12 creases within 0.001 deg, faces less than 0.001 of their edge from the solid (rms)"
  std::string in_words(const targets::FoldError& of) const;
};

/// Edges of the ideal box, mm, to the rim of an open one. @pre goal.box
std::array<double, 3> edges_mm(const targets::FoldGoal& goal, const optim::FoldDesign& design);

FoldShape shape_of(const targets::FoldGoal& goal, const optim::FoldDesign& design);
FoldShape shape_of(const targets::SolidGoal& goal, const optim::SolidDesign& design);

}  // namespace kinetix::app
