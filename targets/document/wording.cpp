#include "targets/document/wording.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <numeric>
#include <vector>

namespace kinetix::targets {
namespace {

constexpr std::size_t longest_quote = 40;  // bytes: keeps a message on a line or two, whatever the file holds

// Units after the underline of a key, and common mistakes for them.
constexpr std::string_view units[] = {"mm", "deg", "rad", "mpa", "s"};

thread_local bool quotes_are_hidden = false;

/// Whether a file is inside a folder, also through links. False if a path cannot be resolved.
bool is_inside(const std::string& file, const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code failure;
  const fs::path inner = fs::weakly_canonical(file, failure);
  if (failure) return false;
  const fs::path outer = fs::weakly_canonical(folder.empty() ? "." : folder, failure);
  if (failure) return false;
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

/// Whether names differ by a unit suffix, such as `theta` and `theta_deg`. A unit forgotten or added is as near as one
/// wrong letter.
bool differs_by_suffix(std::string_view a, std::string_view b) {
  if (a.size() > b.size()) std::swap(a, b);
  if (a.empty() || !b.starts_with(a) || b.size() == a.size() || b[a.size()] != '_') return false;
  return std::find(std::begin(units), std::end(units), b.substr(a.size() + 1)) != std::end(units);
}

}  // namespace

int spelling_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<int>> d(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = static_cast<int>(i);
  std::iota(d[0].begin(), d[0].end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int swap = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + swap});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

HiddenQuotes::HiddenQuotes(const std::string& file, const std::string& folder) : before_(quotes_are_hidden) {
  quotes_are_hidden = before_ || !is_inside(file, folder);
}

HiddenQuotes::~HiddenQuotes() { quotes_are_hidden = before_; }

std::string in_ticks(std::string_view text) {
  if (quotes_are_hidden)
    return "`...` (not quoted, as the file is outside of the folder of the one that names it)";
  std::size_t length = std::min(text.size(), longest_quote);
  while (length > 0 && length < text.size() && continues_character(text[length])) --length;
  std::string out = "`" + std::string(text.substr(0, length)) + (length < text.size() ? "...`" : "`");
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return out;
}

std::string joined(Names names) {
  std::string out;
  for (const std::string_view name : names) out += (out.empty() ? "" : ", ") + std::string(name);
  return out;
}

std::string did_you_mean(std::string_view name, Names allowed) {
  if (name.size() > longest_name) return {};
  const std::string asked = lower_case(name);
  std::string_view nearest;
  int least = std::min(1 + std::max(1, static_cast<int>(name.size()) / 3), static_cast<int>(name.size()));
  for (const std::string_view candidate : allowed) {
    const int d =
        std::min(differs_by_suffix(asked, candidate) ? 0 : 100, spelling_distance(asked, candidate));
    if (d >= least) continue;
    least = d;
    nearest = candidate;
  }
  return nearest.empty() ? "" : " (did you mean `" + std::string(nearest) + "`?)";
}

std::string counted(std::size_t count, std::string_view noun) {
  return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

std::string byte_count(std::size_t bytes) {
  constexpr std::size_t mebibyte = 1 << 20;
  if (bytes < mebibyte) return std::to_string(bytes) + " bytes";
  const std::size_t tenths = bytes / (mebibyte / 10);
  const std::string fraction = tenths % 10 == 0 ? "" : "." + std::to_string(tenths % 10);
  return std::to_string(tenths / 10) + fraction + " MiB";
}

}  // namespace kinetix::targets
