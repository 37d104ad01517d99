#include "targets/mesh/mesh_formats.hpp"

#include <charconv>
#include <cmath>

#include "targets/document/wording.hpp"

namespace kinetix::targets {
namespace {

bool is_line_end(char c) { return c == '\n' || c == '\r'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

template <class Number>
bool parse(std::string_view text, Number& number) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

MeshTokens::MeshTokens(std::string_view text, bool backslash_continues, int line)
    : text_(text), backslash_continues_(backslash_continues), line_(line - 1) {}

bool MeshTokens::next_line() {
  if (started_) {
    while (next_ < text_.size() && !is_line_end(text_[next_])) ++next_;
    if (text_.substr(next_).starts_with("\r\n")) ++next_;
    if (next_ < text_.size()) ++next_;
  }
  started_ = true;
  ++line_;
  line_start_ = word_start_ = next_;
  return next_ < text_.size();
}

void MeshTokens::skip_blanks() {
  while (next_ < text_.size()) {
    const bool continues = backslash_continues_ && text_[next_] == '\\' && next_ + 1 < text_.size() &&
                           is_line_end(text_[next_ + 1]);
    if (continues) {
      ++next_;
      next_line();
    } else if (is_blank(text_[next_])) {
      ++next_;
    } else {
      return;
    }
  }
}

std::string_view MeshTokens::word() {
  skip_blanks();
  word_start_ = next_;
  const auto ends_word = [&](char c) {
    return is_blank(c) || is_line_end(c) || (backslash_continues_ && c == '\\');
  };
  while (next_ < text_.size() && !ends_word(text_[next_])) ++next_;
  return last_word();
}

std::string_view MeshTokens::word_of_any_line() {
  std::string_view found = started_ || next_line() ? word() : std::string_view();
  while (found.empty() && next_line()) found = word();
  return found;
}

double MeshTokens::number_in(std::string_view text, const char* what) const {
  double number = 0;
  if (text.empty())
    throw error(std::string("ends where ") + what + " is expected: the file is damaged. Export it again");
  if (!parse(text, number) || !std::isfinite(number))
    throw error(in_ticks(text) + " is not " + what + ". Give a finite number");
  return number;
}

double MeshTokens::number(const char* what) { return number_in(word(), what); }
double MeshTokens::number_of_any_line(const char* what) { return number_in(word_of_any_line(), what); }

long MeshTokens::integer_in(std::string_view text, const char* what) const {
  long integer = 0;
  if (text.empty())
    throw error(std::string("ends where ") + what + " is expected: the file is damaged. Export it again");
  if (!parse(text, integer)) throw error(in_ticks(text) + " is not " + what + ". Give a whole number");
  return integer;
}

InvalidInput MeshTokens::error(const std::string& fault_text) const {
  return InvalidInput(fault_text, {{}, line_, static_cast<int>(word_start_ - line_start_) + 1, {}});
}

}  // namespace kinetix::targets
