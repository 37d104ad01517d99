#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "model/base/invalid_input.hpp"
#include "optim/doe/analysis.hpp"
#include "optim/doe/random.hpp"

namespace kinetix::optim {
namespace {

using Rows = std::vector<Eigen::Index>;

/// Mean and sum of squares about it, in one pass (Welford, Technometrics 4, 419, 1962).
struct Moments {
  std::int64_t count = 0;
  double mean = 0, squares = 0;

  void add(double x) {
    const double off = x - mean;
    mean += off / static_cast<double>(++count);
    squares += off * (x - mean);
  }
};

double standard_error(const Moments& moments) {
  const double n = static_cast<double>(moments.count);
  return moments.count < 2 ? nan : std::sqrt(moments.squares / (n - 1) / n);
}

/// Returns the places in `sorted` where a new value of the factor begins, and their end.
std::vector<std::size_t> value_starts(const SampleMatrix& samples, Eigen::Index j, const Rows& sorted) {
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < sorted.size(); ++i)
    if (i == 0 || samples(sorted[i], j) != samples(sorted[i - 1], j)) starts.push_back(i);
  starts.push_back(sorted.size());
  return starts;
}

/// Returns the starts of the bins. Each is the first start at or above the bin's even share of the rows.
std::vector<std::size_t> bin_starts(const std::vector<std::size_t>& starts, int bins) {
  std::vector<std::size_t> chosen;
  for (int k = 0; k <= bins; ++k) {
    const std::size_t share = starts.back() * k / bins;
    const std::size_t start = *std::lower_bound(starts.begin(), starts.end(), share);
    if (chosen.empty() || start > chosen.back()) chosen.push_back(start);
  }
  return chosen;
}

struct Table {
  const SampleMatrix& samples;
  std::span<const double> responses;
};

struct LevelMoments {
  EffectLevel level;
  Moments moments;
};

LevelMoments read_level(const Table& table, Eigen::Index j, std::span<const Eigen::Index> rows) {
  LevelMoments read{{table.samples(rows.front(), j), table.samples(rows.back(), j), nan, nan, 0, 0}, {}};
  for (const Eigen::Index i : rows)
    if (std::isfinite(table.responses[i]))
      read.moments.add(table.responses[i]);
    else
      ++read.level.failed;
  read.level.used = read.moments.count;
  if (read.moments.count > 0) read.level.mean = read.moments.mean;
  read.level.standard_error = standard_error(read.moments);
  return read;
}

double variance_share(const std::vector<Moments>& levels, TableRows rows) {
  double within = 0, sum = 0, count = 0, filled = 0;
  for (const Moments& moments : levels) {
    within += moments.squares;
    sum += moments.mean * static_cast<double>(moments.count);
    count += static_cast<double>(moments.count);
    filled += moments.count > 0 ? 1 : 0;
  }
  double between = 0;
  for (const Moments& moments : levels) {
    const double off = moments.mean - sum / count;
    between += static_cast<double>(moments.count) * off * off;
  }
  if (rows == TableRows::related || !(count > filled && between + within > 0)) return nan;
  const double by_chance = rows == TableRows::grid ? 0 : (filled - 1) * within / (count - filled);
  return (between - by_chance) / (between + within);
}

Moments without(const Moments& moments, double x) {
  if (moments.count < 2) return {};
  const double left = static_cast<double>(moments.count - 1);
  const double mean = moments.mean - (x - moments.mean) / left;
  return {moments.count - 1, mean, std::max(moments.squares - (x - moments.mean) * (x - mean), 0.0)};
}

/// Response and its level.
struct Placed {
  std::size_t level;
  double response;
};

/// Returns the standard error of the share, from the tables that lack one row (Efron, Stein, Ann. Statist. 9,
/// 586, 1981).
double share_error(std::vector<Moments> levels, const std::vector<Placed>& placed) {
  Moments shares;
  for (const auto& [level, response] : placed) {
    const Moments whole = std::exchange(levels[level], without(levels[level], response));
    shares.add(variance_share(levels, TableRows::independent));
    levels[level] = whole;
  }
  const double n = static_cast<double>(shares.count);
  return std::sqrt(shares.squares * (n - 1) / n);
}

void add_shares(const std::vector<Moments>& levels, const std::vector<Placed>& placed, TableRows rows,
                MainEffect& effect) {
  constexpr double sds = 1.96;  // standard deviations of 95 %
  effect.variance_share = variance_share(levels, rows);
  effect.share_lower = effect.share_upper = nan;
  if (rows != TableRows::independent || std::isnan(effect.variance_share)) return;
  const double off = sds * share_error(levels, placed);
  if (std::isnan(off)) return;
  effect.share_lower = std::clamp(effect.variance_share - off, 0.0, 1.0);
  effect.share_upper = std::clamp(effect.variance_share + off, 0.0, 1.0);
}

Rows sorted_by_value(const SampleMatrix& samples, Eigen::Index j, Rows rows) {
  std::stable_sort(rows.begin(), rows.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return samples(a, j) < samples(b, j); });
  return rows;
}

/// Levels, and the data of their rows that the share needs.
struct Levels {
  std::vector<EffectLevel> said;
  std::vector<Moments> moments;
  std::vector<Placed> placed;
};

/// @param starts places in `sorted` where levels begin, and their end
Levels levels_at(const std::vector<std::size_t>& starts, const Table& table, Eigen::Index j,
                 const Rows& sorted, TableRows rows) {
  Levels levels;
  for (std::size_t k = 0; k + 1 < starts.size(); ++k) {
    const auto rows_of_level = std::span(sorted).subspan(starts[k], starts[k + 1] - starts[k]);
    LevelMoments read = read_level(table, j, rows_of_level);
    if (rows == TableRows::related) read.level.standard_error = nan;
    for (const Eigen::Index i : rows_of_level)
      if (std::isfinite(table.responses[i])) levels.placed.push_back({k, table.responses[i]});
    levels.said.push_back(read.level);
    levels.moments.push_back(read.moments);
  }
  return levels;
}

/// Computes the effect of factor j. A grid's share uses all its levels, since bins lose the changes within
/// them.
MainEffect effect(const Table& table, Eigen::Index j, const Rows& rows, const MainEffectOptions& options) {
  const Rows sorted = sorted_by_value(table.samples, j, rows);
  const std::vector<std::size_t> starts = value_starts(table.samples, j, sorted);
  MainEffect effect;
  effect.binned = starts.size() > static_cast<std::size_t>(options.max_values) + 1;
  Levels levels =
      levels_at(effect.binned ? bin_starts(starts, options.bins) : starts, table, j, sorted, options.rows);
  effect.levels = levels.said;
  if (effect.binned && options.rows == TableRows::grid)
    levels = levels_at(starts, table, j, sorted, options.rows);
  add_shares(levels.moments, levels.placed, options.rows, effect);
  return effect;
}

/// Returns the one factor in which row i differs from the base, or -1 if there is none.
Eigen::Index factor_off_base(const SampleMatrix& samples, Eigen::Index i) {
  Eigen::Index moved = -1;
  for (Eigen::Index j = 0; j < samples.cols(); ++j) {
    if (samples(i, j) == samples(0, j)) continue;
    if (moved >= 0)
      throw InvalidInput(fmt::format(
          "sample {} differs from the base in factors {} and {}, must differ in one", i, moved, j));
    moved = j;
  }
  return moved;
}

}  // namespace

double sample_quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

void ConfidenceOptions::validate() const {
  if (!(level > 0 && level < 1))
    throw InvalidInput(fmt::format("confidence level is {}, must be above 0 and below 1", level));
  if (!(resamples >= 2 && resamples <= 100'000))
    throw InvalidInput(fmt::format("resamples is {}, must be 2 to 100000", resamples));
}

Estimate percentile_estimate(double value, std::vector<double> resampled, double level) {
  std::erase_if(resampled, [](double x) { return !std::isfinite(x); });
  if (!std::isfinite(value) || resampled.empty()) return {value, nan, nan};
  std::sort(resampled.begin(), resampled.end());
  const double outside = (1 - level) / 2;
  return {value, sample_quantile(resampled, outside), sample_quantile(resampled, 1 - outside)};
}

std::uint64_t resampled_row(std::uint64_t seed, int resample, std::uint64_t draw, std::uint64_t rows) {
  return random_bits(seed, RandomStream::bootstrap, draw, static_cast<std::uint32_t>(resample)) % rows;
}

void check_table(const SampleMatrix& samples, std::span<const double> responses) {
  if (samples.cols() == 0) throw InvalidInput("the table has no factors, must have one or more");
  if (samples.rows() != static_cast<Eigen::Index>(responses.size()))
    throw InvalidInput(
        fmt::format("{} responses for {} samples, must be one for each", responses.size(), samples.rows()));
  for (Eigen::Index j = 0; j < samples.cols(); ++j)
    for (Eigen::Index i = 0; i < samples.rows(); ++i)
      if (!std::isfinite(samples(i, j)))
        throw InvalidInput(fmt::format("factor {} of sample {} is {}, must be finite", j, i, samples(i, j)));
}

std::vector<Eigen::Index> usable_rows(std::span<const double> responses) {
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < responses.size(); ++i)
    if (std::isfinite(responses[i])) rows.push_back(static_cast<Eigen::Index>(i));
  return rows;
}

void MainEffectOptions::validate() const {
  if (!(max_values >= 1)) throw InvalidInput(fmt::format("most_values is {}, must be 1 or more", max_values));
  if (!(bins >= 1)) throw InvalidInput(fmt::format("bins is {}, must be 1 or more", bins));
}

std::vector<MainEffect> main_effects(const SampleMatrix& samples, std::span<const double> responses,
                                     const MainEffectOptions& options) {
  options.validate();
  check_table(samples, responses);
  Rows all(samples.rows());
  std::iota(all.begin(), all.end(), 0);
  std::vector<MainEffect> effects;
  for (Eigen::Index j = 0; j < samples.cols(); ++j)
    effects.push_back(effect({samples, responses}, j, all, options));
  return effects;
}

std::vector<MainEffect> one_factor_effects(const SampleMatrix& samples, std::span<const double> responses) {
  check_table(samples, responses);
  if (samples.rows() == 0) throw InvalidInput("the table has no samples, must have the base");
  std::vector<Rows> rows(samples.cols(), Rows{0});
  for (Eigen::Index i = 1; i < samples.rows(); ++i)
    if (const Eigen::Index j = factor_off_base(samples, i); j >= 0) rows[j].push_back(i);
  std::vector<MainEffect> effects;
  for (Eigen::Index j = 0; j < samples.cols(); ++j) {
    effects.push_back(effect({samples, responses}, j, rows[j],
                             {.max_values = std::numeric_limits<int>::max(), .rows = TableRows::related}));
  }
  return effects;
}

}  // namespace kinetix::optim
