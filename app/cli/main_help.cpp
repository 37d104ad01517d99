#include "app/cli/main_options.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>
#include <algorithm>
#include <sstream>

#include "app/goals/registry.hpp"

namespace kinetix::app {
namespace {

constexpr int name_width = 28;   // characters: of the column of names
constexpr int usual_width = 80;  // characters: of a line without a terminal
constexpr int min_width = 60;    // characters: less leaves no room next to the names
constexpr int max_width = 100;   // characters: longer lines are hard to read

/// Two examples of a command.
struct CommandExamples {
  std::string_view command;  ///< empty: the search
  std::string_view lines[2];
};

constexpr CommandExamples all_examples[] = {
    {"", {"kinetix-opt targets/shapes/helmet_rib.yaml -o out", "kinetix-opt wave.yaml --process fdm --open"}},
    {"verify", {"kinetix-opt verify out", "kinetix-opt verify panel.yaml --fidelity -o checked"}},
    {"simulate",
     {"kinetix-opt simulate out --fold-angle-deg 20",
      "kinetix-opt simulate panel.yaml --model equilibrium --drives"}},
    {"sweep",
     {"kinetix-opt sweep sweep.yaml -o table --open", "kinetix-opt sweep sweep.yaml -o table --resume"}},
    {"check", {"kinetix-opt check wave.yaml", "kinetix-opt check out --process fdm"}},
    {"export",
     {"kinetix-opt export --coupon --process fdm -o coupon",
      "kinetix-opt export out --process fdm --clearance 0.3 --format 3mf"}},
    {"import",
     {"kinetix-opt import model.3mf -o imported",
      "kinetix-opt import --hard walls.stl --soft hinges.stl --unit mm"}},
    {"view", {"kinetix-opt view", "kinetix-opt view out --port 8080"}}};

constexpr const char* exit_codes = R"(
exit codes:
  0 done   1 internal error   2 bad input
  3 goal missed, not printable, or not reached by its drive
  4 simulation disagrees or failed   130 Ctrl-C before there was a result

documentation: share/doc/kinetix/html/index.html,
  or build/site/index.html after make site
)";

/// Breaks a text into lines of at most `width` characters. Continuation lines start with `indent` more spaces.
std::string wrapped(const std::string& text, int width, int indent) {
  std::istringstream words(text);
  std::string out;
  int column = 0;
  for (std::string word; words >> word;) {
    const int length = static_cast<int>(word.size());
    const bool fits = column + 1 + length <= width;
    if (column > 0 && fits) out += ' ';
    if (column > 0 && !fits) {
      out += "\n" + std::string(static_cast<std::size_t>(indent), ' ');
      column = 0;
    }
    column += length + (column > 0 ? 1 : 0);
    out += word;
  }
  return out;
}

/// Returns the names that the help shows: of several long names the first.
std::string shown_name(const CLI::Option& option, bool is_positional) {
  if (is_positional) return option.get_name(true, false);
  std::string name;
  for (const std::string& letter : option.get_snames()) name += "-" + letter;
  if (!option.get_lnames().empty()) name += (name.empty() ? "--" : ",--") + option.get_lnames().front();
  return name;
}

std::string examples_text(const std::string& command) {
  std::string text = "examples:\n";
  for (const CommandExamples& examples : all_examples)
    if (examples.command == command)
      for (const std::string_view line : examples.lines) text += fmt::format("  {}\n", line);
  return text;
}

std::string kinds_text() {
  std::string text = "kinds of goals:\n";
  for (const GoalKind* kind : goal_kinds())
    text += fmt::format("  {:<12} {}\n", kind->name, kind->meaning.empty() ? kind->example : kind->meaning);
  return text;
}

}  // namespace

std::string HelpFormatter::row(const std::string& name, const std::string& description) const {
  const std::string start = "  " + name;
  const bool fits = static_cast<int>(start.size()) < name_width;
  const std::string indent(static_cast<std::size_t>(name_width), ' ');
  return (fits ? fmt::format("{:<{}}", start, name_width) : start + "\n" + indent) +
         wrapped(description, width_ - name_width, name_width) + "\n";
}

std::string HelpFormatter::make_description(const CLI::App* app) const {
  return wrapped(app->get_description(), width_, 0) + "\n";
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  return row(command->get_name(), command->get_description());
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  std::string placeholder = option->get_type_size() == 0 ? "" : option->get_type_name();
  placeholder.erase(std::min(placeholder.find(':'), placeholder.size()));  // the validator's range
  return row(shown_name(*option, is_positional) + (placeholder.empty() ? "" : " " + placeholder),
             option->get_description());
}

int help_width() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return usual_width;
  return std::clamp(static_cast<int>(size.ws_col), min_width, max_width);
}

std::string help_footer(const std::string& command) {
  std::string text = examples_text(command);
  if (!command.empty()) return text;
  return kinds_text() + "\n" + text + exit_codes;
}

std::string start_text() {
  return "kinetix-opt designs flat sheets that fold into a goal. Give it a file such as goal.yaml:\n"
         "  kinetix: 1\n"
         "  target: {kind: curve, points: [[0, 0], [60, 45], [130, 30], [200, 45], [260, 0]]}\n\n" +
         kinds_text() +
         "\nRun `kinetix-opt goal.yaml`, or `kinetix-opt view` for the studio. All options: `kinetix-opt "
         "--help`\n";
}

}  // namespace kinetix::app
