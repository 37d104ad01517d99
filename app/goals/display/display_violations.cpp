#include "app/goals/display/display_violations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kinetix::app {
namespace {

constexpr double widest_stroke = 2.7;  // cells: contrast was measured to grow less beyond
constexpr double largest_factor = 4;   // of the sides

targets::PanelSize scaled_panel(const targets::DisplayGoal& goal, double factor) {
  const auto side = [factor](int cells) { return static_cast<int>(std::ceil(factor * cells - 1e-9)); };
  return {side(goal.columns), side(goal.rows)};
}

bool is_allowed_panel(targets::PanelSize size) {
  return std::max(size[0], size[1]) <= targets::max_panel_side &&
         static_cast<long>(size[0]) * size[1] <= targets::max_panel_cells;
}

}  // namespace

std::vector<std::string> violations(const DisplayFile& file, const targets::DisplayScore& score, double rank,
                                    const std::string& who) {
  std::vector<std::string> why;
  const bool binary = file.goal.is_binary();
  const double told = binary ? score.auc : rank;
  if (!(told >= file.auc))
    why.push_back(fmt::format("{}: {} {:.3f}; at least {:.3f} is required", who,
                              binary ? "auc" : "rank correlation", told, file.auc));
  if (binary && !(score.contrast >= file.contrast))
    why.push_back(
        fmt::format("{}: contrast {:.2f}; at least {:.2f} is required", who, score.contrast, file.contrast));
  return why;
}

double stroke_width(const targets::DisplayGoal& goal) {
  int cells = 0, edges = 0;
  for (int j = 0; j < goal.rows; ++j)
    for (int i = 0; i < goal.columns; ++i) {
      cells += goal.is_letter(i, j);
      edges += i > 0 && goal.is_letter(i, j) != goal.is_letter(i - 1, j);
      edges += j > 0 && goal.is_letter(i, j) != goal.is_letter(i, j - 1);
    }
  return 2.0 * cells / edges;
}

std::optional<targets::PanelSize> estimate_panel(const targets::DisplayGoal& goal, double contrast,
                                                 double required, double most_growth) {
  if (!goal.is_binary() || !goal.redrawn || !(contrast > 0 && contrast < required)) return std::nullopt;
  const double growth = std::min(most_growth, contrast * contrast / stroke_width(goal)),
               width = required * required / growth, cell = 1.0 / std::max(goal.columns, goal.rows);
  if (!(width <= widest_stroke)) return std::nullopt;
  for (double factor = 1 + cell; factor <= largest_factor + cell / 2; factor += cell) {
    const targets::PanelSize size = scaled_panel(goal, factor);
    if (!is_allowed_panel(size)) break;
    const targets::DisplayGoal larger = goal.redrawn(size);
    if (larger.whole && stroke_width(larger) >= width) return size;
  }
  return std::nullopt;
}

}  // namespace kinetix::app
