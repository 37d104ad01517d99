#include "app/sweep/metric.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/sweep/pose_metrics.hpp"
#include "model/invalid_input.hpp"
#include "targets/curve_error.hpp"
#include "targets/document_path.hpp"
#include "targets/wording.hpp"

namespace kinetix {
namespace {

using O = Observation;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double shape(const O& o, double CurveError::*part) {
  return curve_error(column_midline(*o.structure, *o.state), *o.goal).*part;
}

double moved_mm(const O& o, double StateDistance::*part) {
  return aligned_distance(*o.structure, *o.state, *o.nominal).*part * o.structure->size.edge_mm;
}

const LoadStep& last(const O& o) { return o.balance->path.steps.back(); }

template <class Value>
double largest(const O& o, Value value) {
  double most = -std::numeric_limits<double>::infinity();
  for (const LoadStep& step : o.balance->path.steps) most = std::max(most, value(step));
  return most;
}

/// Energy at the summit that a release from flat must pass to come to the next stable state.
double barrier(const O& o) {
  const auto& barriers = o.balance->stable.barriers;
  return barriers.empty() ? nan : barriers.front().energy;
}

const std::vector<Metric>& pose_metrics() {
  static const std::vector<Metric> metrics = {
      {"theta_deg", [](const O& o) { return to_degrees(o.theta); }},
      {"end_mm", [](const O& o) { return end_point(*o.structure, *o.state).norm(); }},
      {"end_x_mm", [](const O& o) { return end_point(*o.structure, *o.state).x(); }},
      {"end_y_mm", [](const O& o) { return end_point(*o.structure, *o.state).y(); }},
      {"end_z_mm", [](const O& o) { return end_point(*o.structure, *o.state).z(); }},
      {"turn_deg", [](const O& o) { return to_degrees(total_turn(*o.structure, *o.state)); }},
      {"area_ratio", [](const O& o) { return area_ratio(*o.structure, *o.state); }},
      {"fold_deg", [](const O& o) { return to_degrees(fold_angle(*o.structure, *o.state)); }},
      {"cell_angle_deg", [](const O& o) { return to_degrees(cell_angle(*o.structure, *o.state)); }},
      {"lean_max_deg", [](const O& o) { return to_degrees(largest_lean(*o.structure, *o.state)); }},
      {"size_x_mm", [](const O& o) { return extent(*o.state).x(); }},
      {"size_y_mm", [](const O& o) { return extent(*o.state).y(); }},
      {"size_z_mm", [](const O& o) { return extent(*o.state).z(); }},
      {"hinge_gap_max", [](const O& o) { return hinge_gaps(*o.structure, *o.state).max; }},
      {"hinge_gap_rms", [](const O& o) { return hinge_gaps(*o.structure, *o.state).rms; }},
      {"moved_rms_mm", [](const O& o) { return moved_mm(o, &StateDistance::rms); }, true},
      {"moved_max_mm", [](const O& o) { return moved_mm(o, &StateDistance::max); }, true},
  };
  return metrics;
}

const std::vector<Metric>& goal_metrics() {
  static const std::vector<Metric> metrics = {
      {"shape_rms", [](const O& o) { return shape(o, &CurveError::rms); }},
      {"shape_max", [](const O& o) { return shape(o, &CurveError::max); }},
  };
  return metrics;
}

const std::vector<Metric>& balance_metrics() {
  static const std::vector<Metric> metrics = {
      {"reached", [](const O& o) { return o.balance->reached() ? 1.0 : 0.0; }},
      {"compression",
       [](const O& o) { return o.balance->drive.kind == Drive::Kind::plates ? last(o).drive : nan; }},
      {"drive_rad",
       [](const O& o) { return o.balance->drive.kind == Drive::Kind::hinge ? last(o).drive : nan; }},
      {"load_N",
       [](const O& o) { return o.balance->drive.kind == Drive::Kind::plates ? last(o).load : nan; }},
      {"load_Nmm",
       [](const O& o) { return o.balance->drive.kind == Drive::Kind::hinge ? last(o).load : nan; }},
      {"energy_Nmm", [](const O& o) { return last(o).energy; }},
      {"load_peak",
       [](const O& o) { return largest(o, [](const LoadStep& s) { return std::abs(s.load); }); }},
      {"energy_peak_Nmm", [](const O& o) { return largest(o, [](const LoadStep& s) { return s.energy; }); }},
      {"gap_peak", [](const O& o) { return largest(o, [](const LoadStep& s) { return s.gap; }); }},
      {"barrier_Nmm", barrier},
      {"stable_states", [](const O& o) { return static_cast<double>(o.balance->stable.states.size()); }},
      {"exact_rms", [](const O& o) { return o.balance->from_exact ? o.balance->from_exact->rms : nan; }},
      {"exact_max", [](const O& o) { return o.balance->from_exact ? o.balance->from_exact->max : nan; }},
  };
  return metrics;
}

const std::vector<Metric>& physics_metrics() {
  static const std::vector<Metric> metrics = {
      {"verify_rms", [](const O& o) { return o.from_model.rms; }},
      {"verify_max", [](const O& o) { return o.from_model.max; }},
      {"hinge_axis_max_rad", [](const O& o) { return o.physics->gaps.axis_max; }},
      {"unrest", [](const O& o) { return o.physics->unrest; }},
  };
  return metrics;
}

/// Keys of `metrics` that searches write, of all kinds and models.
constexpr std::string_view search_names[] = {
    "theta_rad", "theta_limit_rad", "met",
    // curves
    "shape_rms", "shape_max",
    // displays
    "contrast", "auc", "separation", "rank", "contrast_rest", "auc_rest", "stretch_max", "contrast_physics",
    "auc_physics", "separation_physics", "rank_physics",
    // folds
    "fold_deg", "fold_miss_deg", "face_rms", "fold_physics_deg", "fold_miss_physics_deg", "face_rms_physics",
    // helmets
    "distance_rms_mm", "distance_max_mm", "rib_rms_mm", "uniform_rms_mm", "distance_rms_mm_physics",
    "distance_max_mm_physics",
    // balances and physics runs
    "reached", "compression", "load_N", "energy_Nmm", "hinge_gap_max", "hinge_gap_rms", "verify_rms",
    "verify_max", "hinge_axis_max_rad", "verified"};

double json_number(const nlohmann::ordered_json& metrics, const DocumentPath& path) {
  const nlohmann::ordered_json* at = &metrics;
  for (const PathStep& step : path) {
    if (step.key.empty()
            ? !at->is_array() || step.position < 0 || static_cast<std::size_t>(step.position) >= at->size()
            : !at->is_object() || !at->contains(step.key))
      return nan;
    at = step.key.empty() ? &(*at)[static_cast<std::size_t>(step.position)] : &(*at)[step.key];
  }
  if (at->is_boolean()) return at->get<bool>() ? 1 : 0;
  return at->is_number() ? at->get<double>() : nan;
}

std::vector<Metric> metrics_of(const MetricContext& context) {
  std::vector<Metric> all = pose_metrics();
  const auto add = [&](const std::vector<Metric>& more) { all.insert(all.end(), more.begin(), more.end()); };
  if (context.searches) return all;
  if (context.has_goal) add(goal_metrics());
  if (context.model == Model::equilibrium) add(balance_metrics());
  if (context.model == Model::bullet) add(physics_metrics());
  return all;
}

}  // namespace

std::vector<std::string> metric_names(const MetricContext& context) {
  std::vector<std::string> names;
  if (context.searches) names.assign(std::begin(search_names), std::end(search_names));
  for (const Metric& metric : metrics_of(context))
    if (std::find(names.begin(), names.end(), metric.name) == names.end()) names.push_back(metric.name);
  return names;
}

Metric find_metric(const std::string& name, const MetricContext& context) {
  if (context.searches) {
    const DocumentPath path = parse_path(name);
    if (std::find(std::begin(search_names), std::end(search_names), path[0].key) != std::end(search_names))
      return {name, [path](const O& o) { return json_number(*o.metrics, path); }};
  }
  for (const Metric& metric : metrics_of(context))
    if (metric.name == name) return metric;
  const auto names = metric_names(context);
  const std::vector<std::string_view> views(names.begin(), names.end());
  if (!context.has_goal && !context.searches && (name == "shape_rms" || name == "shape_max"))
    throw InvalidInput(in_ticks(name) + " needs `goal: FILE.yaml`, the curve target to measure against");
  throw InvalidInput(in_ticks(name) + " is not a metric of this model" + did_you_mean(name, views) +
                     "; allowed: " + joined(views));
}

}  // namespace kinetix
