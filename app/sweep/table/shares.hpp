#pragma once

#include <string>
#include <vector>

#include "app/sweep/table/sweep_table.hpp"

namespace kinetix::app {

/// One of the equal parts into which jobs that know nothing of each other split a sweep: every `count`-th sample, so
/// that all take about as long. By itself: all samples.
struct Share {
  std::int64_t index = 0, count = 1;  ///< from 0; how many there are

  bool has(std::int64_t sample) const { return sample % count == index; }
  /// How many of so many samples it has.
  std::int64_t size(std::int64_t samples) const { return (samples - index + count - 1) / count; }
  /// share-K-of-N, K from 1: where its table stands under the folder of the sweep.
  std::string folder() const;
};

/// @param text K/N, K from 1 to N @throws InvalidInput
Share read_share(const std::string& text);

/// The table of a share: its folder, and how many of its rows are damaged and not taken over.
struct ShareTable {
  std::string folder;
  std::int64_t damaged = 0;
};

/// The folders FOLDER/share-K-of-N with tables, in a fixed order.
/// @throws InvalidInput where a share is still being computed, or is of another sweep
std::vector<ShareTable> shares_in(const std::string& folder, const SweepPlan& plan,
                                  const SweepIdentity& identity);

/// Adds to the table of a sweep what that of a share has and it has not. @throws InvalidInput likewise
void take_over(const std::string& share, SweepTable& table, const SweepPlan& plan,
               const SweepIdentity& identity);

}  // namespace kinetix::app
