#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/console/console.hpp"
#include "app/run/run.hpp"

namespace kinetix::app {

/// A fact that speaks against a result.
struct Problem {
  enum class Level { warning, error };
  Level level;
  std::string text;
};

/// The answers of a run. Exit code, console, report, studio, sweeps and Python read them and judge nothing themselves.
/// A flag is empty where the run did not ask. There is an error in `problems` if and only if a flag is false.
struct RunVerdict {
  std::optional<bool> met;        ///< the design meets its goal in the state that counts
  std::optional<bool> agrees;     ///< the simulation agrees with the model
  std::optional<bool> printable;  ///< `export` without options would write it
  std::optional<bool> reaches;    ///< the drive takes the sheet there
  std::vector<std::pair<std::string, std::string>>
      hinges;  ///< of each flag that is not empty: its name, and the kind of hinge it speaks of
  std::vector<Problem> problems;  ///< errors first

  /// Sets a flag: true where nothing speaks against it, else false with an error for each reason.
  void set(std::optional<bool> RunVerdict::*flag, const std::vector<std::string>& reasons,
           const std::string& hinge);
  /// Adds what a person should know and what leaves the exit code.
  void warn(const std::string& text);

  bool has_errors() const;
  /// The errors, joined by "; "; empty without any.
  std::string reasons() const;
};

/// The verdict on a search or a forward run of a sheet. What speaks against a goal comes from Run::violations and
/// GoalOutcome::warnings(), all else from the parts of the run.
RunVerdict verdict_of(const Run& run);

/// Reasons why a drive does not take a sheet to where it was asked for. @param theta that the equilibrium came to, rad
std::vector<std::string> drive_reasons(const Equilibrium& equilibrium, double theta);

/// That a simulation failed, and why, one sentence. @pre it did not settle
std::string failed_simulation_reason(const Verification& verification);

/// 0: no flag is false; 3: met, printable or reaches is; 4: agrees alone is.
ExitCode exit_code(const RunVerdict& verdict);

/// `verdict` of result.json.
nlohmann::ordered_json verdict_json(const RunVerdict& verdict);

/// In a few words: "goal met, printable with pins, simulation agrees".
std::string headline(const RunVerdict& verdict);

/// Lines of a summary: each problem, under its level.
std::vector<SummaryLine> problem_lines(const RunVerdict& verdict);

}  // namespace kinetix::app
