#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/drive.hpp"
#include "model/state.hpp"

namespace kinetix::testing {

/// A case with a closed form, for other programs to run it too.
struct ExactRun {
  Structure structure;
  Drive drive;
  State exact;
  bool contact = false, planar = false;
};

struct HardAnswer {
  std::string answer;     ///< what the model said
  std::string diagnosis;  ///< its error, or what it found wrong
  bool right = false;     ///< right to the error stated in `asked`, or diagnosed
  std::optional<ExactRun> run;
};

/// A case at or past the edge of what the equilibrium model is for. The one failure is a wrong answer that
/// looks fine.
struct HardCase {
  std::string name, asked;
  std::function<HardAnswer()> solve;
  bool fast = true;  ///< below a second
};

std::vector<HardCase> hard_cases();

}  // namespace kinetix::testing
