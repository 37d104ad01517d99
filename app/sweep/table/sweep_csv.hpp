#pragma once

#include "app/sweep/table/sweep_table.hpp"

namespace kinetix::app {

/// The line of a row in samples.csv, without its end.
std::string csv_line(const SampleRow& row);

/// FOLDER/samples.csv: the table's rows in the order of samples, with a header, the same numbers in the
/// fewest digits that read back to them; a number that there is not is empty. Lines that start with # before
/// the header hold seed, version and hashes. Written whole or not at all.
void write_csv(const std::string& folder, const SweepTable& table, const SweepPlan& plan,
               const SweepIdentity& identity);

}  // namespace kinetix::app
