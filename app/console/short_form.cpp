#include "app/console/short_form.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "app/console/console.hpp"

namespace kinetix::app {
namespace {

constexpr std::size_t text_column = 11;        // columns: two spaces, a label of eight characters, a space
constexpr std::size_t most_problem_lines = 2;  // a longer problem is cut, and `-v` prints all of it

/// Returns the width of a text in columns: its characters, of which UTF-8 may need several bytes each.
std::size_t columns_of(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

/// Returns the number of bytes of a text that fit into some columns, up to the last space.
std::size_t fitting_bytes(std::string_view text, std::size_t columns) {
  std::size_t end = 0, last_space = 0;
  for (std::size_t used = 0; end < text.size(); ++end) {
    if ((text[end] & 0xc0) != 0x80 && ++used > columns) break;
    if (text[end] == ' ') last_space = end;
  }
  return end == text.size() || last_space == 0 ? end : last_space;
}

std::vector<std::string> wrap(std::string_view text, std::size_t columns) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t bytes = fitting_bytes(text, columns);
    lines.emplace_back(text.substr(0, bytes));
    text.remove_prefix(bytes);
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  }
  return lines;
}

/// Shortens a text to some columns: drops its last parts, or else its last words.
std::string shorten(std::string text, std::size_t columns) {
  while (columns_of(text) > columns) {
    const std::size_t part = text.rfind("; ");
    if (part == std::string::npos) return text.substr(0, fitting_bytes(text, columns - 4)) + " ...";
    text.resize(part);
  }
  return text;
}

/// Formats the first problem in at most two lines, with the number of the others.
std::vector<std::string> problem_block(const ShortForm& form) {
  if (form.problems.empty()) return {};
  const auto& [level, text] = form.problems.front();
  const std::size_t others = form.problems.size() - 1, width = most_columns - text_column;
  const std::string more = others > 0 ? fmt::format(" ({} more {})", others, form.details) : "";
  std::vector<std::string> lines = wrap(text + more, width);
  if (lines.size() > most_problem_lines) {
    const std::string cut = " ..." + (more.empty() ? " (all " + form.details + ")" : more);
    lines = wrap(text, width);
    lines.resize(most_problem_lines);
    std::string& last = lines.back();
    last = last.substr(0, fitting_bytes(last, width - columns_of(cut))) + cut;
  }
  for (std::size_t k = 0; k < lines.size(); ++k)
    lines[k] = fmt::format("{:<{}}{}", k == 0 ? "  " + level + ":" : "", text_column, lines[k]);
  return lines;
}

/// Appends a part to the last line if it fits there.
bool append_part(std::vector<std::string>& lines, const std::string& part) {
  constexpr std::string_view between = "   ";
  if (lines.empty() || columns_of(lines.back()) + between.size() + columns_of(part) > most_columns)
    return false;
  lines.back() += std::string(between) + part;
  return true;
}

/// Puts files and the next command on one line if they fit, else on one line each. Adds the hint at the details only
/// if it fits.
std::vector<std::string> last_lines(const ShortForm& form) {
  std::vector<std::string> lines;
  for (const std::string& part : form.ends)
    if (!append_part(lines, part)) lines.push_back(part);
  append_part(lines, "(more " + form.details + ")");
  return lines;
}

constexpr const char* ansi_red = "\033[31m";
constexpr const char* ansi_yellow = "\033[33m";
constexpr const char* ansi_green = "\033[32m";
constexpr const char* ansi_plain = "\033[0m";

bool starts_with_word(std::string_view line, std::string_view word) {
  const std::size_t start = line.find_first_not_of(' ');
  return start != std::string_view::npos && line.substr(start).starts_with(word);
}

}  // namespace

std::string format_line(const SummaryLine& line) { return fmt::format("  {:<8} {}\n", line[0], line[1]); }

std::string format_short(const ShortForm& form) {
  const std::vector<std::string> problems = problem_block(form), last = last_lines(form);
  const std::size_t used = 1 + problems.size() + last.size();
  const std::size_t room = most_lines - std::min(used, most_lines);
  std::string out = form.title + "\n";
  for (std::size_t k = 0; k < std::min(room, form.lines.size()); ++k)
    out += format_line({form.lines[k][0], shorten(form.lines[k][1], most_columns - text_column)});
  for (const std::string& line : problems) out += line + "\n";
  for (const std::string& line : last) out += line + "\n";
  return out;
}

std::string format_long(const ShortForm& form) {
  std::string out = form.title + "\n";
  for (const SummaryLine& line : form.lines) out += format_line(line);
  for (const auto& [level, text] : form.problems) out += format_line({level + ":", text});
  for (const std::string& part : form.ends) out += part + "\n";
  return out;
}

std::string format_figures(double value) {
  constexpr double least = 1e-3;
  if (!std::isfinite(value)) return "unknown";
  const double size = std::abs(value);
  if (size == 0) return "0";
  if (size < least) return value > 0 ? "under 0.001" : "above -0.001";
  const int decimals = std::clamp(2 - static_cast<int>(std::floor(std::log10(size))), 0, 5);
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (decimals > 0) text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string coloured(std::string_view text) {
  std::string out, title = ansi_green;
  bool is_first = true;
  std::string body;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (is_first) {
      out = line;
      is_first = false;
      continue;
    }
    std::string shown = line;
    for (const auto& [word, colour] : {std::pair("warning:", ansi_yellow), std::pair("error:", ansi_red)}) {
      if (!starts_with_word(line, word)) continue;
      shown.replace(shown.find(word), std::string_view(word).size(), std::string(colour) + word + ansi_plain);
      if (title != ansi_red) title = colour;
    }
    body += shown + "\n";
  }
  return title + out + ansi_plain + "\n" + body;
}

bool uses_colour(bool is_terminal, const char* no_color) {
  return is_terminal && (no_color == nullptr || *no_color == '\0');
}

void print_on_stdout(const ShortForm& form, bool verbose) {
  print_on_stdout(verbose ? format_long(form) : format_short(form));
}

void print_on_stdout(const std::string& text) {
  if (!uses_colour(isatty(STDOUT_FILENO) == 1, std::getenv("NO_COLOR"))) {
    std::cout << text;
    return;
  }
  std::cout.flush();
  const std::string shown = coloured(printable(text));  // past the filter of std::cout, which escapes colours
  std::fwrite(shown.data(), 1, shown.size(), stdout);
  std::fflush(stdout);
}

}  // namespace kinetix::app
