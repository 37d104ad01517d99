#include "app/console/printable_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <iterator>

#include "targets/document/utf8.hpp"

namespace kinetix::app {
namespace {

/// Code point of the UTF-8 character that these bytes are.
unsigned code_point(std::string_view character) {
  const auto lead = static_cast<unsigned char>(character[0]);
  unsigned code = character.size() == 1 ? lead : lead & (0xffu >> (character.size() + 1));
  for (const char c : character.substr(1)) code = code << 6 | (static_cast<unsigned char>(c) & 0x3fu);
  return code;
}

/// C0 and C1 of ISO 6429, and what turns the direction of text (Unicode, UAX 9).
bool changes_terminal(unsigned code) {
  return (code < 0x20 && code != '\t' && code != '\n') || (code >= 0x7f && code < 0xa0) ||
         (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

bool is_plain(char c) { return (c >= 0x20 && c < 0x7f) || c == '\n' || c == '\t'; }

}  // namespace

std::string printable(std::string_view text) {
  if (std::all_of(text.begin(), text.end(), is_plain)) return std::string(text);
  std::string out;
  for (std::size_t k = 0; k < text.size();) {
    const std::size_t length = targets::character_length(text, k);
    const std::string_view character = text.substr(k, std::max<std::size_t>(length, 1));
    k += character.size();
    if (length == 0)
      fmt::format_to(std::back_inserter(out), "\\x{:02x}", static_cast<unsigned char>(character[0]));
    else if (const unsigned code = code_point(character); changes_terminal(code))
      fmt::format_to(std::back_inserter(out), "\\u{:04x}", code);
    else
      out += character;
  }
  return out;
}

std::string printable_line(std::string_view text) {
  std::string out;
  for (const char c : printable(text))
    if (c == '\n')
      out += "\\n";
    else
      out += c;
  return out;
}

std::streamsize PrintableStreams::Buffer::xsputn(const char* text, std::streamsize count) {
  const std::string shown = printable({text, static_cast<std::size_t>(count)});
  const auto size = static_cast<std::streamsize>(shown.size());
  return to_->sputn(shown.data(), size) == size ? count : 0;
}

PrintableStreams::Buffer::int_type PrintableStreams::Buffer::overflow(int_type c) {
  if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
  const char character = traits_type::to_char_type(c);
  return xsputn(&character, 1) == 1 ? c : traits_type::eof();
}

PrintableStreams::PrintableStreams() : out_(std::cout.rdbuf()), error_(std::cerr.rdbuf()) {
  std::cout.rdbuf(&out_);
  std::cerr.rdbuf(&error_);
}

PrintableStreams::~PrintableStreams() {
  std::cout.rdbuf(out_.to());
  std::cerr.rdbuf(error_.to());
}

}  // namespace kinetix::app
