#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/run.hpp"
#include "targets/curve.hpp"

namespace kinetix {

/// What a response is computed from: the state of one sample, and whatever its model knows of it.
struct Observation {
  const Structure* structure = nullptr;
  const State* state = nullptr;
  double theta = 0;                        ///< rad
  const State* nominal = nullptr;          ///< the base's own state
  const Curve* goal = nullptr;             ///< the sweep's `goal`
  const Equilibrium* balance = nullptr;    ///< of the equilibrium model
  const PhysicsResult* physics = nullptr;  ///< of the physics run
  StateDistance from_model = {};           ///< of the physics run, NaN where there is no model's state
  const nlohmann::ordered_json* metrics = nullptr;  ///< of a search, as in result.json
};

/// One response. NaN where a sample has no such number.
struct Metric {
  std::string name;
  std::function<double(const Observation&)> of;
  bool needs_nominal = false;
};

/// What the responses of a sweep may be.
struct MetricContext {
  Model model = Model::exact;
  bool searches = false;  ///< the base is a target
  bool has_goal = false;
};

/// Names of the metrics there are, in the order of the documentation.
std::vector<std::string> metric_names(const MetricContext& context);

/// The metric of a name; of searches also entries of lists, such as `fold_deg[2]`.
/// @throws InvalidInput without a place where there is none, with the nearest name
Metric find_metric(const std::string& name, const MetricContext& context);

}  // namespace kinetix
