#pragma once

#include <optional>

#include "app/goals/space_block/space_block_file.hpp"
#include "app/run/found.hpp"

namespace kinetix::app {

/// What a block that shrinks contributes to a result. Met: factors and lengths at rest within tolerance, and no walls in the
/// way.
class SpaceBlockOutcome final : public GoalOutcome {
 public:
  explicit SpaceBlockOutcome(SpaceBlockFile asked) : file(std::move(asked)) {}

  SpaceBlockFile file;

  /// Adds `space_block` (cells, gusset, lengths at rest and pressed) and `optimiser`.
  void add_sections(const Run& run, nlohmann::ordered_json& result) const override;
  void add_metrics(const Run& run, nlohmann::ordered_json& metrics) const override;
  std::vector<SummaryLine> summary_lines(const Run& run) const override;
};

class SpaceBlockMeasure final : public Measure {
 public:
  targets::SpaceBlockError error;
};

/// What a state lacks, in words. @param who "model" or "physics run"
std::vector<std::string> violations(const SpaceBlockFile& file, const targets::SpaceBlockError& error,
                                    const std::string& who);

}  // namespace kinetix::app
