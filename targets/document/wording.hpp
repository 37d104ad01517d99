#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace kinetix::targets {

using Names = std::span<const std::string_view>;

/// The text in backticks as it stands in a message: at most 40 characters, control characters as `?`.
std::string in_ticks(std::string_view text);

/// ASCII letters in lower case, everything else as it stands.
std::string lower_case(std::string_view text);

/// Whether a byte continues a UTF-8 character that began before it.
bool continues_character(char c);

/// "a, b, c"
std::string joined(Names names);

/// Bytes. Names longer than this are not compared with others: none that is known is nearly as long, and the
/// comparison takes time with the product of both lengths.
inline constexpr std::size_t longest_name = 64;

/// Levenshtein distance in which two swapped neighbours count as one step.
int spelling_distance(std::string_view a, std::string_view b);

/// " (did you mean `b`?)" for the allowed name that is nearest in spelling; empty when none is near.
std::string did_you_mean(std::string_view name, Names allowed);

/// "1 factor", "2 factors", "0 factors": of a noun that takes an s.
std::string counted(std::size_t count, std::string_view noun);

/// "1 MiB", "16 MiB", "900 bytes"
std::string byte_count(std::size_t bytes);

/// Guard that stops in_ticks() of this thread from quoting a file outside the folder of the document that names it. A
/// stranger's target may name any file of the machine, and messages are sent to strangers.
class HiddenQuotes {
 public:
  /// @param file as it is opened   @param folder of the document that names it; empty: the working folder
  HiddenQuotes(const std::string& file, const std::string& folder);
  ~HiddenQuotes();
  HiddenQuotes(const HiddenQuotes&) = delete;
  HiddenQuotes& operator=(const HiddenQuotes&) = delete;

 private:
  bool before_;
};

}  // namespace kinetix::targets
