#include "app/files/file_header.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <system_error>

namespace kinetix::app {
namespace {

constexpr int supported_version = 1;       // the only version of the file format
constexpr std::size_t longest_name = 100;  // characters: file systems allow 255, endings included
// Description of allowed names in messages and the documentation.
constexpr const char* wanted_name = "1 to 100 letters, digits, `_`, `-` and `.`, not starting with a point";

bool is_allowed(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.';
}

std::string file_stem(const targets::Section& root) {
  std::string stem = std::filesystem::path(root.node().place().file).stem().string().substr(0, longest_name);
  std::replace_if(
      stem.begin(), stem.end(), [](char c) { return !is_allowed(c); }, '_');
  if (stem.empty() || stem[0] == '.') stem.insert(0, "_");
  return stem;
}

}  // namespace

targets::KeyTable file_keys(std::vector<targets::Key> own) {
  own.insert(own.begin(),
             {{"kinetix", targets::value::integer(supported_version, supported_version), targets::needed,
               "version of the file format"},
              {"name", targets::value::text(wanted_name),
               targets::otherwise("the file's name without its ending, with `_` for other characters"),
               "name of the result and of its folder"}});
  return targets::KeyTable(std::move(own));
}

void refuse_result(const targets::Node& root) {
  namespace fs = std::filesystem;
  if (root.kind() != targets::Node::Kind::map || root.optional("kinetix")) return;
  const auto schema = root.optional("schema");
  if (!schema || schema->kind() != targets::Node::Kind::scalar) return;
  const fs::path beside = fs::path(root.folder()) / "design.yaml";
  std::error_code failure;  // ignored: in a folder that cannot be read no design is found
  throw root.error(
      "this file is a result, not a design. Give " +
      (fs::exists(beside, failure)
           ? beside.string()
           : std::string("the design.yaml that was written with it, which is not in its folder")));
}

void check_version(const targets::Section& root) {
  const targets::Node version = root.required("kinetix", "`kinetix: 1`, the version of the file format");
  const int number = version.integer(0, 1'000'000);
  if (number != supported_version)
    throw version.error("version " + std::to_string(number) + " is not supported. Write `kinetix: 1`");
}

targets::Section read_root(const targets::Node& node, const targets::KeyTable& keys) {
  const targets::Section root(node, keys);
  check_version(root);
  return root;
}

std::string read_name(const targets::Section& root) {
  const auto node = root.optional("name");
  if (!node) return file_stem(root);
  return usable_name(*node);
}

std::string usable_name(const targets::Node& node) {
  const std::string name = node.text(wanted_name);
  const bool is_good = std::all_of(name.begin(), name.end(), is_allowed) && name[0] != '.';
  if (!is_good || name.size() > longest_name)
    throw node.error(std::string("the name cannot be the name of a folder. Give ") + wanted_name);
  return name;
}

}  // namespace kinetix::app
