#pragma once

#include <optional>

#include "app/files/goal_drive.hpp"
#include "app/files/hinge_section.hpp"
#include "app/files/physics_section.hpp"
#include "model/matter/process.hpp"

namespace kinetix::app {

/// What the file of every goal asks of its run beside the goal.
struct GoalSettings {
  static constexpr double usual_verify =
      0.02;                             // cell edges: twenty times what converged physics runs are off
  static constexpr double grain = 0.5;  // cell edges: what a sheet of such cells cannot follow more closely

  double verify_tolerance = usual_verify;  ///< tolerance.verify: of verify_rms, cell edges, (0, 1]
  PhysicsSection physics = {};
  HingeSection hinge = {};
  GoalDrive drive = {};  ///< where hinges are elastic
  model::Process process = model::processes().front();
  bool robust = false;  ///< whether the design is chosen by its prints; of kinds that have robust_key()
};

/// The key `robust` of goals that search_robustly() serves.
targets::Key robust_key();

/// Hinges, what drives them and the process that makes them.
/// @param size of the cells; nothing where the search finds it
/// @throws InvalidInput for hinges whose cells have no size yet, and for what the process cannot make
void read_hinges(const targets::Section& root, const std::optional<model::CellSize>& size,
                 GoalSettings& settings);

}  // namespace kinetix::app
