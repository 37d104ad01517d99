#pragma once

#include "app/goals/display/display_file.hpp"
#include "targets/display/display_goal.hpp"

namespace kinetix::app {

/// Returns the machine's memory in bytes.
std::size_t memory_of_machine();

/// Checks that the search of a panel fits into memory. A search takes about 50 kB per cell, measured on panels of
/// 30 x 30 and 60 x 60 cells. @param runs number of searches; `threads` of them run at a time (0: all cores)
/// @throws InvalidInput if the searches would take more than `available` bytes
void check_memory(targets::PanelSize size, int threads, int runs, std::size_t available);

/// Describes violations of the required auc (rank correlation for grey goals) and contrast.
/// @param rank rank correlation, [-1, 1]   @param who name of the state in the text
std::vector<std::string> violations(const DisplayFile& file, const targets::DisplayScore& score, double rank,
                                    const std::string& who);

/// Returns the mean width of the strokes in cells: w = 2 A / P, with A letter cells and P edges between letter and
/// rest. For a straight stroke n cells wide, w = n without its ends. @pre a binary goal
double stroke_width(const targets::DisplayGoal& goal);

/// Estimates the size of a panel that shows a picture with the required contrast. No search confirms the estimate.
///
/// Only cells at the edge of a stroke share walls with the rest. Their share falls as 1 / w, and so does the variance
/// within letter and rest. Contrast d' is the difference of the means over the root of that variance, so d'^2 = g w.
/// The estimate is the smallest panel on which the picture is whole and its strokes are w = required^2 / g wide.
/// formats.md has the measurements behind it.
/// @param contrast measured on the panel of `goal`; it gives g = contrast^2 / w.
/// @param max_growth limit of g; infinity for none
/// @return nullopt for grey pictures, and if no such panel exists up to four times the sides
std::optional<targets::PanelSize> estimate_panel(const targets::DisplayGoal& goal, double contrast,
                                                 double required, double max_growth);

/// Largest growth g = d'^2 / w to expect from panels found by scaling of walls, dimensionless.
inline constexpr double max_scaled_growth = 10;

}  // namespace kinetix::app
