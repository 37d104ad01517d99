#include <fmt/format.h>

#include "benchmarks/figure.hpp"
#include "benchmarks/speed_error/log_axis.hpp"
#include "benchmarks/speed_error/measurements.hpp"
#include "benchmarks/speed_error/pareto.hpp"
#include "benchmarks/speed_error/plot.hpp"
#include "benchmarks/speed_error/table.hpp"

namespace kinetix::bench {
namespace {

// Error in cell edges, rms: 0.1 %, at which the plot compares times. And how many times faster the exact
// model must be.
constexpr double required_error = 1e-3, required_speedup = 1e4;

/// @param points of the engine
Figure exact_against(const MeasuredScene& scene, const MeasuredPoints& points, const std::string& solver) {
  Figure figure{scene.name + ": exact model against Bullet at 0.1 % of a cell edge, " + solver,
                fmt::format(">= {} times faster", count_label(required_speedup)),
                "no setting of the grid reaches it", false};
  const auto exact = fastest_at(of_series(scene.points, "exact"), required_error);
  const auto bullet = fastest_at(points, required_error);
  if (!exact || !bullet) return figure;
  const double times = bullet->seconds / exact->seconds;
  figure.measured = fmt::format("{} times ({} against {}: {}, {}, error {:.1e})", count_label(times),
                                time_label(exact->seconds), time_label(bullet->seconds), series_of(*bullet),
                                bullet->settings, bullet->error);
  figure.met = times >= required_speedup;
  return figure;
}

}  // namespace

std::vector<Figure> speed_error_figures() {
  std::vector<Figure> figures;
  for (const MeasuredScene& scene : speed_error_measurements()) {
    if (!scene.name.ends_with("columns")) continue;
    figures.push_back(exact_against(scene, of_bullet(scene.points), "fastest of all settings"));
  }
  return figures;
}

std::string speed_error_section() {
  const std::vector<MeasuredScene>& scenes = speed_error_measurements();
  return speed_error_table(scenes) + "\n" + spread_sentence(scenes);
}

std::string speed_error_picture() { return speed_error_plot(speed_error_measurements()); }

}  // namespace kinetix::bench
