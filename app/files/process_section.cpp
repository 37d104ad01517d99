#include "app/files/process_section.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace kinetix::app {
namespace {

namespace value = targets::value;

std::vector<std::string> process_names() {
  std::vector<std::string> names;
  for (const model::Process& process : model::processes()) names.push_back(process.name);
  return names;
}

std::string sd_meaning(double model::PrintError::*field, const char* what) {
  std::string text = std::string("standard deviation of ") + what + ", from hinge to hinge";
  for (const model::Process& p : model::processes())
    text += fmt::format("{} {} {}", &p == &model::processes().front() ? ":" : ",", p.name, p.sd.*field);
  return text;
}

const targets::KeyTable& sd_keys() {
  static const targets::KeyTable keys({
      {"t_mm", value::number(targets::from_to(0, 10, "mm")), targets::otherwise("the process's"),
       sd_meaning(&model::PrintError::t_mm, "a hinge's place along its wall")},
      {"tilt_deg", value::number(targets::from_to(0, 45, "degrees")), targets::otherwise("the process's"),
       sd_meaning(&model::PrintError::tilt_deg, "a wall's tilt")},
      {"clearance_mm", value::number(targets::from_to(0, 10, "mm")), targets::otherwise("the process's"),
       sd_meaning(&model::PrintError::clearance_mm, "a pin's clearance")},
  });
  return keys;
}

const targets::KeyTable& own_process_keys() {
  static const targets::KeyTable keys({
      {"base", value::choice(process_names()), targets::by_default(process_names().front().c_str()),
       "the process that all other numbers come from"},
      {"sd", value::map(sd_keys()), {}, "how far prints are from what was designed"},
  });
  return keys;
}

const model::Process& named(const targets::Node& node) {
  const std::vector<std::string> names = process_names();
  return model::processes()[node.one_of({names.begin(), names.end()})];
}

}  // namespace

targets::Key process_key() {
  return {
      "process", value::either({value::choice(process_names()), value::map(own_process_keys())}),
      targets::by_default(process_names().front().c_str()),
      "how it is to be printed ([hinges.md](hinges.md)): what prints with such errors come to is said with "
      "the result"};
}

std::string problem_text(const model::PrintProblem& problem) {
  return fmt::format("{}; with the same proportions a cell_mm of {:.3g} could be", problem.what,
                     problem.cell_mm);
}

model::Process read_process(const targets::Section& root) {
  const auto node = root.optional("process");
  if (!node) return model::processes().front();
  if (node->kind() != targets::Node::Kind::map) return named(*node);
  const targets::Section own(*node, own_process_keys());
  const auto base = own.optional("base");
  model::Process process = base ? named(*base) : model::processes().front();
  const targets::Section sd = own.section("sd");
  sd.read("t_mm", process.sd.t_mm);
  sd.read("tilt_deg", process.sd.tilt_deg);
  sd.read("clearance_mm", process.sd.clearance_mm);
  return process;
}

model::Process read_process(const targets::Section& root, const model::CellSize& size,
                            const std::optional<model::MadeHinge>& made) {
  const model::Process process = read_process(root);
  const auto node = root.optional("process");
  if (!node) return process;
  const auto problems = print_problems(process, size, made);
  if (problems.empty()) return process;
  throw node->error(problems.front().what +
                    fmt::format("; with the same proportions a cell_mm of {:.3g} could be",
                                least_cell_mm(process, size, made)));
}

}  // namespace kinetix::app
