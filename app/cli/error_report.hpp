#pragma once

#include <exception>

#include "model/base/invalid_input.hpp"

namespace kinetix::app {

/// Reports an error as one line on stderr. With `as_json` it also prints a document on stdout: `{"error":
/// {"exit_code", "message", "file", "line", "column", "key", "reason"}}`. The place is included as far as known.
/// @param exit_code that the program ends with
void report_error(const InvalidInput& error, int exit_code, bool as_json);
/// Prints the JSON document of an error that stderr already shows.
void print_error(const std::string& message, int exit_code);
/// Describes an exception that is not bad input: memory or threads ran out, or the program has a bug.
std::string failure_text(const std::exception& error);
/// Removes unfinished files, prints one line and ends the program with code 1. It is for std::set_terminate, which
/// also handles exceptions in threads of libraries. Allocates no memory.
[[noreturn]] void terminate_with_message() noexcept;

/// Rejects a file that a YAML file can name, or that `import` reads: points, pictures, meshes, drawings, crease patterns
/// and 3D models. The message has the lines of a YAML file that uses it.
/// @param file of a command line that expects a YAML file; it need not exist @throws InvalidInput for such a file
void refuse_wrong_file(const std::string& file);

}  // namespace kinetix::app
