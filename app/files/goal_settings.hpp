#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/files/hinge_parts.hpp"
#include "app/files/physics_section.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/square/structure.hpp"
#include "model/matter/process.hpp"
#include "optim/solvers/solver.hpp"
#include "optim/solvers/variables.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// The `solver:` section. What is not given is for the search to choose.
struct SolverSection {
  std::optional<optim::SolverName> name;
  std::optional<int> starts;           ///< 1 to 10000
  std::optional<int> max_evaluations;  ///< per start, 1 to 10000000
};

/// Keys of the section for a kind of goal. @param names of the solvers that suit it, the default first
/// @param starts default; nothing where a search has one start alone; @param of_what the evaluations are
/// counted, e.g. "per start"
targets::KeyTable solver_keys(const std::vector<optim::SolverName>& names, std::optional<int> starts,
                              int max_evaluations, const std::string& of_what);

/// The key `name`, any of all solvers.
optim::SolverName read_solver_name(const targets::Node& node);

/// @param root the whole document
SolverSection read_solver(const targets::Section& root);

targets::Key symmetry_key(const std::string& meaning);
/// The `symmetry:` key of a section; none where it is not given. @throws InvalidInput for rotate_4 unless the
/// panel is a square
optim::Symmetry read_symmetry(const targets::Section& section, int columns, int rows);

/// The `drive:` key of goals of exact families.
targets::Key goal_drive_key();
/// The springs that are to fold a sheet of elastic hinges, which have no angle yet; nothing: plates or one hinge, whichever folds
/// the sheet's family most evenly.
/// @param root the whole document
std::optional<model::ShapeMemory> read_goal_drive(const targets::Section& root);

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

/// Keys of a `variables:` section; angles in radians.
targets::Key tilt_range_key(const optim::AngleRange& usual);
/// @param usual rad
targets::Key theta_key(const optim::AngleRange& usual);
/// The whole section of a net. @param tilt largest, rad, of either sign
targets::KeyTable net_variables_keys(double tilt, const optim::AngleRange& theta);

/// `theta: {range_deg: [2, 44]}` of a file's variables.
/// @param root the whole document
/// @param usual where the file says nothing
/// @return rad, within (0, 45) deg
/// @throws InvalidInput for a range that starts where walls already close the cells
optim::AngleRange read_theta(const targets::Section& root, const model::CellSize& size,
                             const optim::AngleRange& usual);

/// Variables of a net, whose creases alternate their tilts.
struct NetVariables {
  double tilt = 0;          ///< largest, rad, of either sign
  optim::AngleRange theta;  ///< rad
};

/// `variables: {beta: {range_deg: [-60, 60]}, theta: {range_deg: [2, 44]}}` of a file.
/// @throws InvalidInput for tilts of one sign alone, and as read_theta
NetVariables read_net_variables(const targets::Section& root, const model::CellSize& size,
                                const NetVariables& usual);

}  // namespace kinetix::app
