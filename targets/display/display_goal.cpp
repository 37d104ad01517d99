#include "targets/display/display_goal.hpp"

#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

std::string panel_text(PanelSize size) {
  return "a panel of " + std::to_string(size[0]) + " x " + std::to_string(size[1]) + " cells";
}

/// Gives each cell the level of the cell of `goal` that contains its middle. The result is whole if all cells of
/// `goal` become blocks of the same size.
DisplayGoal enlarged(const DisplayGoal& goal, PanelSize size) {
  std::vector<double> levels;
  for (int j = 0; j < size[1]; ++j)
    for (int i = 0; i < size[0]; ++i)
      levels.push_back(
          goal.level((2 * i + 1) * goal.columns / (2 * size[0]), (2 * j + 1) * goal.rows / (2 * size[1])));
  DisplayGoal out = make_goal(size, std::move(levels));
  out.whole = size[0] % goal.columns == 0 && size[1] % goal.rows == 0;
  out.resized = [own = goal](PanelSize other) { return enlarged(own, other); };
  return out;
}

}  // namespace

bool DisplayGoal::is_binary() const {
  return std::all_of(levels.begin(), levels.end(), [](double level) { return level == 0 || level == 1; });
}

std::vector<std::string> DisplayGoal::row_texts() const {
  std::vector<std::string> texts;
  for (int j = rows - 1; j >= 0; --j) {
    std::string& text = texts.emplace_back();
    for (int i = 0; i < columns; ++i) text += is_letter(i, j) ? '1' : '0';
  }
  return texts;
}

void check_panel(PanelSize size) {
  const auto [shorter, longer] = std::minmax(size[0], size[1]);
  if (shorter < min_panel_side) throw InvalidInput(panel_text(size) + " is too small. Give at least 2 x 2");
  if (longer > max_panel_side || static_cast<long>(shorter) * longer > max_panel_cells)
    throw InvalidInput(panel_text(size) + " is too large. Give at most " + std::to_string(max_panel_side) +
                       " cells per side and " + std::to_string(max_panel_cells) + " in all");
}

void check_contrast(const DisplayGoal& goal) {
  const auto [least, most] = std::minmax_element(goal.levels.begin(), goal.levels.end());
  if (*least < *most) return;
  const std::string help =
      goal.whole ? "Give cells of both kinds"
      : goal.needed
          ? "Give more cells: the smallest panel of these proportions that shows the whole picture is [" +
                std::to_string((*goal.needed)[0]) + ", " + std::to_string((*goal.needed)[1]) + "]"
          : "Give a simpler picture: no allowed panel of these proportions shows the whole of it";
  throw InvalidInput("every cell is " + std::string(*least >= letter_level ? "letter" : "rest") +
                     ", so there is nothing to distinguish. " + help);
}

DisplayGoal make_goal(PanelSize size, std::vector<double> levels) {
  check_panel(size);
  assert(levels.size() == static_cast<std::size_t>(size[0]) * size[1]);
  DisplayGoal goal;
  goal.columns = size[0];
  goal.rows = size[1];
  goal.levels = std::move(levels);
  check_contrast(goal);
  return goal;
}

std::vector<double> thresholded(std::vector<double> levels) {
  for (double& level : levels) level = level >= letter_level ? 1 : 0;
  return levels;
}

void check_row(const std::string& row, std::size_t columns) {
  const std::size_t wrong = row.find_first_not_of("01");
  if (wrong != std::string::npos)
    throw InvalidInput(
        in_ticks(row) +
        " has characters other than 0 and 1. Give 1 for a cell of the letter and 0 for the rest");
  if (row.size() != columns)
    throw InvalidInput("has " + std::to_string(row.size()) + " cells, and the first row has " +
                       std::to_string(columns) + ". Give rows of equal length");
}

DisplayGoal rows_goal(const std::vector<std::string>& rows) {
  if (rows.empty()) throw InvalidInput("the list has no rows. Give rows of 0 and 1, top row first");
  std::vector<double> levels;
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    check_row(*row, rows[0].size());
    for (const char c : *row) levels.push_back(c == '1' ? 1 : 0);
  }
  DisplayGoal goal =
      make_goal({static_cast<int>(rows[0].size()), static_cast<int>(rows.size())}, std::move(levels));
  goal.resized = [own = goal](PanelSize size) { return enlarged(own, size); };
  return goal;
}

std::vector<double> levels_of(const DisplayGoal& goal, const model::Lattice& panel) {
  std::vector<double> levels;
  for (int c = 0; c < panel.cells(); ++c)
    if (const std::vector<int> at = cell_label(panel, c); at.size() == 2)
      levels.push_back(goal.level(at[0], at[1]));
  return levels;
}

std::vector<double> in_order_of_goal(const DisplayGoal& goal, const model::Lattice& panel,
                                     const std::vector<double>& values) {
  std::vector<double> out(goal.levels.size());
  std::size_t next = 0;
  for (int c = 0; c < panel.cells(); ++c)
    if (const std::vector<int> at = cell_label(panel, c); at.size() == 2)
      out[static_cast<std::size_t>(at[1]) * goal.columns + at[0]] = values[next++];
  return out;
}

namespace {

// Largest difference of two channel values that counts as none, in the channel's unit: above rounding. A smaller one
// would rank equal cells; a larger one would hide faint pictures.
constexpr double same = 1e-5;

/// Returns ranks from 1. Equal values share their mean rank. NaN values come last, each with a separate rank.
std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::isnan(values[b]) ? !std::isnan(values[a]) : values[a] < values[b];
  });
  std::vector<double> out(values.size());
  for (std::size_t from = 0, to = 0; from < order.size(); from = to) {
    to = from + 1;
    while (to < order.size() && values[order[to]] - values[order[from]] <= same) ++to;
    const double mean = (static_cast<double>(from + to) + 1) / 2;
    for (std::size_t k = from; k < to; ++k) out[order[k]] = mean;
  }
  return out;
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double variance(const std::vector<double>& values, double mean) {
  double sum = 0;
  for (const double v : values) sum += (v - mean) * (v - mean);
  return sum / static_cast<double>(values.size());
}

double contrast(double difference, double deviation) {
  if (std::abs(difference) <= same) return 0;
  return difference / std::max(deviation, same);
}

}  // namespace

DisplayScore display_score(const std::vector<double>& channel, const std::vector<double>& levels) {
  std::vector<double> letter, rest;
  for (std::size_t k = 0; k < channel.size(); ++k) (levels[k] >= 0.5 ? letter : rest).push_back(channel[k]);
  DisplayScore score;
  score.letter = mean_of(letter);
  score.rest = mean_of(rest);
  const double deviation = std::sqrt((variance(letter, score.letter) + variance(rest, score.rest)) / 2);
  score.contrast = contrast(score.separation(), deviation);
  if (!std::isfinite(score.letter + score.rest)) {
    score.contrast = score.auc = std::numeric_limits<double>::quiet_NaN();
    return score;
  }
  const std::vector<double> rank = ranks(channel);
  double sum = 0;
  for (std::size_t k = 0; k < rank.size(); ++k) sum += levels[k] >= 0.5 ? rank[k] : 0;
  const double n = static_cast<double>(letter.size()), m = static_cast<double>(rest.size());
  score.auc = (sum - n * (n + 1) / 2) / (n * m);
  return score;
}

double rank_correlation(const std::vector<double>& channel, const std::vector<double>& levels) {
  const std::vector<double> a = ranks(channel), b = ranks(levels);
  const double mean = mean_of(a), deviations = std::sqrt(variance(a, mean) * variance(b, mean));
  if (!(deviations > 0)) return 0;
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - mean) * (b[k] - mean);
  return sum / static_cast<double>(a.size()) / deviations;
}

}  // namespace kinetix::targets
