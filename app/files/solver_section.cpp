#include "app/files/solver_section.hpp"

#include "targets/document/bound_key.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;
using optim::Symmetry;

// What the key `symmetry` may say.
constexpr targets::Word<Symmetry> symmetries[] = {{"none", Symmetry::none},
                                                  {"mirror_x", Symmetry::mirror_x},
                                                  {"mirror_y", Symmetry::mirror_y},
                                                  {"rotate_2", Symmetry::rotate_2},
                                                  {"rotate_4", Symmetry::rotate_4}};

}  // namespace

optim::SolverName read_solver_name(const targets::Node& node) {
  std::vector<std::string> names;
  for (const optim::SolverName name : optim::all_solvers()) names.push_back(to_string(name));
  return optim::all_solvers()[node.one_of({names.begin(), names.end()})];
}

targets::KeyTable solver_keys(const std::vector<optim::SolverName>& names, std::optional<int> starts,
                              int max_evaluations, const std::string& of_what) {
  std::vector<std::string> words;
  std::string meaning;
  for (const optim::SolverName name : names) {
    words.push_back(to_string(name));
    meaning += (meaning.empty() ? "`" : "; `") + words.back() + "`: " + description(name);
  }
  std::vector<targets::Key> keys = {
      {"name", value::choice(words), targets::by_default(words[0].c_str()), meaning}};
  if (starts)
    keys.push_back({"starts", &SolverSection::starts, value::integer(1, 10'000), targets::by_default(*starts),
                    "searches, each from another start"});
  keys.push_back({"max_evaluations", &SolverSection::max_evaluations, value::integer(1, 10'000'000),
                  targets::by_default(max_evaluations), "most evaluations " + of_what});
  return targets::KeyTable(std::move(keys));
}

SolverSection read_solver(const targets::Section& root) {
  SolverSection solver;
  const targets::Section section = root.section("solver");
  if (const auto node = section.optional("name")) solver.name = read_solver_name(*node);
  section.read_into(solver);
  return solver;
}

targets::Key symmetry_key(const std::string& meaning) {
  return {"symmetry", value::choice(symmetries), targets::by_default("none"), meaning};
}

optim::Symmetry read_symmetry(const targets::Section& section, int columns, int rows) {
  Symmetry symmetry = Symmetry::none;
  section.read("symmetry", symmetry, symmetries);
  if (symmetry == Symmetry::rotate_4 && columns != rows)
    throw section.optional("symmetry")
        ->error("rotate_4 needs as many columns as rows, and structure.cells is [" + std::to_string(columns) +
                ", " + std::to_string(rows) + "]; allowed here: none, mirror_x, mirror_y, rotate_2");
  return symmetry;
}

}  // namespace kinetix::app
