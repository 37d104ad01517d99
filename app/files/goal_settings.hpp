#pragma once

#include "app/files/hinge_section.hpp"
#include "app/files/process_section.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/lattice/square/structure.hpp"
#include "model/material/process.hpp"
#include "optim/solvers/solver.hpp"
#include "sim/physics_options.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// Content of the `physics:` section of a target or a design. The simulation chooses what is not given.
struct PhysicsSection {
  std::optional<double> step_s;    ///< time step, s, (0, 0.1]
  std::optional<double> reach_mm;  ///< half distance of a hinge's two constraint points, 0.01 to 10 cells
  std::optional<double> disturbance = {};    ///< of the first motion, ratio to the parts' spin, [0, 1]
  std::optional<int> disturbance_seed = {};  ///< >= 0

  bool operator==(const PhysicsSection&) const = default;
};

const targets::KeyTable& physics_keys();

/// Reads the section. @param root the whole document   @param edge_mm cell edge, for the range of reach_mm
PhysicsSection read_physics(const targets::Section& root, double edge_mm);

/// Content of the `solver:` section. The search chooses what is not given.
struct SolverSection {
  std::optional<optim::SolverName> name;
  std::optional<int> starts;           ///< 1 to 10000
  std::optional<int> max_evaluations;  ///< per start, 1 to 10000000
};

/// Returns the keys of the section for a kind of goal. @param names of the solvers that suit it, the default first
/// @param starts default; empty if a search has a single start   @param evaluations_unit unit of evaluations, e.g. "per start"
targets::KeyTable solver_keys(const std::vector<optim::SolverName>& names, std::optional<int> starts,
                              int max_evaluations, const std::string& evaluations_unit);

/// Reads the key `name`, any of all solvers.
optim::SolverName read_solver_name(const targets::Node& node);

/// Reads the `solver:` section. @param root the whole document
SolverSection read_solver(const targets::Section& root);

targets::Key symmetry_key(const std::string& meaning);
/// Reads the `symmetry:` key of a section; none by default. @throws InvalidInput for rotate_4 unless the panel is a
/// square
optim::Symmetry read_symmetry(const targets::Section& section, int columns, int rows);

/// Returns the `drive:` key of goals of exact families.
targets::Key goal_drive_key();
/// Reads the springs that fold a sheet of elastic hinges. They have no angle yet. Empty: plates or one hinge,
/// whichever folds the sheet's family most evenly.
/// @param root the whole document
std::optional<model::ShapeMemory> read_goal_drive(const targets::Section& root);

class Goal;

/// Settings of a run in the file of every goal, except the goal itself.
struct GoalSettings {
  static constexpr double default_verify_tolerance =
      0.02;                             // cell edges: twenty times the error of converged simulations
  static constexpr double grain = 0.5;  // cell edges: a sheet of such cells cannot follow more closely

  std::string name = {};  ///< default: the file's name without its ending
  double verify_tolerance =
      default_verify_tolerance;  ///< tolerance.verify: limit of verify_rms, cell edges, (0, 1]
  SolverSection solver = {};     ///< only of kinds with a choice of solvers
  PhysicsSection physics = {};
  HingeSection hinge = {};
  std::vector<HingePart> hinge_parts = {};  ///< per-hinge overrides
  std::optional<model::ShapeMemory> drive =
      {};  ///< springs in place of the usual drive, if hinges are elastic
  model::Process process = model::processes().front();
  std::optional<LockKind> lock = {};  ///< empty: not given
  /// Weight of prints against the design itself in a robust search, (0, 1]. Only of kinds that have robust_key().
  /// Empty: no such search.
  std::optional<double> robust = {};
  /// Guesses about files that the target names, and changes to their content, one sentence each.
  std::vector<std::string> input_notes = {};
};

/// Adds notes to a forecast on what the file's process cannot print with cells of this size.
void note_process(const GoalSettings& settings, const model::CellSize& size, std::vector<std::string>& notes);

/// Returns every key of a target: a goal's own, and those that all goals have.
/// @param hinge meaning of the key `hinge`; empty: the goal has no `hinge` and `drive`, or has them among its own
/// @param more keys after all others
targets::KeyTable goal_keys(std::vector<targets::Key> own, const std::string& hinge,
                            std::vector<targets::Key> more = {});
/// Meanings of the key `hinge`: for cells whose size is known before the search, and for cells sized by the search.
inline constexpr const char* any_hinge = "kind, material and stiffness of the hinges";
inline constexpr const char* sized_hinge =
    "kind, material and stiffness of the hinges. Sizes need `structure.cell_mm`";

/// Returns the key `tolerance.verify`.
targets::Key verify_key(double usual = GoalSettings::default_verify_tolerance);

/// Reads the settings that a kind has keys for, except those of read_hinges().
/// @param edge_mm cell edge, for ranges of lengths
void read_settings(const targets::Section& root, double edge_mm, GoalSettings& settings);

/// Returns the key `robust`. @param over choices of such a search, in words
targets::Key robust_key(const std::string& over =
                            "the fold angle, if the search is free to choose it, and over gaps of "
                            "blocks and living hinges");

/// Reads the hinges, their drive and the process that makes them.
/// @param size of the cells; empty if the search finds it
/// @throws InvalidInput for hinges whose cells have no size yet, and for what the process cannot make
void read_hinges(const targets::Section& root, const std::optional<model::CellSize>& size,
                 GoalSettings& settings);

/// Returns a key of a `variables:` section; angles in radians.
targets::Key tilt_range_key(const optim::AngleRange& usual);
/// Returns the key `fold_angle` of a `variables:` section. @param usual rad
targets::Key fold_angle_key(const optim::AngleRange& usual);
/// Returns the whole section of a net. @param tilt largest, rad, of either sign
targets::KeyTable net_variables_keys(double tilt, const optim::AngleRange& theta);

/// Reads `fold_angle: {range_deg: [2, 44]}` of a file's variables.
/// @param root the whole document
/// @param usual default
/// @return rad, within (0, 45) deg
/// @throws InvalidInput for a range that starts at a theta at which walls already close the cells
optim::AngleRange read_theta(const targets::Section& root, const model::CellSize& size,
                             const optim::AngleRange& usual);

/// Variables of a net, whose creases alternate their tilts.
struct NetVariables {
  double tilt = 0;          ///< largest, rad, of either sign
  optim::AngleRange theta;  ///< rad
};

/// Reads `variables: {tilt: {range_deg: [-60, 60]}, fold_angle: {range_deg: [2, 44]}}` of a file.
/// @throws InvalidInput for tilts of one sign alone, and as read_theta
NetVariables read_net_variables(const targets::Section& root, const model::CellSize& size,
                                const NetVariables& usual);

}  // namespace kinetix::app
