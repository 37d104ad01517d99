#pragma once

#include <string_view>

#include "model/base/invalid_input.hpp"

namespace kinetix::targets {

/// Walks over the words of a mesh file in text, knowing the place of each for messages. Lines end with LF, CR
/// or both.
class MeshTokens {
 public:
  /// @param text must outlive the object @param backslash_continues whether a line may go on after a
  /// backslash
  /// @param line number of the text's first line
  explicit MeshTokens(std::string_view text, bool backslash_continues = false, int line = 1);

  /// Moves to the start of the next line; false at the end of the text.
  bool next_line();
  /// Returns the next word of the line; empty at its end.
  std::string_view word();
  /// Returns the next word, of this line or a later one; empty at the end of the text.
  std::string_view word_of_any_line();

  std::string_view last_word() const { return text_.substr(word_start_, next_ - word_start_); }

  /// Reads the next word of the line as a number, in the file's units. @throws InvalidInput unless it is a finite one
  double number(const char* what);
  /// Reads the next word, of this line or a later one, as a number, in the file's units. @throws InvalidInput unless
  /// it is a finite one
  double number_of_any_line(const char* what);
  /// Reads a word as a number, in the file's units. @throws InvalidInput at the last word unless it is a finite one
  double number_in(std::string_view text, const char* what) const;
  /// Reads a word as a whole number. @throws InvalidInput at the last word unless it is one
  long integer_in(std::string_view text, const char* what) const;

  /// Returns an error at the last word.
  InvalidInput error(const std::string& fault_text) const;

 private:
  void skip_blanks();

  std::string_view text_;
  bool backslash_continues_;
  std::size_t next_ = 0, line_start_ = 0, word_start_ = 0;
  int line_;
  bool started_ = false;
};

}  // namespace kinetix::targets
