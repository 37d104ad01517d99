#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/goals/display/display_file.hpp"
#include "targets/display/display_goal.hpp"
#include "targets/display/display_score.hpp"

namespace kinetix::app {

/// Bytes of the machine's memory.
std::size_t memory_of_machine();

/// @param runs searches, of which `threads` go on at a time (0: all cores)
/// @throws InvalidInput for a panel whose search would take more than `available` bytes: about 50 kB a cell
/// for each search, as measured on panels of 30 x 30 and 60 x 60 cells
void check_memory(targets::PanelSize size, int threads, int runs, std::size_t available);

/// Describes what a view lacks of the auc (rank correlation for grey goals) and contrast that the file requires.
/// @param rank rank correlation, [-1, 1]
std::vector<std::string> violations(const DisplayFile& file, const targets::DisplayScore& score, double rank,
                                    const std::string& who);

/// Mean width of the strokes, cells: w = 2 A / P, with A letter cells and P edges between letter and rest. A straight stroke of
/// n cells is n wide when its ends are left out. @pre a binary goal
double stroke_width(const targets::DisplayGoal& goal);

/// Estimates how large a panel shows a picture with the required contrast; no search confirms it.
///
/// Only cells at the edge of a stroke share walls with the rest. Their share, and so the variance within letter and rest, falls
/// as 1 / w. Contrast d' is the difference of the means over the root of that variance, so d'^2 = g w. The estimate is the
/// smallest panel on which the picture is whole and its strokes are w = required^2 / g wide. The page of formats has the
/// measurements behind it.
/// @param contrast measured on the panel of `goal`, which gives g = contrast^2 / w
/// @param most_growth limit of g; infinity for none
/// @return nothing for pictures of grey levels, and if no such panel of up to four times the sides is found
std::optional<targets::PanelSize> estimate_panel(const targets::DisplayGoal& goal, double contrast,
                                                 double required, double most_growth);

/// The growth g that panels found by the scales of walls can rely on.
inline constexpr double usual_growth = 10;

}  // namespace kinetix::app
