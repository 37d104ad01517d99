#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>

#include "model/base/progress.hpp"
#include "optim/solvers/multi_start.hpp"

namespace kinetix::app {

struct BodyPieces;
struct Design;

/// The answer of `export` without options to a design.
struct PrintAnswer {
  bool is_taken = false;
  std::string hinges;    ///< their kinds, which it would print or tried last
  std::string why = {};  ///< it refuses the design, one sentence
};

/// What the command line adds to a file.
struct RunOptions {
  int threads = 0;  ///< 0 = all cores
  std::uint64_t seed = 0;
  bool verify = true;  ///< run the physics engine
  Progress progress = {};
  int prints =
      0;  ///< with errors, brought to their equilibrium to confirm what is said of them, 0 to 1000000
  /// Where it asks to, searches end with the best so far, and what only judges or checks it is left out.
  std::stop_token stop = {};
  std::mutex* engine =
      nullptr;  ///< held while the physics engine runs, which one thread at a time may use; null: nobody else does
  bool certify = true;  ///< prove how far it folds without contact
  /// Computes states and the verdict alone, as sweeps need: no mobility, no sampled range of theta, no frames of exact motions.
  bool brief = false;
  bool fidelity = false;  ///< physics runs of coarser steps too, for the table of speed against error
  /// Answer of `export` without options to a design (app/print/fit.hpp). Empty: not asked.
  std::function<PrintAnswer(const Design&)> printable = {};
  std::shared_ptr<const BodyPieces> pieces = {};  ///< of a run before, to be used again where they fit
};

/// A run was told to stop before there was anything to keep. The program says what() and ends with exit code 130.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Stop and progress of one search: at which evaluation it is, and how far off the best is so far.
/// @param mm of |r| = 1
void follow(const RunOptions& run, double mm, optim::SolverOptions& search);

/// Returns a search from many starts with the seed and threads of the run, its stop and its progress.
/// @param in_words of the least |r| so far
optim::MultiStartOptions followed(optim::MultiStartOptions search, const RunOptions& run,
                                  std::function<std::string(double least)> in_words);

/// Wall-clock seconds since the last lap.
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
