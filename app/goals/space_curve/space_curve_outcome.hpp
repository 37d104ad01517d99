#pragma once

#include <optional>

#include "app/goals/space_curve/space_curve_file.hpp"
#include "app/run/found.hpp"

namespace kinetix::app {

/// What a search for a curve in space contributes to a result. Met: shape within tolerance, and no walls in the way.
class SpaceCurveOutcome final : public GoalOutcome {
 public:
  explicit SpaceCurveOutcome(SpaceCurveFile asked) : file(std::move(asked)) {}

  SpaceCurveFile file;
  optim::SpaceDesign found;
  model::Pose place;  ///< of the goal, in the frame of the state in which the model holds the strip

  /// Adds `space_curve` (placed goal, distances, turns and climbs by column) and `optimiser`.
  void add_sections(const Run& run, nlohmann::ordered_json& result) const override;
  void add_metrics(const Run& run, nlohmann::ordered_json& metrics) const override;
  std::vector<SummaryLine> summary_lines(const Run& run) const override;
};

class SpaceCurveMeasure final : public Measure {
 public:
  std::vector<Eigen::Vector3d> midline;  ///< in the frame of the model's state, mm
  targets::SpaceError error;
};

/// What a state lacks, in words. @param who "model", "equilibrium" or "physics run"
std::vector<std::string> violations(const SpaceCurveFile& file, const targets::SpaceError& error,
                                    const std::string& who);

}  // namespace kinetix::app
