#include "app/goals/space_curve/space_curve_outcome.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/run/run.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

Json space_points_json(const std::vector<Eigen::Vector3d>& points) {
  Json out = Json::array();
  for (const Eigen::Vector3d& p : points) out.push_back({p.x(), p.y(), p.z()});
  return out;
}

Json distances_json(const targets::SpaceError& error) {
  Json out = Json::array();
  for (std::size_t k = 0; k < error.arc_mm.size(); ++k)
    out.push_back({error.arc_mm[k], error.distance_mm[k]});
  return out;
}

/// What each column does: it bends or it shears. A column that bends has half of its turn behind it where its midline goes.
/// @param midline of a state whose width lies along y
Json columns_json(const std::vector<Eigen::Vector3d>& midline) {
  Json out = Json::array();
  double before = 0;  // heading, rad
  for (int k = 0; k + 1 < static_cast<int>(midline.size()); ++k) {
    const Eigen::Vector3d way = midline[k + 1] - midline[k];
    const double heading = std::atan2(way.z(), way.x());
    if (optim::SpaceStrip::bends(k))
      out.push_back({{"column", k}, {"turn_deg", to_degrees(2 * std::remainder(heading - before, 2 * pi))}});
    else
      out.push_back({{"column", k}, {"climb", way.y() / std::hypot(way.x(), way.z())}});
    before = heading;
  }
  return out;
}

}  // namespace

void SpaceCurveOutcome::add_sections(const Run& run, Json& result) const {
  result["target"] = {{"kind", "space_curve"}, {"points_mm", space_points_json(file.wanted.points())}};
  const auto& shape = measure_of<SpaceCurveMeasure>(run);
  const targets::SpaceError& error = shape.error;
  Json section = {
      {"goal_mm", space_points_json(error.goal_mm)},
      {"error", distances_json(error)},
      {"diagonal_mm", error.scale_mm},
      {"slope", found.across.slope},
      {"across", {found.across.direction.x(), found.across.direction.y(), found.across.direction.z()}},
      {"columns", columns_json(shape.midline)},
      {"walls_meet", !found.walls_are_free},
      {"reasons", run.violations},
      {"reasons_physics", run.physics_violations()}};
  if (const auto* physics = physics_measure_of<SpaceCurveMeasure>(run))
    section["physics"] = {{"rms", physics->error.rms}, {"max", physics->error.max}};
  result["space_curve"] = section;
  result["optimiser"] = {{"solver", "ceres"},
                         {"starts", std::max(1, found.tried)},
                         {"evaluations", found.search.evaluations},
                         {"status", to_string(found.search.status)},
                         {"why", found.search.why}};
}

void SpaceCurveOutcome::add_metrics(const Run& run, Json& metrics) const {
  const targets::SpaceError& error = measure_of<SpaceCurveMeasure>(run).error;
  metrics["shape_rms"] = error.rms;
  metrics["shape_max"] = error.max;
  if (const auto* physics = physics_measure_of<SpaceCurveMeasure>(run))
    metrics["shape_rms_physics"] = physics->error.rms;
  metrics["met"] = run.met();
}

std::vector<SummaryLine> SpaceCurveOutcome::summary_lines(const Run& run) const {
  const targets::SpaceError& error = measure_of<SpaceCurveMeasure>(run).error;
  std::vector<SummaryLine> lines;
  lines.push_back(
      {"shape",
       fmt::format("rms {:.2e} of the goal's diagonal ({:.3f} mm from curve to curve), largest {:.3f} mm: {}",
                   error.rms, error.rms * error.scale_mm, error.max * error.scale_mm,
                   tolerance_words(run, error.rms <= file.shape_tolerance))});
  const Eigen::Vector3d& y = found.across.direction;
  lines.push_back(
      {"across", fmt::format("the strip's width lies along [{:.3f}, {:.3f}, {:.3f}], along which the curve "
                             "climbs by at most {:.3f} of its length",
                             y.x(), y.y(), y.z(), found.across.slope)});
  lines.push_back({"search", fmt::format("{:.3f} s, {} evaluations, {}", run.timings.optimise,
                                         found.search.evaluations, to_string(found.search.status))});
  return lines;
}

std::vector<std::string> violations(const SpaceCurveFile& file, const targets::SpaceError& error,
                                    const std::string& who) {
  if (error.rms <= file.shape_tolerance) return {};
  return {fmt::format("{}: rms {:.3g} of the goal's diagonal; at most {:g} is allowed: use more columns", who,
                      error.rms, file.shape_tolerance)};
}

}  // namespace kinetix::app
