#pragma once

#include "app/run/found.hpp"
#include "optim/helmet/fit_helmet.hpp"
#include "optim/ribs/ribs_cover.hpp"
#include "targets/helmet/head.hpp"
#include "targets/helmet/walls_inside.hpp"

namespace kinetix::app {

/// What a search for a helmet contributes to a result.
class HelmetOutcome final : public GoalOutcome {
 public:
  HelmetOutcome(targets::Head head, optim::HelmetSpec spec, optim::RibsDesign design);

  targets::Head head;
  optim::HelmetSpec spec;
  optim::RibsDesign design;  ///< in the head's frame
  optim::RibsReach reach;    ///< of the design's cells
  optim::RibsCover cover;    ///< the dome above the rim against them

  /// Adds `helmet` (ribs, distances of bodies and cells, reasons) and `optimiser`.
  void add_sections(const Run& run, nlohmann::ordered_json& result) const override;
  void add_metrics(const Run& run, nlohmann::ordered_json& metrics) const override;
  std::vector<SummaryLine> summary_lines(const Run& run) const override;
};

/// Warns that the mesh has holes where the helmet should follow the head; empty without holes.
std::string invented(const std::vector<targets::DomeOpening>& openings);

class HelmetMeasure final : public Measure {
 public:
  optim::RibsError error;
  targets::WallsInside inside;  ///< walls in the head that was given
};

}  // namespace kinetix::app
