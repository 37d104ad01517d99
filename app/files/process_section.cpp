#include "app/files/process_section.hpp"

#include <fmt/format.h>
#include <cmath>

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
      {"t_mm", &model::PrintError::t_mm, value::number(targets::from_to(0, 10, "mm")),
       targets::otherwise("the process's"),
       sd_meaning(&model::PrintError::t_mm, "a hinge's place along its wall")},
      {"tilt_deg", &model::PrintError::tilt_deg, value::number(targets::from_to(0, 45, "degrees")),
       targets::otherwise("the process's"), sd_meaning(&model::PrintError::tilt_deg, "a wall's tilt")},
      {"clearance_mm", &model::PrintError::clearance_mm, value::number(targets::from_to(0, 10, "mm")),
       targets::otherwise("the process's"),
       sd_meaning(&model::PrintError::clearance_mm, "a pin's clearance")},
  });
  return keys;
}

/// Returns the key of a limit that differs between printers of a process.
targets::Key limit_key(const char* name, double model::Process::*field, const char* what) {
  std::string text = what;
  for (const model::Process& p : model::processes())
    text += fmt::format("{} {} {}", &p == &model::processes().front() ? ":" : ",", p.name, p.*field);
  return {name, field, value::number({0, 100, false, true, "mm"}), targets::otherwise("the process's"), text};
}

const targets::KeyTable& custom_process_keys() {
  static const targets::KeyTable keys({
      {"base", value::choice(process_names()), targets::by_default(process_names().front().c_str()),
       "the process that all other numbers come from"},
      limit_key("clearance_mm", &model::Process::clearance_mm, "least clearance of a pin, a side"),
      limit_key("least_wall_mm", &model::Process::min_wall_mm, "least thickness of a wall"),
      limit_key("least_pin_mm", &model::Process::min_pin_mm, "least diameter of a pin's rod"),
      {"sd", sd_keys(), "how far prints are from what was designed"},
  });
  return keys;
}

targets::Key key_of_process(const char* meaning) {
  return {"process", value::either({value::choice(process_names()), value::map(custom_process_keys())}),
          targets::by_default(process_names().front().c_str()), meaning};
}

const model::Process& named(const targets::Node& node) {
  const std::vector<std::string> names = process_names();
  return model::processes()[node.one_of({names.begin(), names.end()})];
}

}  // namespace

targets::Key process_key() {
  return key_of_process(
      "how it is to be printed ([hinges.md](hinges.md)): what prints with such errors come to is said with "
      "the result");
}

targets::Key design_process_key() {
  return key_of_process(
      "what `export` makes it for ([print.md](print.md)), if its `--process` does not say otherwise");
}

std::string process_text(const model::Process& process) {
  const model::Process& base = *model::find_process(process.name);
  if (process == base) return process.name;
  std::string own = custom_process_keys().text(process, base);
  if (const std::string sd = sd_keys().text(process.sd, base.sd); !sd.empty())
    own += fmt::format("{}sd: {{{}}}", own.empty() ? "" : ", ", sd);
  return fmt::format("{{base: {}, {}}}", process.name, own);
}

std::string problem_text(const model::PrintProblem& problem) {
  if (!std::isfinite(problem.cell_mm))
    return problem.what + ". Give at least that much; larger cells do not help";
  return fmt::format(
      "{}; it could be with a cell_mm of {:.3g}, as a larger sheet or one of fewer cells, if walls "
      "and hinges become as much larger: those that the file gives in mm stay as they are",
      problem.what, problem.cell_mm);
}

void note_process(const model::Process& process, const model::CellSize& size,
                  const std::optional<model::ManufacturedHinge>& made, std::vector<std::string>& notes) {
  for (const model::PrintProblem& problem : print_problems(process, size, made)) {
    const std::string note = problem_text(problem);
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
  }
}

model::Process read_process(const targets::Section& root) {
  const auto node = root.optional("process");
  if (!node) return model::processes().front();
  if (node->kind() != targets::Node::Kind::map) return named(*node);
  const targets::Section own(*node, custom_process_keys());
  const auto base = own.optional("base");
  model::Process process = base ? named(*base) : model::processes().front();
  own.read_into(process);
  own.read_into(process.sd);
  return process;
}

model::Process read_process(const targets::Section& root, const model::CellSize& size,
                            const std::optional<model::ManufacturedHinge>& made) {
  const model::Process process = read_process(root);
  const auto node = root.optional("process");
  if (!node) return process;
  const auto problems = print_problems(process, size, made);
  if (problems.empty()) return process;
  throw node->error(problem_text({problems.front().what, min_cell_mm(process, size, made)}));
}

}  // namespace kinetix::app
