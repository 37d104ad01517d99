#pragma once

#include <optional>

#include "optim/solver.hpp"
#include "optim/variables.hpp"
#include "targets/document.hpp"

namespace kinetix {

/// The `solver:` section. What is not given is for the search to choose.
struct SolverSection {
  std::optional<SolverName> name;
  std::optional<int> starts;           ///< 1 to 10000
  std::optional<int> max_evaluations;  ///< per start, 1 to 10000000
};

/// @param root the whole document
SolverSection read_solver(const Node& root);

/// A `symmetry:` key. @throws InvalidInput for rotate_4 unless the panel is a square
Symmetry read_symmetry(const Node& node, int columns, int rows);

}  // namespace kinetix
