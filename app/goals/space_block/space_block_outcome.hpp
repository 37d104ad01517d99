#pragma once

#include <optional>

#include "app/goals/space_block/space_block_file.hpp"
#include "app/run/goal_outcome.hpp"

namespace kinetix::app {

/// What a block that shrinks contributes to a result. Met: factors and lengths at rest within tolerance, and no walls in the
/// way.
class SpaceBlockOutcome final : public GoalOutcome {
 public:
  explicit SpaceBlockOutcome(SpaceBlockFile asked) : file(std::move(asked)) {}

  SpaceBlockFile file;
  model::State exact;                               ///< in which the model holds the block
  targets::SpaceBlockError error;                   ///< of that
  std::optional<targets::SpaceBlockError> physics;  ///< of the settled physics run

  nlohmann::ordered_json target_json() const override;
  /// Adds `space_block` (cells, gusset, lengths at rest and pressed) and `optimiser`.
  void add_sections(const Run& run, nlohmann::ordered_json& result) const override;
  void add_metrics(nlohmann::ordered_json& metrics) const override;
  std::vector<SummaryLine> summary_lines(const Run& run) const override;
};

/// What a state lacks, in words. @param who "model" or "physics run"
std::vector<std::string> violations(const SpaceBlockFile& file, const targets::SpaceBlockError& error,
                                    const std::string& who);

}  // namespace kinetix::app
