#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/sweep/table/sweep_table.hpp"

namespace kinetix::app {

/// What the table of a finished sweep says, for FOLDER/sweep.json and the report (schema kinetix-sweep/1):
/// provenance, factors, counts, failures (the first hundred), and for each response its spread, main effects,
/// linear regression, and where the method allows Sobol's indices or elementary effects, with 95 % intervals.
/// `scatter` has up to 2000 rows, evenly spread over the table. Numbers that there are not are null.
/// The same table gives the same document.
nlohmann::ordered_json sweep_json(const SweepPlan& plan, const SweepIdentity& identity,
                                  const SweepTable& table);

}  // namespace kinetix::app
