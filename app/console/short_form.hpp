#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/run/goal_outcome.hpp"

namespace kinetix::app {

/// Largest size of the output of a command without `-v`.
inline constexpr std::size_t most_lines = 7, most_columns = 100;

/// Output of a command, ordered by importance.
struct ShortForm {
  std::string title;                       ///< name and verdict
  std::vector<SummaryLine> lines = {};     ///< label and text; parts of a text end with "; "
  std::vector<SummaryLine> problems = {};  ///< "warning" or "error" and a sentence; errors first
  std::vector<std::string> ends = {};      ///< last line: files and the next command; empty in a page
  std::string details = "with -v";         ///< where the long form is
};

/// Formats a short form: at most 7 lines of at most 100 columns, except for names of files that need more. Problems
/// replace the last of the lines. Only the first problem is shown, with the number of the others. A hint at the details
/// follows if there is room.
std::string format_short(const ShortForm& form);

/// Formats all lines and problems of a form, whatever their length.
std::string format_long(const ShortForm& form);

/// Formats one line of a summary: its label and its text.
std::string format_line(const SummaryLine& line);

/// Formats a number with at most 3 significant digits and without an exponent: "0.025", "12.3", "1024". A positive
/// number below 0.001 becomes "under 0.001".
std::string format_figures(double value);

/// Colours the words `warning:` and `error:` and the first line, which is red with errors, yellow with warnings and
/// green otherwise.
std::string coloured(std::string_view text);

/// Whether output is coloured. @param no_color value of the environment variable NO_COLOR; null if it is not set
bool uses_colour(bool is_terminal, const char* no_color);

/// Prints a form on stdout. @param verbose its long form
void print_on_stdout(const ShortForm& form, bool verbose);
/// Prints a text on stdout, in colour on a terminal unless NO_COLOR is set.
void print_on_stdout(const std::string& text);

}  // namespace kinetix::app
