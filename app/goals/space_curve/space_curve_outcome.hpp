#pragma once

#include <optional>

#include "app/goals/space_curve/space_curve_file.hpp"
#include "app/run/goal_outcome.hpp"

namespace kinetix::app {

/// What a search for a curve in space contributes to a result. Met: shape within tolerance, and no walls in the way.
class SpaceCurveOutcome final : public GoalOutcome {
 public:
  explicit SpaceCurveOutcome(SpaceCurveFile asked) : file(std::move(asked)) {}

  SpaceCurveFile file;
  optim::SpaceDesign found;
  model::State exact;                          ///< in which the model holds the strip
  model::Pose place;                           ///< of the goal, in that state's frame
  std::vector<Eigen::Vector3d> midline;        ///< of the state that results show, in the same frame, mm
  std::optional<targets::SpaceError> matter;   ///< of the equilibrium of elastic hinges
  std::optional<targets::SpaceError> physics;  ///< of the settled physics run

  /// Of the state that results show.
  const targets::SpaceError& error() const { return matter ? *matter : found.error; }
  /// Of a state anywhere in space.
  targets::SpaceError error_of(const model::State& state) const;

  bool is_strip() const override { return true; }
  nlohmann::ordered_json target_json() const override;
  /// Adds `space_curve` (placed goal, distances, turns and climbs by column) and `optimiser`.
  void add_sections(const Run& run, nlohmann::ordered_json& result) const override;
  void add_metrics(nlohmann::ordered_json& metrics) const override;
  std::vector<SummaryLine> summary_lines(const Run& run) const override;
};

/// What a state lacks, in words. @param who "model", "equilibrium" or "physics run"
std::vector<std::string> violations(const SpaceCurveFile& file, const targets::SpaceError& error,
                                    const std::string& who);

}  // namespace kinetix::app
