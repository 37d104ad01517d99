#pragma once

#include "app/sweep/table/sweep_table.hpp"

namespace kinetix::app {

/// Returns the line of a row in samples.csv, without its end.
std::string csv_line(const SampleRow& row);

/// Writes FOLDER/samples.csv: a header and the table's rows in the order of samples. Numbers have the fewest
/// digits that read back exactly; missing numbers are empty. Lines with # before the header hold seed,
/// version and hashes. The file is complete or not written.
void write_csv(const std::string& folder, const SweepTable& table, const SweepPlan& plan,
               const SweepIdentity& identity);

/// Returns the content of FOLDER/sweep.json and of the report (schema kinetix-sweep/1) for a finished sweep.
/// It has provenance, factors, counts and the first hundred samples that are not ok. Each response has its
/// spread, main effects and linear regression, with 95 % intervals. Some methods add Sobol's indices or
/// elementary effects. `scatter` has up to 2000 rows, chosen at random. Missing numbers are null.
/// Equal tables give equal documents.
nlohmann::ordered_json sweep_json(const SweepPlan& plan, const SweepIdentity& identity,
                                  const SweepTable& table);

}  // namespace kinetix::app
