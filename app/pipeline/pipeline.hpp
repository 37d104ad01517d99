#pragma once

#include "app/run/goal.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {

/// Searches for the goal and evaluates the design by each model: the exact state, then the equilibrium of elastic
/// hinges. The simulation and the checks of prints and contact follow in parallel.
/// @throws InvalidInput for a target that leaves nothing to search
Run run_goal(const Goal& goal, const RunOptions& options);

/// Evaluates a design as it is, without a search. Imported bodies have no family: their exact state is closed step by
/// step along the drive.
/// @param model `exact`: one state of the closed form. `equilibrium`: the path of the design's elastic hinges from
/// flat to the goal of its drive, with the closed form of the same drive if a family fits. `bullet`: the simulation.
/// It is compared with the equilibrium if hinges are elastic, otherwise with the exact state if a family fits.
/// Without either, the run is judged by its own closure alone.
/// @throws InvalidInput for a design that its model does not fit
Run run_design(Design design, Model model, RunOptions options);

/// Computes the state of what was found by its model, and its distance from the goal. @param goal null for a design
Run held(SearchResult found, const Goal* goal, const RunOptions& options);
/// Compensates the run for its elastic hinges, if the goal is of an exact family and has any. Adds a violation if the
/// drive stops before its goal.
Run settled(Run run, const Goal& goal, const RunOptions& options);

/// Runs the file of a missed goal with the changes that its kind suggests, and returns the one that meets it, else the
/// one that is nearest, as a sentence. Every change in the sentence was run. Empty if there are none to try.
std::string find_remedy(const Goal& goal, const Run& missed, RunOptions options);

/// Result of a search, and the goal that it was for.
struct Searched {
  std::shared_ptr<const Goal> goal;  ///< the given one, or the same with other cells
  SearchResult found;
};

/// Searches for a goal and chooses hinges that `export` would print. Cells that cannot be printed become larger, with
/// walls that the process needs, if the file leaves their sizes open. If the file gives them, its own design is the
/// result, and PrintAnswer::why names sizes that were searched and work.
/// @param goal must outlive the result
Searched search_printable(const Goal& goal, const RunOptions& options);

}  // namespace kinetix::app
