#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/sweep/table/sweep_table.hpp"

namespace kinetix::app {

/// Returns the content of FOLDER/sweep.json and of the report (schema kinetix-sweep/1) for a finished sweep.
/// It has provenance, factors, counts and the first hundred samples that are not ok. Each response has its
/// spread, main effects and linear regression, with 95 % intervals. Some methods add Sobol's indices or
/// elementary effects. `scatter` has up to 2000 rows, chosen at random. Missing numbers are null.
/// Equal tables give equal documents.
nlohmann::ordered_json sweep_json(const SweepPlan& plan, const SweepIdentity& identity,
                                  const SweepTable& table);

}  // namespace kinetix::app
