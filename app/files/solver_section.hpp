#pragma once

#include <optional>
#include <string>
#include <vector>

#include "optim/solvers/solver.hpp"
#include "optim/solvers/variables.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {

/// The `solver:` section. What is not given is for the search to choose.
struct SolverSection {
  std::optional<optim::SolverName> name;
  std::optional<int> starts;           ///< 1 to 10000
  std::optional<int> max_evaluations;  ///< per start, 1 to 10000000
};

/// Keys of the section for a kind of goal. @param names of the solvers that suit it, the default first
/// @param starts default; nothing where a search has one start alone; @param of_what the evaluations are
/// counted, e.g. "per start"
targets::KeyTable solver_keys(const std::vector<optim::SolverName>& names, std::optional<int> starts,
                              int max_evaluations, const std::string& of_what);

/// The key `name`, any of all solvers.
optim::SolverName read_solver_name(const targets::Node& node);

/// @param root the whole document
SolverSection read_solver(const targets::Section& root);

targets::Key symmetry_key(const std::string& meaning);
/// The `symmetry:` key of a section; none where it is not given. @throws InvalidInput for rotate_4 unless the
/// panel is a square
optim::Symmetry read_symmetry(const targets::Section& section, int columns, int rows);

}  // namespace kinetix::app
