#pragma once

#include "app/console/console.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {

/// Warning or error of a result.
struct Problem {
  enum class Level { warning, error };
  Level level;
  std::string text;
};

/// Verdict of a run. Exit code, console, report, studio, sweeps and Python use it and do not judge themselves.
/// A flag is empty if the run did not request the check. `problems` has an error if and only if a flag is false.
struct RunVerdict {
  std::optional<bool> met;        ///< the design meets its goal in the reported state
  std::optional<bool> agrees;     ///< the simulation agrees with the model
  std::optional<bool> printable;  ///< `export` without options would write it
  std::optional<bool> reaches;    ///< the drive moves the sheet to the reported state
  /// Name of each flag that is set, and the kind of hinge that it applies to.
  std::vector<std::pair<std::string, std::string>> hinges;
  std::vector<Problem> problems;  ///< errors first

  /// Sets a flag: true without reasons, else false with one error per reason.
  void set(std::optional<bool> RunVerdict::*flag, const std::vector<std::string>& reasons,
           const std::string& hinge);
  /// Adds a warning. Warnings do not change the exit code.
  void warn(const std::string& text);

  bool has_errors() const;
  /// Returns the errors, joined by "; ". Empty without errors.
  std::string reasons() const;
};

/// Computes the verdict on a search or a forward run of a sheet. Reasons against the goal come from Run::violations,
/// warnings about it from Measure::warnings, all others from the parts of the run.
RunVerdict verdict_of(const Run& run);

/// Returns the reasons why a drive does not move a sheet to the requested state. @param theta of the equilibrium, rad
std::vector<std::string> drive_reasons(const Equilibrium& equilibrium, double theta);

/// Describes why a simulation failed, in one sentence. @pre it did not settle
std::string failed_simulation_reason(const Verification& verification);

/// Returns the exit code. 0: no flag is false. 3: met, printable or reaches is false. 4: only agrees is false.
ExitCode exit_code(const RunVerdict& verdict);

/// Returns the section `verdict` of result.json.
nlohmann::ordered_json verdict_json(const RunVerdict& verdict);

/// Summarises the flags: "goal met, printable with pin hinges, simulation agrees".
std::string headline(const RunVerdict& verdict);

/// Returns the summary lines of all problems, labelled with their level.
std::vector<SummaryLine> problem_lines(const RunVerdict& verdict);

}  // namespace kinetix::app
