#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace kinetix::app {

/// How a sample ended: as the exit codes of a single run.
enum class SampleStatus { ok, missed, disagrees, failed };

std::string to_string(SampleStatus status);

/// One row of a sweep's table.
struct SampleRow {
  std::int64_t sample = 0;
  std::vector<double> factors;  ///< in units of the keys that they vary
  /// In units of their metrics; NaN where there is no number; all of them in a failed sample.
  std::vector<double> responses;
  SampleStatus status = SampleStatus::ok;
  std::string reason;  ///< in words, empty where ok
};

}  // namespace kinetix::app
