#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <stdexcept>

#include "model/base/progress.hpp"
#include "model/material/manufactured_hinge.hpp"
#include "optim/solvers/multi_start.hpp"

namespace kinetix::app {

struct BodyPieces;
struct Design;
struct Folding;

/// Part that keeps a sheet folded: a clip over two posts, or a strap through two eyes.
struct Lock {
  std::string kind;                   ///< "clip" or "strap"
  std::array<std::string, 2> bodies;  ///< names of the bodies with posts or eyes
  double flat_mm = 0, folded_mm = 0;  ///< distance of posts or eyes
  double force_N = 0;                 ///< force of the hinges on it at the fold; 0: pins turn freely
  double strength_N = 0;              ///< force at which post, eye or clip reaches the strain of its material
  std::string material;               ///< that strength_N assumes
};

/// Answer of `export` without options to a design.
struct PrintAnswer {
  bool is_accepted = false;
  std::string hinges;    ///< kinds of hinges that it would print, or tried last
  std::string why = {};  ///< why it rejects the design, one sentence
  std::string advice =
      {};  ///< what was searched in its place: "; with `KEYS` the goal is met and can be printed"
  std::vector<model::ManufacturedHinge> made = {};  ///< by hinge, as it would print them; empty if it rejects
  std::optional<Lock> lock = {};                    ///< that it would print
  /// Adds a clip to the print, else a strap, and returns it. Returns nothing if neither fits. Empty if it rejects.
  std::function<std::optional<Lock>()> add_lock = {};
  std::string warning = {};  ///< about the lock of a print that it accepts, one sentence; empty: none
  /// Draws the folding card of the print (app/print/folding_card.hpp); empty if it rejects.
  std::function<nlohmann::ordered_json(const std::optional<Folding>&)> draw_card = {};
};

/// Options of the command line.
struct RunOptions {
  int threads = 0;  ///< 0 = all cores
  std::uint64_t seed = 0;
  bool verify = true;  ///< whether to run the physics engine
  Progress progress = {};
  int prints = 0;  ///< number of sample prints that confirm the print tolerance, 0 to 1000000
  /// Stop request: searches end with the best so far, and checks of it are left out.
  std::stop_token stop = {};
  std::mutex* engine =
      nullptr;          ///< locked while the physics engine runs, which serves one thread; null: not shared
  bool certify = true;  ///< whether to prove how far the sheet folds without contact

  /// Whether to compute only states and the verdict, as sweeps need: no mobility, no sampled range of theta, no
  /// frames of exact motions.
  bool brief = false;
  bool fidelity = false;  ///< whether to simulate with larger steps too, for the speed-against-error table
  /// Returns the answer of `export` without options to a design (app/print/fit.hpp). Empty: not requested.
  std::function<PrintAnswer(const Design&)> printable = {};
  /// Returns cells with which `export` would write a design that it rejects (app/print/fit.hpp). Empty: not requested.
  std::function<std::optional<model::CellSize>(const Design&)> printable_size = {};
  /// Whether to search for other settings with which a missed goal is met (Goal::remedies).
  bool seeks_remedy = false;
  std::shared_ptr<const BodyPieces> pieces = {};  ///< of an earlier run, reused if they fit
};

/// Error of a run that was stopped before there was anything to keep. The program prints what() and ends with exit
/// code 130.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Connects stop and progress of a run to a search. The progress gives the evaluation and the error of the best so
/// far.
/// @param mm error for |r| = 1
void follow(const RunOptions& run, double mm, optim::SolverOptions& search);

/// Returns a search from many starts with the seed and threads of the run, its stop and its progress.
/// @param describe of the least |r| so far
optim::MultiStartOptions followed(optim::MultiStartOptions search, const RunOptions& run,
                                  std::function<std::string(double least)> describe);

/// Stopwatch of wall-clock seconds since the last lap.
class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace kinetix::app
