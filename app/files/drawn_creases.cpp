#include <fmt/format.h>
#include <array>
#include <charconv>
#include <cmath>

#include "app/files/crease_pattern.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {
namespace {

constexpr const char* crease_colours =
    "red for mountains, blue for valleys, black for the boundary, yellow for flat creases, green for cuts, "
    "or "
    "magenta for creases without a letter";

/// Returns the letter of a colour, 0xRRGGBB; 0 for colours without one.
char letter_of_colour(int colour) {
  constexpr int bright = 0xA0, dark = 0x60;
  const int red = colour >> 16 & 0xFF, green = colour >> 8 & 0xFF, blue = colour & 0xFF;
  const auto is = [&](bool r, bool g, bool b) {
    return (r ? red >= bright : red <= dark) && (g ? green >= bright : green <= dark) &&
           (b ? blue >= bright : blue <= dark);
  };
  constexpr int css_green = 0x008000;
  if (colour == css_green || is(false, true, false)) return 'C';
  if (is(true, false, false)) return 'M';
  if (is(false, false, true)) return 'V';
  if (is(false, false, false)) return 'B';
  if (is(true, true, false)) return 'F';
  if (is(true, false, true)) return 'U';
  return 0;
}

/// Reads one line of a `.cp` file: a kind and four coordinates.
std::array<double, 5> numbers_of(std::string_view text, int line) {
  std::array<double, 5> out{};
  constexpr std::string_view blanks = " \t\r,";
  std::size_t count = 0;
  for (std::size_t at = text.find_first_not_of(blanks); at != std::string_view::npos;
       at = text.find_first_not_of(blanks, at)) {
    const std::size_t end = std::min(text.size(), text.find_first_of(blanks, at));
    double number = 0;
    const auto [stop, error] = std::from_chars(text.data() + at, text.data() + end, number);
    if (count == out.size() || error != std::errc() || stop != text.data() + end || !std::isfinite(number))
      throw InvalidInput(
          "this is not a line of a crease pattern. Give a kind and the two ends: `2 x1 y1 x2 y2`",
          {"", line, static_cast<int>(at) + 1});
    out[count++] = number;
    at = end;
  }
  if (count != out.size())
    throw InvalidInput(
        fmt::format("the line has {} numbers. Give a kind and the two ends: `2 x1 y1 x2 y2`", count),
        {"", line, 1});
  return out;
}

}  // namespace

CreaseLines read_drawn_creases(const targets::Drawing& drawing) {
  CreaseLines out{drawing.lines};
  for (const auto& [from, to, line, colour, chord_of] : drawing.lines) {
    if (chord_of >= 0)
      throw InvalidInput(fmt::format("a curve ({}) is not a crease that folds. Draw straight creases",
                                     drawing.curves[chord_of]),
                         {"", line, 1});
    const char letter = letter_of_colour(colour);
    if (letter == 0)
      throw InvalidInput(
          fmt::format("creases do not have the colour #{:06x}. Use {}", colour, crease_colours),
          {"", line, 1});
    out.letters.push_back(letter);
  }
  if (std::find_if(out.letters.begin(), out.letters.end(),
                   [](char c) { return c == 'M' || c == 'V' || c == 'U'; }) == out.letters.end())
    throw InvalidInput(fmt::format("the drawing has no creases by their colours. Use {}", crease_colours));
  // A px of a screen is no size of a sheet: Origami Simulator has patterns of any size in px.
  if (drawing.has_unit && drawing.unit_source.find("px") == std::string::npos) out.unit_mm = drawing.unit_mm;
  return out;
}

CreaseLines read_cp_creases(const std::string& text) {
  CreaseLines out;
  int line = 0;
  for (std::size_t start = 0; start < text.size(); ++line) {
    const std::size_t end = std::min(text.size(), text.find('\n', start));
    const std::string_view row = std::string_view(text).substr(start, end - start);
    start = end + 1;
    if (row.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    const auto [kind, x1, y1, x2, y2] = numbers_of(row, line + 1);
    if (out.lines.size() >= targets::max_drawn_lines)
      throw InvalidInput("the pattern has more than a million lines. Give a smaller one");
    out.lines.push_back({{x1, -y1}, {x2, -y2}, line + 1});
    out.letters.push_back(kind == 1 ? 'B' : kind == 2 ? 'M' : kind == 3 ? 'V' : 'F');
  }
  if (out.lines.empty())
    throw InvalidInput("this is not a crease pattern: it has no lines. Give lines of a kind and two ends");
  return out;
}

}  // namespace kinetix::app
