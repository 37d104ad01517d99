#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "app/console/console.hpp"
#include "app/imports/import_command.hpp"
#include "app/print/export_command.hpp"
#include "app/studio/view_command.hpp"

namespace kinetix::app {

/// Values of a parsed command line.
struct CommandLine {
  CommandOptions options = {};
  PrintRequest print = {};
  ImportRequest model = {};
  ViewRequest view = {};
  std::string share = {};  ///< of sweep: K/N
};

/// Adds all options and commands. @param line filled by parsing; lives as long as the app
void add_options(CLI::App& app, CommandLine& line);

/// Formatter of --help. Lines end at the width of the terminal, and placeholders of options name their unit.
class HelpFormatter : public CLI::Formatter {
 public:
  /// @param width of a line, characters
  explicit HelpFormatter(int width) : width_(width) {}

  std::string make_description(const CLI::App* app) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;

 private:
  std::string row(const std::string& name, const std::string& description) const;

  int width_;
};

/// Returns the width of the terminal on standard output, at most 100 characters; without a terminal 80.
int help_width();

/// Returns the text at the end of the help of a command, with two examples. @param command empty: the search
std::string help_footer(const std::string& command);

/// Returns the text for a command line without any argument: a first target, and the kinds of goals.
std::string start_text();

}  // namespace kinetix::app
