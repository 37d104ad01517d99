#include "app/sweep/plan/metric.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "app/goals/registry.hpp"
#include "model/assembly/assembly.hpp"
#include "model/base/algorithms.hpp"
#include "optim/doe/analysis.hpp"
#include "targets/document/edit_document.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Computes the normal of the polygon of a cell's bodies, with the polygon's area as its length, mm2.
Vector3d area_vector(std::span<const int> bodies, const model::State& state) {
  const Vector3d& first = state[bodies[0]].p;
  Vector3d twice = Vector3d::Zero();
  for (std::size_t k = 2; k < bodies.size(); ++k)
    twice += (state[bodies[k - 1]].p - first).cross(state[bodies[k]].p - first);
  return 0.5 * twice;
}

/// Sums the areas of all cells, mm2.
double area(const model::Lattice& structure, const model::State& state) {
  double sum = 0;
  for (int c = 0; c < structure.cells(); ++c) sum += area_vector(structure.cell_bodies(c), state).norm();
  return sum;
}

double angle_between(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

Vector3d extent_of(const model::Assembly& assembly, const model::State& state) {
  if (!is_finite(state)) return Vector3d::Constant(std::nan(""));
  Eigen::AlignedBox3d box;
  for (std::size_t b = 0; b < state.size(); ++b)
    for (const Vector3d& p : assembly.bodies[b].solid.points)
      box.extend(state[b].p + state[b].R * (p - assembly.bodies[b].position));
  return box.sizes();
}

/// Numbers of a state. Lengths are in mm, angles in rad. NaN in the state gives NaN; so does a structure
/// without cells.
/// Vector from the first body (lowest column, then row) to the last.
Vector3d end_point(const model::Lattice&, const model::State& state) {
  return state.back().p - state.front().p;
}

/// Computes the turn of the midline from its first segment to its last, summed from column to column. It may
/// exceed a full turn. The midline is the mean of the bodies of each column, seen along y.
double total_turn(const model::Lattice& structure, const model::State& state) {
  const auto points = column_midline(structure, state);
  double turn = 0;
  for (std::size_t k = 2; k < points.size(); ++k) {
    const Vector2d before = points[k - 1] - points[k - 2], after = points[k] - points[k - 1];
    turn += std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
  }
  return turn;
}

/// Computes the area between the bodies of each cell, divided by that area at rest.
double area_ratio(const model::Lattice& structure, const model::State& state) {
  if (!structure.squares()) return area(structure, state) / area(structure, rest_state(structure));
  const double edge = structure.size().edge_mm;
  return area(structure, state) / (static_cast<double>(structure.cells()) * edge * edge);
}

/// Computes the angle between the planes of the first and the last cell, [0, pi].
double fold_angle(const model::Lattice& structure, const model::State& state) {
  if (structure.cells() == 0) return std::nan("");
  return angle_between(area_vector(structure.cell_bodies(0), state),
                       area_vector(structure.cell_bodies(structure.cells() - 1), state));
}

/// Computes the angle at the first vertex of the first cell between its bottom and left sides, [0, pi].
double cell_angle(const model::Lattice& structure, const model::State& state) {
  if (structure.cells() == 0) return std::nan("");
  const std::span<const int> b = structure.cell_bodies(0);
  return angle_between(state[b[1]].p - state[b[0]].p, state[b.back()].p - state[b[0]].p);
}

/// Computes the largest angle between the z directions of two bodies that share a hinge: twist or fold across
/// a wall.
double largest_lean(const model::Lattice& structure, const model::State& state) {
  double largest = 0;
  for (int h = 0; h < structure.hinges(); ++h) {
    const model::HingedWall wall = structure.wall(h);
    largest = larger(largest, angle_between(state[wall.lower].R.col(2), state[wall.upper].R.col(2)));
  }
  return largest;
}

/// Computes the edges of the bounding box along the structure's axes: of the bodies' positions, or of the
/// surfaces of imported bodies.
Vector3d extent(const model::Lattice& structure, const model::State& state) {
  if (const model::Assembly* bodies = structure.assembly()) return extent_of(*bodies, state);
  Vector3d low = state[0].p, high = low;
  for (const model::Pose& pose : state) {
    low = low.cwiseMin(pose.p);
    high = high.cwiseMax(pose.p);
    if (!pose.p.allFinite()) return Vector3d::Constant(std::nan(""));
  }
  return high - low;
}

using O = Observation;
using optim::nan;

double moved_mm(const O& o, double model::StateDistance::*part) {
  return aligned_distance(*o.structure, *o.state, *o.nominal).*part * o.structure->size().edge_mm;
}

/// Reads a number after aligning the state with the closed form, or with the flat sheet if there is no closed
/// form. A midline is read in the xz plane, and other models leave a sheet at any orientation.
template <class Read>
double upright(const O& o, Read read) {
  if (o.is_closed_form) return read(*o.state);
  const model::ExactMotion exact = exact_motion(*o.structure);
  return read(aligned(*o.state, exact ? exact.at(o.theta) : rest_state(*o.structure)));
}

const model::EquilibriumStep& last(const O& o) { return o.equilibrium->path.steps.back(); }

template <class Value>
double largest(const O& o, Value value) {
  double most = -std::numeric_limits<double>::infinity();
  for (const model::EquilibriumStep& step : o.equilibrium->path.steps) most = std::max(most, value(step));
  return most;
}

/// Returns the number of stable states found, including flat. NaN if none were searched for.
double found_states(const O& o) {
  const std::size_t found = o.equilibrium->stable.states.size();
  return found > 0 ? static_cast<double>(found) : nan;
}

/// Returns the energy at the summit between flat and the next stable state after a release.
double barrier(const O& o) {
  const auto& barriers = o.equilibrium->stable.barriers;
  return barriers.empty() ? nan : barriers.front().energy;
}

const std::vector<Metric>& pose_metrics() {
  static const std::vector<Metric> metrics = {
      {"theta_deg", [](const O& o) { return to_degrees(o.theta); }},
      {"end_mm", [](const O& o) { return end_point(*o.structure, *o.state).norm(); }},
      {"end_x_mm", [](const O& o) { return end_point(*o.structure, *o.state).x(); }},
      {"end_y_mm", [](const O& o) { return end_point(*o.structure, *o.state).y(); }},
      {"end_z_mm", [](const O& o) { return end_point(*o.structure, *o.state).z(); }},
      {"turn_deg",
       [](const O& o) {
         return to_degrees(upright(o, [&](const model::State& s) { return total_turn(*o.structure, s); }));
       }},
      {"area_ratio", [](const O& o) { return area_ratio(*o.structure, *o.state); }},
      {"fold_deg", [](const O& o) { return to_degrees(fold_angle(*o.structure, *o.state)); }},
      {"cell_angle_deg", [](const O& o) { return to_degrees(cell_angle(*o.structure, *o.state)); }},
      {"lean_max_deg", [](const O& o) { return to_degrees(largest_lean(*o.structure, *o.state)); }},
      {"size_x_mm", [](const O& o) { return extent(*o.structure, *o.state).x(); }},
      {"size_y_mm", [](const O& o) { return extent(*o.structure, *o.state).y(); }},
      {"size_z_mm", [](const O& o) { return extent(*o.structure, *o.state).z(); }},
      {"hinge_gap_max", [](const O& o) { return hinge_gaps(*o.structure, *o.state).max; }},
      {"hinge_gap_rms", [](const O& o) { return hinge_gaps(*o.structure, *o.state).rms; }},
      {"moved_rms_mm", [](const O& o) { return moved_mm(o, &model::StateDistance::rms); }, true},
      {"moved_max_mm", [](const O& o) { return moved_mm(o, &model::StateDistance::max); }, true},
  };
  return metrics;
}

std::vector<Metric> goal_metrics(const GoalKind& goal) {
  std::vector<Metric> metrics;
  for (const GoalMeasure& measure : goal.measures)
    metrics.push_back({std::string(measure.name), [of = measure.of](const O& o) {
                         return upright(o,
                                        [&](const model::State& s) { return of(*o.goal, *o.structure, s); });
                       }});
  return metrics;
}

const std::vector<Metric>& equilibrium_metrics() {
  static const std::vector<Metric> metrics = {
      {"reached", [](const O& o) { return o.equilibrium->reached() ? 1.0 : 0.0; }},
      {"compression", [](const O& o) { return o.equilibrium->drive.has_plates() ? last(o).drive : nan; }},
      {"drive_rad", [](const O& o) { return o.equilibrium->drive.has_force() ? nan : last(o).drive; }},
      {"shortened_mm", [](const O& o) { return o.equilibrium->drive.only_pulls() ? last(o).drive : nan; }},
      {"load_N", [](const O& o) { return o.equilibrium->drive.has_force() ? last(o).load : nan; }},
      {"load_Nmm", [](const O& o) { return o.equilibrium->drive.has_force() ? nan : last(o).load; }},
      {"energy_Nmm", [](const O& o) { return last(o).energy; }},
      {"load_peak",
       [](const O& o) {
         return largest(o, [](const model::EquilibriumStep& s) { return std::abs(s.load); });
       }},
      {"energy_peak_Nmm",
       [](const O& o) { return largest(o, [](const model::EquilibriumStep& s) { return s.energy; }); }},
      {"gap_peak",
       [](const O& o) { return largest(o, [](const model::EquilibriumStep& s) { return s.gap; }); }},
      {"contacts", [](const O& o) { return static_cast<double>(last(o).contacts); }},
      {"barrier_Nmm", barrier},
      {"stable_states", found_states},
      {"exact_rms",
       [](const O& o) { return o.equilibrium->from_exact ? o.equilibrium->from_exact->rms : nan; }},
      {"exact_max",
       [](const O& o) { return o.equilibrium->from_exact ? o.equilibrium->from_exact->max : nan; }},
  };
  return metrics;
}

const std::vector<Metric>& physics_metrics() {
  static const std::vector<Metric> metrics = {
      {"verify_rms", [](const O& o) { return o.from_model.rms; }},
      {"verify_max", [](const O& o) { return o.from_model.max; }},
      {"hinge_axis_max_rad", [](const O& o) { return o.physics->gaps.axis_max; }},
      {"unrest", [](const O& o) { return o.physics->residual_motion; }},
  };
  return metrics;
}

/// Lists the keys of `metrics` that searches write, of all kinds and models.
std::vector<std::string> search_names() {
  std::vector<std::string> names = {"theta_rad", "theta_limit_rad", "met"};
  const auto add = [&](std::string_view name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.emplace_back(name);
  };
  for (const GoalKind* kind : goal_kinds())
    for (const GoalMetric& metric : kind->metrics) add(metric.name);
  for (const char* name : {"reached", "compression", "load_N", "energy_Nmm", "hinge_gap_max", "hinge_gap_rms",
                           "verify_rms", "verify_max", "hinge_axis_max_rad", "verified", "as_made_rms_mm",
                           "as_made_p95_mm", "force_N", "stretch_max_mm", "strain_max"})
    add(name);
  return names;
}

/// Lists the kinds of goals that measure any state by a number of this name.
std::vector<std::string_view> kinds_with_metric(std::string_view name) {
  std::vector<std::string_view> kinds;
  for (const GoalKind* kind : goal_kinds())
    for (const GoalMeasure& measure : kind->measures)
      if (measure.name == name) kinds.push_back(kind->name);
  return kinds;
}

double json_number(const nlohmann::ordered_json& metrics, const targets::DocumentPath& path) {
  const nlohmann::ordered_json* at = &metrics;
  for (const targets::PathStep& step : path) {
    if (step.key.empty()
            ? !at->is_array() || step.position < 0 || static_cast<std::size_t>(step.position) >= at->size()
            : !at->is_object() || !at->contains(step.key))
      return nan;
    at = step.key.empty() ? &(*at)[static_cast<std::size_t>(step.position)] : &(*at)[step.key];
  }
  if (at->is_boolean()) return at->get<bool>() ? 1 : 0;
  return at->is_number() ? at->get<double>() : nan;
}

/// Returns whether only sheets have this metric: it needs cells, plates, tendons or a search for stable
/// states.
bool is_of_sheets(const Metric& metric) {
  constexpr std::array names = {"turn_deg",    "area_ratio",   "fold_deg", "cell_angle_deg", "lean_max_deg",
                                "compression", "shortened_mm", "load_N",   "barrier_Nmm",    "stable_states"};
  return std::find(names.begin(), names.end(), metric.name) != names.end();
}

/// Returns the metric of a state with this name, which searches may also write; null if there is none.
const Metric* pose_metric(const std::string& name) {
  const std::vector<Metric>& all = pose_metrics();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Metric& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::vector<Metric> metrics_of(const MetricContext& context) {
  std::vector<Metric> all = pose_metrics();
  const auto add = [&](const std::vector<Metric>& more) { all.insert(all.end(), more.begin(), more.end()); };
  if (context.searches) {  // their bases are targets, without a state to compare with
    std::erase_if(all, [](const Metric& metric) { return metric.needs_nominal; });
    return all;
  }
  if (context.goal) add(goal_metrics(*context.goal));
  if (context.model == Model::equilibrium) add(equilibrium_metrics());
  if (context.model == Model::bullet) add(physics_metrics());
  if (context.bodies) std::erase_if(all, is_of_sheets);
  return all;
}

}  // namespace

std::vector<std::string> metric_names(const MetricContext& context) {
  std::vector<std::string> names;
  if (context.searches) names = search_names();
  for (const Metric& metric : metrics_of(context))
    if (std::find(names.begin(), names.end(), metric.name) == names.end()) names.push_back(metric.name);
  return names;
}

Metric find_metric(const std::string& name, const MetricContext& context) {
  if (context.searches) {
    const targets::DocumentPath path = targets::parse_path(name);
    const auto known = search_names();
    if (std::find(known.begin(), known.end(), path[0].key) != known.end())
      return {name, [path, of_state = pose_metric(name)](const O& o) {
                const double written = json_number(*o.metrics, path);
                return std::isnan(written) && of_state ? of_state->of(o) : written;
              }};
  }
  for (const Metric& metric : metrics_of(context))
    if (metric.name == name) return metric;
  const auto names = metric_names(context);
  const std::vector<std::string_view> views(names.begin(), names.end());
  const auto kinds = kinds_with_metric(name);
  if (!context.goal && !context.searches && !kinds.empty())
    throw InvalidInput(fmt::format("{} refers to a target. Add `goal: FILE.yaml`, a target of kind {}",
                                   targets::in_ticks(name), fmt::join(kinds, " or ")));
  throw InvalidInput(targets::in_ticks(name) + " is not a metric of this model" +
                     targets::did_you_mean(name, views) + "; allowed: " + targets::joined(views));
}

}  // namespace kinetix::app
