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

}  // namespace kinetix::app
