#include "app/solver_section.hpp"

namespace kinetix {
namespace {

SolverName read_solver_name(const Node& node) {
  std::vector<std::string> names;
  for (const SolverName name : all_solvers()) names.push_back(to_string(name));
  return all_solvers()[node.one_of({names.begin(), names.end()})];
}

}  // namespace

SolverSection read_solver(const Node& root) {
  SolverSection solver;
  const auto section = root.optional("solver");
  if (!section) return solver;
  section->reject_unknown_keys({"name", "starts", "max_evaluations"});
  if (const auto node = section->optional("name")) solver.name = read_solver_name(*node);
  if (const auto node = section->optional("starts")) solver.starts = node->integer(1, 10'000);
  if (const auto node = section->optional("max_evaluations"))
    solver.max_evaluations = node->integer(1, 10'000'000);
  return solver;
}

Symmetry read_symmetry(const Node& node, int columns, int rows) {
  const auto symmetry = node.choice<Symmetry>({{"none", Symmetry::none},
                                               {"mirror_x", Symmetry::mirror_x},
                                               {"mirror_y", Symmetry::mirror_y},
                                               {"rotate_2", Symmetry::rotate_2},
                                               {"rotate_4", Symmetry::rotate_4}});
  if (symmetry == Symmetry::rotate_4 && columns != rows)
    throw node.error("rotate_4 needs as many columns as rows, and structure.cells is [" +
                     std::to_string(columns) + ", " + std::to_string(rows) +
                     "]; allowed here: none, mirror_x, mirror_y, rotate_2");
  return symmetry;
}

}  // namespace kinetix
