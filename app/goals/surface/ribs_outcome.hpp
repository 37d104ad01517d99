#pragma once

#include <optional>

#include "app/goals/surface/beside.hpp"
#include "app/goals/surface/ribs_file.hpp"
#include "app/run/found.hpp"
#include "optim/ribs/ribs_cover.hpp"

namespace kinetix::app {

/// What a search for ribs over a surface contributes to a result.
class RibsOutcome final : public GoalOutcome {
 public:
  RibsOutcome(RibsFile asked, optim::RibsDesign found);

  RibsFile file;
  optim::RibsDesign design;  ///< in the frame of the ribs
  optim::RibsReach reach;    ///< of the design's cells
  optim::RibsCover cover;    ///< the surface against them

  /// Adds `surface` (lines of surface, spine and ribs, errors, ways) and `optimiser`.
  void add_sections(const Run& run, nlohmann::ordered_json& result) const override;
  void add_metrics(const Run& run, nlohmann::ordered_json& metrics) const override;
  std::vector<SummaryLine> summary_lines(const Run& run) const override;
};

class RibsMeasure final : public Measure {
 public:
  std::vector<SurfaceWay> ways;  ///< the fishbone, and of the model's state the same ribs loose
};

/// How far the bodies of a fishbone are from their surface, in sentences, empty within the tolerance.
/// @param who of "model", "physics run", ...
std::vector<std::string> violations(const RibsFile& file, const SurfaceWay& way, const std::string& who);

/// Describes a surface that is covered too little, in a sentence; empty within the tolerance.
std::vector<std::string> violations(const RibsFile& file, const optim::RibsCover& cover);

}  // namespace kinetix::app
