#include "targets/document/text_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "model/base/invalid_input.hpp"
#include "targets/document/document.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::targets {

std::size_t character_length(std::string_view text, std::size_t start) {
  const auto byte = [&](std::size_t k) {
    return start + k < text.size() ? static_cast<unsigned char>(text[start + k]) : 0u;
  };
  const unsigned first = byte(0), second = byte(1);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  const bool overlong = first < 0xC2 || (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool beyond = first > 0xF4 || (first == 0xF4 && second > 0x8F) || (first == 0xED && second > 0x9F);
  if (overlong || beyond) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(k) & 0xC0) != 0x80) return 0;
  return length;
}

namespace {

namespace fs = std::filesystem;

void check_regular_file(const std::string& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) throw InvalidInput("no such file", {file});
  if (error) throw InvalidInput("cannot be read: " + error.message(), {file});
  if (fs::is_directory(status)) throw InvalidInput("this is a folder. Give a file", {file});
  if (!fs::is_regular_file(status))
    throw InvalidInput("this is a pipe, a device or a socket. Give a regular file", {file});
}

void check_size(const std::string& file, std::size_t bytes, std::size_t max_bytes) {
  if (bytes > max_bytes)
    throw InvalidInput(
        "is too large: " + byte_count(bytes) + "; at most " + byte_count(max_bytes) + " are allowed", {file});
}

std::string read_at_most(const std::string& file, std::size_t max_bytes) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InvalidInput(std::string("cannot be read: ") + std::strerror(errno), {file});
  std::string text;
  char buffer[1 << 16];
  while (text.size() <= max_bytes && (stream.read(buffer, sizeof buffer) || stream.gcount() > 0))
    text.append(buffer, static_cast<std::size_t>(stream.gcount()));
  if (stream.bad()) throw InvalidInput("cannot be read: input error", {file});
  return text;
}

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte < 0x20 && c != '\t' && c != '\n' && c != '\r') || byte == 0x7f;
}

Place place_of(const std::string& file, const std::string& text, std::size_t position) {
  const auto lines = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(position), '\n');
  return {file, static_cast<int>(lines) + 1, column_of(text, position), {}};
}

void check_characters(const std::string& file, const std::string& text) {
  for (std::size_t k = 0; k < text.size();) {
    const std::size_t length = character_length(text, k);
    if (length == 0)
      throw InvalidInput("the file has a byte that is not UTF-8 text. Save the file as UTF-8",
                         place_of(file, text, k));
    if (is_control(text[k]))
      throw InvalidInput("a control character (byte " + std::to_string(static_cast<unsigned char>(text[k])) +
                             "). Give plain text",
                         place_of(file, text, k));
    k += length;
  }
}

}  // namespace

std::string read_bytes(const std::string& file, std::size_t max_bytes) {
  check_regular_file(file);
  std::error_code error;
  check_size(file, static_cast<std::size_t>(fs::file_size(file, error)), error ? SIZE_MAX : max_bytes);
  std::string bytes = read_at_most(file, max_bytes);
  check_size(file, bytes.size(), max_bytes);
  return bytes;
}

std::string read_text_file(const std::string& file, std::size_t max_bytes) {
  std::string text = read_bytes(file, max_bytes);
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  check_characters(file, text);
  return text;
}

int characters(const std::string& text, std::size_t from, std::size_t to) {
  int count = 0;
  for (std::size_t k = from; k < to; ++k) count += continues_character(text[k]) ? 0 : 1;
  return count;
}

std::size_t start_of_line(const std::string& text, std::size_t position) {
  const std::size_t end_before = position == 0 ? std::string::npos : text.rfind('\n', position - 1);
  return end_before == std::string::npos ? 0 : end_before + 1;
}

int column_of(const std::string& text, std::size_t position) {
  return 1 + characters(text, start_of_line(text, position), position);
}

std::optional<std::size_t> find_too_deep(std::string_view json) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t k = 0; k < json.size(); ++k) {
    const char c = json[k];
    if (in_string && c == '\\') ++k;
    if (c == '"') in_string = !in_string;
    if (in_string) continue;
    if ((c == '[' || c == '{') && ++depth > max_document_depth) return k;
    if (c == ']' || c == '}') --depth;
  }
  return std::nullopt;
}

}  // namespace kinetix::targets
