#include "benchmarks/speed_error/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "benchmarks/speed_error/log_axis.hpp"
#include "benchmarks/speed_error/pareto.hpp"

namespace kinetix::bench {
namespace {

// Cell edges, rms: 1 %, 0.1 % and 0.01 %, as the columns of the table say.
constexpr std::array errors = {1e-2, 1e-3, 1e-4};

std::string ratio_label(double ratio) {
  return ratio < 1.005 ? "" : fmt::format(", {} x", count_label(ratio));
}

std::string cell(const MeasuredScene& scene, const MeasuredPoints& series, double error) {
  const auto own = fastest_at(series, error);
  if (!own) return "not reached";
  const double best = fastest_at(scene.points, error)->seconds;
  return fmt::format("**{}**{} ({}{})", time_label(own->seconds), ratio_label(own->seconds / best),
                     own->settings, own->is_result ? "" : "; " + own->status);
}

std::string row(const MeasuredScene& scene, const std::string& series) {
  std::string text = fmt::format("| {} | {} |", scene.name, series);
  for (const double error : errors) text += " " + cell(scene, of_series(scene.points, series), error) + " |";
  return text + "\n";
}

}  // namespace

std::string speed_error_table(const std::vector<MeasuredScene>& scenes) {
  std::string table = "| scene | method | 1 % | 0.1 % | 0.01 % |\n|---|---|---|---|---|\n";
  for (const MeasuredScene& scene : scenes)
    for (const std::string& series : series_in(scene.points)) table += row(scene, series);
  return table;
}

std::string spread_sentence(const std::vector<MeasuredScene>& scenes) {
  std::vector<double> spreads;
  for (const MeasuredScene& scene : scenes)
    for (const MeasuredPoint& point : scene.points)
      if (point.spread > 0) spreads.push_back(point.spread);
  if (spreads.empty()) return "";
  std::sort(spreads.begin(), spreads.end());
  const auto percentile = [&](double share) {
    return 100 * spreads[static_cast<std::size_t>(share * static_cast<double>(spreads.size() - 1))];
  };
  return fmt::format(
      "Of {} settings that ran more than once, the slowest run took longer than the fastest by {:.0f} % of "
      "the "
      "median in half of them, by more than {:.0f} % in a tenth.\n",
      spreads.size(), percentile(0.5), percentile(0.9));
}

}  // namespace kinetix::bench
