#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/app/program.hpp"

namespace kinetix::testing {

/// How far a metric of result.json may go; tests/regression/README.md has the reasons.
struct Limit {
  std::string metric;
  double measured = 0;  ///< when the limit was set
  std::optional<double> at_least, at_most;

  bool holds(double value) const {
    return (!at_least || value >= *at_least) && (!at_most || value <= *at_most);
  }
};

/// Target file that is run from end to end.
struct Prototype {
  std::string name;
  std::string target;  ///< in targets/shapes
  std::vector<Limit> limits;
  double time_ratio = 0;     ///< of the whole run, over the fixed workload of benchmarks/, as measured
  double slowest_ratio = 0;  ///< how slow it may become
};

inline std::optional<double> number_at(const nlohmann::json& json, const char* key) {
  return json.contains(key) ? std::optional(json.at(key).get<double>()) : std::nullopt;
}

/// Reads all prototypes. @param source folder of the project
inline std::vector<Prototype> read_prototypes(const std::string& source) {
  std::vector<Prototype> prototypes;
  for (const auto& json : nlohmann::json::parse(text_of(source + "/tests/regression/prototypes.json"))) {
    Prototype& prototype = prototypes.emplace_back(
        Prototype{json.at("name"), json.at("target"), {}, json.at("time_ratio"), json.at("slowest_ratio")});
    for (const auto& limit : json.at("limits"))
      prototype.limits.push_back({limit.at("metric"), limit.at("measured"), number_at(limit, "at_least"),
                                  number_at(limit, "at_most")});
  }
  return prototypes;
}

}  // namespace kinetix::testing
