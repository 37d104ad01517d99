#pragma once

#include "app/run/goal.hpp"

namespace kinetix::app {

/// Source of a response: the state of one sample, and what its model computed.
struct Observation {
  const model::Lattice* structure = nullptr;
  const model::State* state = nullptr;
  bool is_closed_form = false;                      ///< of `state`; other states may be oriented differently
  double theta = 0;                                 ///< rad
  const model::State* nominal = nullptr;            ///< the base's state
  const Goal* goal = nullptr;                       ///< the sweep's `goal`
  const Equilibrium* equilibrium = nullptr;         ///< set by the equilibrium model
  const sim::PhysicsResult* physics = nullptr;      ///< set by the simulation
  model::StateDistance from_model = {};             ///< set by the simulation; NaN without a model's state
  const nlohmann::ordered_json* metrics = nullptr;  ///< set by a search, as in result.json
};

/// One response, in the unit that its name ends in. NaN if a sample has no such number.
struct Metric {
  std::string name;
  std::function<double(const Observation&)> of;
  bool needs_nominal = false;
};

/// Properties of a sweep that decide which metrics it has.
struct MetricContext {
  Model model = Model::exact;
  bool searches = false;           ///< the base is a target
  const GoalKind* goal = nullptr;  ///< kind of the sweep's `goal`; null without one
  bool bodies = false;             ///< the base is a design of imported bodies
};

/// Lists the names of the available metrics, in the order of the documentation.
std::vector<std::string> metric_names(const MetricContext& context);

/// Returns the metric of a name. In searches a name may also be an entry of a list, such as `fold_deg[2]`.
/// @throws InvalidInput without a place for an unknown name, with the nearest one
Metric find_metric(const std::string& name, const MetricContext& context);

}  // namespace kinetix::app
