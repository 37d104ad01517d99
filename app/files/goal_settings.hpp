#pragma once

#include <memory>
#include <optional>

#include "app/files/goal_drive.hpp"
#include "app/files/hinge_parts.hpp"
#include "app/files/physics_section.hpp"
#include "app/files/solver_section.hpp"
#include "model/matter/process.hpp"

namespace kinetix::app {

class Goal;

/// What the file of every goal asks of its run beside the goal.
struct GoalSettings {
  static constexpr double usual_verify =
      0.02;                             // cell edges: twenty times what converged physics runs are off
  static constexpr double grain = 0.5;  // cell edges: what a sheet of such cells cannot follow more closely

  std::string name = {};                   ///< default: the file's name without its ending
  double verify_tolerance = usual_verify;  ///< tolerance.verify: of verify_rms, cell edges, (0, 1]
  SolverSection solver = {};               ///< of kinds whose searches have a choice
  PhysicsSection physics = {};
  HingeSection hinge = {};
  std::vector<HingePart> hinge_parts = {};  ///< hinges that are made otherwise
  std::optional<model::ShapeMemory> drive =
      {};  ///< springs in place of the usual drive, where hinges are elastic
  model::Process process = model::processes().front();
  /// How much prints count beside the design itself where it is chosen by them, (0, 1]; of kinds that have robust_key()
  std::optional<double> robust = {};
};

/// Adds what the file's process cannot print of cells of this size to the notes of a forecast.
void note_process(const GoalSettings& settings, const model::CellSize& size, std::vector<std::string>& notes);

/// Every key of a target: a goal's own, and those that all have in common.
/// @param hinge what the key `hinge` means; empty: the goal has no `hinge` and `drive`, or among its own
/// @param more behind them all
targets::KeyTable goal_keys(std::vector<targets::Key> own, const std::string& hinge,
                            std::vector<targets::Key> more = {});
/// Meanings of the key `hinge`: for cells whose size is known before the search, and for cells that may get it by the search.
inline constexpr const char* any_hinge = "what the hinges are made of";
inline constexpr const char* sized_hinge = "what the hinges are made of; needs `structure.cell_mm`";

/// The key `tolerance.verify`.
targets::Key verify_key(double usual = GoalSettings::usual_verify);

/// Reads the settings that a kind has keys for, except those of read_hinges().
/// @param edge_mm cell edge, for ranges of lengths
void read_settings(const targets::Section& root, double edge_mm, GoalSettings& settings);

/// The key `robust`. @param over what such a search may change
targets::Key robust_key(const std::string& over =
                            "theta where the search is free to choose it, and over gaps of "
                            "blocks and films");

/// Hinges, what drives them and the process that makes them.
/// @param size of the cells; nothing where the search finds it
/// @throws InvalidInput for hinges whose cells have no size yet, and for what the process cannot make
void read_hinges(const targets::Section& root, const std::optional<model::CellSize>& size,
                 GoalSettings& settings);

}  // namespace kinetix::app
