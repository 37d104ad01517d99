#include "app/io/file_record.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "app/io/sha256.hpp"

namespace kinetix::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t hash_digits = 64;               // of SHA-256 in hexadecimal
constexpr std::size_t name_column = hash_digits + 2;  // characters: `sha256sum` puts two spaces between

std::map<std::string, std::string> read_record(const fs::path& file) {
  std::map<std::string, std::string> hashes;
  std::error_code missing;
  if (!fs::is_regular_file(file, missing)) return hashes;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.size() > name_column) hashes[line.substr(name_column)] = line.substr(0, hash_digits);
  return hashes;
}

/// Whether a name means a file of its own in the folder: no link, and no way out.
bool is_inside(const fs::path& folder, const fs::path& name) {
  if (name.is_absolute()) return false;
  std::error_code missing;
  const fs::path real = fs::canonical(folder / name, missing);
  return !missing && real == fs::canonical(folder, missing) / name && fs::is_regular_file(real, missing);
}

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void remove_with_empty_folder(const fs::path& folder, const fs::path& name) {
  std::error_code stays;
  fs::remove(folder / name, stays);
  if (name.has_parent_path()) fs::remove((folder / name).parent_path(), stays);
}

}  // namespace

FileRecord::FileRecord(std::string folder, std::string record)
    : folder_(std::move(folder)),
      record_(std::move(record)),
      earlier_(read_record(fs::path(folder_) / record_)) {}

void FileRecord::add(const std::string& file, std::string_view content) { now_[file] = sha256(content); }

void FileRecord::keep(const std::function<bool(const std::string& file)>& is_of_others) {
  for (const auto& [file, hash] : earlier_)
    if (is_of_others(file)) now_.emplace(file, hash);
}

std::optional<std::string> FileRecord::changed(const std::string& file) const {
  const auto earlier = earlier_.find(file);
  if (earlier == earlier_.end() || !is_inside(folder_, file)) return std::nullopt;
  std::string content = content_of(fs::path(folder_) / file);
  return sha256(content) == earlier->second ? std::nullopt : std::optional(std::move(content));
}

std::string FileRecord::text() const {
  std::string text;
  for (const auto& [file, hash] : now_) text += hash + "  " + file + "\n";
  return text;
}

void FileRecord::remove_what_is_left_over() const {
  for (const auto& [file, hash] : earlier_)
    if (!now_.contains(file) && is_inside(folder_, file) &&
        sha256(content_of(fs::path(folder_) / file)) == hash)
      remove_with_empty_folder(folder_, file);
  if (now_.empty() && !earlier_.empty()) remove_with_empty_folder(folder_, record_);
}

}  // namespace kinetix::app
