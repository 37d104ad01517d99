#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>

#include "model/base/progress.hpp"

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

}  // namespace kinetix::app
