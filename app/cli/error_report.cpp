#include "app/cli/error_report.hpp"

#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <new>
#include <nlohmann/json.hpp>
#include <system_error>

#include "app/console/console.hpp"
#include "app/io/atomic_file.hpp"

namespace kinetix::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr char no_memory[] = "there is not enough memory";

/// Writes a line to stderr without a stream, since streams allocate memory. Bytes other than printable ASCII become
/// `?`: file names may hold control characters.
void write_line(const char* words) noexcept {
  for (; *words != '\0'; ++words) {
    const auto byte = static_cast<unsigned char>(*words);
    const char shown = byte < 0x20 || byte >= 0x7f ? '?' : *words;
    if (write(STDERR_FILENO, &shown, 1) < 0) return;
  }
  if (write(STDERR_FILENO, "\n", 1) < 0) return;
}

/// Formats a message on one line. Indented lines, such as those of a YAML file, stay lines.
std::string shown(const std::string& message) {
  std::string text = printable_line(message);
  for (std::size_t at = 0; (at = text.find("\\n  ", at)) != std::string::npos;) text.replace(at, 2, "\n");
  return text;
}

void print(const Json& error) {
  constexpr auto replace = Json::error_handler_t::replace;  // a file's name may hold bytes that are not UTF-8
  std::cout << Json{{"error", error}}.dump(1, ' ', false, replace) << std::endl;
}

}  // namespace

void report_error(const InvalidInput& error, int exit_code, bool as_json) {
  std::cerr << shown(error.what()) << "\n";
  if (!as_json) return;
  const Place& place = error.place();
  Json json = {{"exit_code", exit_code}, {"message", error.what()}, {"reason", error.reason()}};
  if (!place.file.empty()) json["file"] = place.file;
  if (place.line > 0) json["line"] = place.line;
  if (place.column > 0) json["column"] = place.column;
  if (!place.key.empty()) json["key"] = place.key;
  print(json);
}

void print_error(const std::string& message, int exit_code) {
  print({{"exit_code", exit_code}, {"message", message}});
}

std::string failure_text(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error)) return no_memory;
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  if (system && system->code() == std::errc::resource_unavailable_try_again)
    return "no further thread or process can be started: not enough memory, or a limit of this account";
  return std::string("internal error: ") + error.what();
}

void terminate_with_message() noexcept {
  remove_unfinished();
  try {
    if (const auto error = std::current_exception()) std::rethrow_exception(error);
    write_line("internal error: the program ended itself");
  } catch (const std::bad_alloc&) {
    write_line(no_memory);
  } catch (const std::exception& error) {
    write_line(error.what());
  } catch (...) {
    write_line("internal error: an exception of no known kind");
  }
  std::_Exit(internal_error);
}

}  // namespace kinetix::app
