#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/run/goal.hpp"

namespace kinetix::app {

/// What a response is computed from: the state of one sample, and whatever its model knows of it.
struct Observation {
  const model::Lattice* structure = nullptr;
  const model::State* state = nullptr;
  bool is_closed_form = false;                  ///< the state; others may lie another way
  double theta = 0;                             ///< rad
  const model::State* nominal = nullptr;        ///< the base's own state
  const Goal* goal = nullptr;                   ///< the sweep's `goal`
  const Equilibrium* equilibrium = nullptr;     ///< of the equilibrium model
  const sim::PhysicsResult* physics = nullptr;  ///< of the physics run
  model::StateDistance from_model = {};         ///< of the physics run, NaN where there is no model's state
  const nlohmann::ordered_json* metrics = nullptr;  ///< of a search, as in result.json
};

/// One response, in the unit that its name ends in. NaN where a sample has no such number.
struct Metric {
  std::string name;
  std::function<double(const Observation&)> of;
  bool needs_nominal = false;
};

/// What the responses of a sweep may be.
struct MetricContext {
  Model model = Model::exact;
  bool searches = false;           ///< the base is a target
  const GoalKind* goal = nullptr;  ///< of the sweep's `goal`; nothing without one
  bool bodies = false;             ///< the base is a design of imported bodies
};

/// Names of the metrics there are, in the order of the documentation.
std::vector<std::string> metric_names(const MetricContext& context);

/// The metric of a name; of searches also entries of lists, such as `fold_deg[2]`.
/// @throws InvalidInput without a place where there is none, with the nearest name
Metric find_metric(const std::string& name, const MetricContext& context);

}  // namespace kinetix::app
