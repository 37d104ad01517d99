#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace kinetix::targets {

/// Bytes of the UTF-8 character at `start`; 0 where it is malformed. @pre start < text.size()
std::size_t character_length(std::string_view text, std::size_t start);

/// Reads the bytes of a file.
/// @throws InvalidInput with the file alone as place when it is missing, unreadable, a folder, a pipe or a device, or
/// larger than max_bytes (all found before anything is read)
std::string read_bytes(const std::string& file, std::size_t max_bytes);

/// Reads the text of a file, without a byte order mark.
/// @throws InvalidInput as read_bytes; with line and column when it holds bytes that are not UTF-8 or control
/// characters other than tab and line ends
std::string read_text_file(const std::string& file, std::size_t max_bytes);

/// Counts the UTF-8 characters that start in [from, to). @pre from <= to <= text.size()
int characters(const std::string& text, std::size_t from, std::size_t to);

/// Returns the start of the line that contains the byte at `position`. @pre position <= text.size()
std::size_t start_of_line(const std::string& text, std::size_t position);

/// Returns the column in characters, from 1, of the byte at `position`. @pre position <= text.size()
int column_of(const std::string& text, std::size_t position);

/// Finds the first bracket of a JSON text that is nested more than max_document_depth deep. Every reader of JSON
/// requires that there is none: the parser accepts any depth, but copies and printing recurse and exhaust the stack.
std::optional<std::size_t> find_too_deep(std::string_view json);

}  // namespace kinetix::targets
