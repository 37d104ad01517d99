#pragma once

#include "app/run/goal_outcome.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {

/// Strain of an elastomer or living hinge.
struct HingeStrain {
  double strain = 0;   ///< ratio of lengths
  double allowed = 0;  ///< largest strain of the material, ratio of lengths
};

/// Returns the strain of the hinge with the largest ratio of strain to allowed strain, in the reported state.
/// @return nullopt without elastomer and living hinges, or without a state
std::optional<HingeStrain> worst_strain(const Run& run);

/// Returns the reasons why the run's process cannot print the sheet, or why its hinges do not fit. Empty for a run
/// without a goal, because the process of a design is not known.
std::vector<std::string> unprintable(const Run& run);

/// Returns label and text of each problem of made hinges, for the terminal:
/// PRINT: the process cannot print it. STRAINED: a hinge exceeds the strain of its material.
/// CORNERS: the two halves of a wall collide over the gap before the state is reached.
/// For all but PRINT, only the worst case is listed.
std::vector<std::pair<std::string, std::string>> hinge_problem_lines(const Run& run);

/// Returns these problems for result.json, with labels in lower case.
nlohmann::ordered_json hinge_problems_json(const Run& run);

/// Returns the section `as_made` of result.json. @pre run.printed
nlohmann::ordered_json print_tolerance_json(const Run& run);

/// Variance share of one hinge parameter for all hinges in one column or row.
struct ScatterShare {
  std::string place;  ///< "column 12": walls along x there, or all walls in a strip; "row 3": walls along y
  int parameter = 0;  ///< parameter index of model::ScatterSource
  double share = 0;   ///< share of the variance, [0, 1]
};
/// Returns variance shares by place, largest first. Empty for lattices other than squares, which have no columns.
std::vector<ScatterShare> sources_by_place(const Run& run);

/// Returns the reasons why prints miss the goal or cannot be made, one sentence each. Empty if prints keep it.
/// @pre run.printed
std::vector<std::string> print_failure_reasons(const Run& run);

/// Returns warnings about prints, except that they cannot be made. Prints may leave the goal, collide during motion, or
/// fold to the other side. The first-order estimate may disagree with sampled prints. @pre run.printed
std::vector<std::string> scatter_warnings(const Run& run);

/// Returns the summary lines of the print tolerance analysis and its largest sources. Empty without an analysis.
std::vector<SummaryLine> print_tolerance_lines(const Run& run);

}  // namespace kinetix::app
