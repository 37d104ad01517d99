#pragma once

#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "model/hinge/elasticity.hpp"
#include "model/lattice/lattice_motion.hpp"
#include "model/linkage/state.hpp"

namespace kinetix::testing {

/// Equilibrium of squares that was found, so that another program can search for it too.
struct HardEquilibrium {
  model::Structure structure;
  model::Drive drive;
  model::Elasticity elasticity;
  bool contact = false, planar = false;
  model::State state;
};

struct HardAnswer {
  enum class Mark {
    right,      ///< to the error that was asked for
    diagnosed,  ///< refused or ended with the reason that was asked for
    wrong,
  };
  Mark mark = Mark::wrong;
  std::string exact, equilibrium;  ///< what closed form and model answered
  std::optional<HardEquilibrium> settled;
};

std::string to_string(HardAnswer::Mark mark);

/// Case at or past the limit of what a model can represent. The only failure is a wrong answer that looks correct.
struct HardCase {
  std::string name, asked;
  std::function<HardAnswer()> solve;
  bool in_tests = true;  ///< below a second, and not known to be wrong
};

inline std::ostream& operator<<(std::ostream& out, const HardCase& c) { return out << c.name; }

std::vector<HardCase> hard_cases();

}  // namespace kinetix::testing
