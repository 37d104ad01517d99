#include "app/file_header.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace kinetix {
namespace {

constexpr int supported_version = 1;
constexpr std::size_t longest_name = 100;

bool is_allowed(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.';
}

std::string file_stem(const Node& root) {
  std::string stem = std::filesystem::path(root.place().file).stem().string().substr(0, longest_name);
  std::replace_if(
      stem.begin(), stem.end(), [](char c) { return !is_allowed(c); }, '_');
  if (stem.empty() || stem[0] == '.') stem.insert(0, "_");
  return stem;
}

}  // namespace

void check_version(const Node& root) {
  const Node version = root.required("kinetix", "`kinetix: 1`, the version of the file format");
  const int number = version.integer(0, 1'000'000);
  if (number != supported_version)
    throw version.error("version " + std::to_string(number) +
                        " is not supported; this program reads version 1");
}

std::string read_name(const Node& root) {
  const auto node = root.optional("name");
  if (!node) return file_stem(root);
  constexpr const char* wanted =
      "1 to 100 letters, digits, `_`, `-` and `.`, not starting with a point, since it names a folder";
  const std::string name = node->text(wanted);
  const bool is_good = std::all_of(name.begin(), name.end(), is_allowed) && name[0] != '.';
  if (!is_good || name.size() > longest_name)
    throw node->error(std::string("is not a usable name; give ") + wanted);
  return name;
}

}  // namespace kinetix
