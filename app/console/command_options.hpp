#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace kinetix::app {

/// Exit codes of formats.md.
enum ExitCode {
  done = 0,
  internal_error = 1,
  bad_input = 2,
  target_missed = 3,
  physics_disagrees = 4,
  interrupted_early = 130
};

/// What every command takes.
struct CommandOptions {
  std::string file;
  std::string
      folder;  ///< empty: results/<name>, with _verified, _exact, _equilibrium or _bullet for a design
  bool folder_given = false;
  bool json = false;
  bool quiet = false;
  bool verify = true;
  bool fidelity = false;               ///< of a target and verify: physics runs of coarser steps too
  std::optional<double> time_limit_s;  ///< of a target and simulate: the best so far is kept
  bool open = false;                   ///< shows the report when it is written
  int prints = 0;                      ///< of a target: to confirm what prints come to
  int threads = 0;
  std::uint64_t seed = 0;
  bool seed_given = false;
  std::string model = "exact";  ///< of simulate: exact, equilibrium or bullet
  double theta_deg = 0;         ///< of simulate, deg
  bool theta_given = false;
  bool drives = false;  ///< of simulate: tries drives instead of the design's own
  bool resume = false;  ///< of sweep

  /// Where results go. @param suffix keeps those of one command from replacing another's
  std::string folder_of(const std::string& name, const std::string& suffix = "") const {
    return folder_given ? folder : "results/" + name + suffix;
  }
};

}  // namespace kinetix::app
