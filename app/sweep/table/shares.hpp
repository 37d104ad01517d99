#pragma once

#include <string>
#include <vector>

#include "app/sweep/table/sweep_table.hpp"

namespace kinetix::app {

/// One of the equal parts of a sweep for independent jobs: every `count`-th sample, which makes their run
/// times similar. The default is all samples.
struct Share {
  std::int64_t index = 0, count = 1;  ///< from 0; number of shares

  bool has(std::int64_t sample) const { return sample % count == index; }
  /// Returns the number of samples in this share of a sweep with `samples` samples.
  std::int64_t size(std::int64_t samples) const { return (samples - index + count - 1) / count; }
  /// Returns share-K-of-N, K from 1: the subfolder of the sweep that holds its table.
  std::string folder() const;
};

/// Reads a share. @param text K/N, K from 1 to N @throws InvalidInput
Share read_share(const std::string& text);

/// Table of a share: its folder, and the number of damaged rows, which are not copied.
struct ShareTable {
  std::string folder;
  std::int64_t damaged = 0;
};

/// Lists the folders FOLDER/share-K-of-N with tables, in a fixed order.
/// @throws InvalidInput if a share is still being computed, or belongs to another sweep
std::vector<ShareTable> shares_in(const std::string& folder, const SweepPlan& plan,
                                  const SweepIdentity& identity);

/// Copies to the table of a sweep the rows of a share that it lacks.
/// @throws InvalidInput if the share is still being computed, or belongs to another sweep
void take_over(const std::string& share, SweepTable& table, const SweepPlan& plan,
               const SweepIdentity& identity);

}  // namespace kinetix::app
