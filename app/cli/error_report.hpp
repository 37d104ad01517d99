#pragma once

#include <exception>
#include <string>

#include "model/base/invalid_input.hpp"

namespace kinetix::app {

/// One line on stderr; where JSON was asked for, the same as a document on stdout:
/// `{"error": {"exit_code", "message", "file", "line", "column", "key", "reason"}}`, place as far as it is known.
/// @param exit_code that the program ends with
void report_error(const InvalidInput& error, int exit_code, bool as_json);
/// That document alone, of an error that stands on stderr already.
void print_error(const std::string& message, int exit_code);
/// What to say of an exception that is no bad input: that the machine gave out, where it did, else that the program has a bug.
std::string failure_text(const std::exception& error);
/// For std::set_terminate. Removes unfinished files, prints one line and ends the program with code 1. An exception in a thread
/// of a library comes here, for one. Allocates no memory.
[[noreturn]] void end_with_a_word() noexcept;

}  // namespace kinetix::app
