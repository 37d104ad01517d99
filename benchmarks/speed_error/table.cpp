#include "benchmarks/speed_error/table.hpp"

#include <fmt/format.h>

#include <array>

#include "benchmarks/speed_error/log_axis.hpp"
#include "benchmarks/speed_error/pareto.hpp"

namespace kinetix::bench {
namespace {

constexpr std::array errors = {1e-2, 1e-3, 1e-4};

std::string ratio_label(double ratio) {
  if (ratio < 1.005) return "";
  return fmt::format(", {} x", ratio < 9.95 ? fmt::format("{:.1f}", ratio) : fmt::format("{:.0f}", ratio));
}

std::string cell(const MeasuredScene& scene, const MeasuredPoints& series, double error) {
  const auto own = fastest_at(series, error);
  if (!own) return "not reached";
  const double best = fastest_at(scene.points, error)->seconds;
  return fmt::format("**{}**{} ({}{})", time_label(own->seconds), ratio_label(own->seconds / best), own->settings,
                     own->is_result ? "" : "; " + own->status);
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

}  // namespace kinetix::bench
