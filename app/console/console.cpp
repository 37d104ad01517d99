#include "app/console/console.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

namespace kinetix::app {
namespace {

constexpr int bar_width = 30;  // characters: leaves room for stage and note on a line of 80

spdlog::logger& log() {
  static const auto logger = [] {
    auto made = spdlog::stderr_logger_mt("kinetix");
    made->set_pattern("%v");
    return made;
  }();
  return *logger;
}

}  // namespace

Console::Console(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1) {}

Console::~Console() { clear_line(); }

void Console::clear_line() {
  if (terminal_ && shown_percent_ >= 0) fmt::print(stderr, "\r\033[K");
  shown_percent_ = -1;
}

void Console::stage(const std::string& name, double done, const std::string& note) {
  if (quiet_) return;
  if (name != stage_) {
    clear_line();
    stage_ = name;
    if (!terminal_) log().info("{} ...", name);
  }
  const int percent = static_cast<int>(100 * done);
  if (!terminal_ || done < 0 || (percent == shown_percent_ && note == note_)) return;
  shown_percent_ = percent;
  note_ = note;
  const int filled = bar_width * percent / 100;
  fmt::print(stderr, "\r{:<12} [{:#<{}}{:.<{}}] {:3d} % {}\033[K", name, "", filled, "", bar_width - filled,
             percent, note);
  std::fflush(stderr);
}

void Console::error(const std::string& message) {
  clear_line();
  log().error("{}", message);
}

Progress Console::progress() {
  return [this](const std::string& name, double done) { stage(name, done); };
}

}  // namespace kinetix::app
