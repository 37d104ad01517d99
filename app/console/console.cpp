#include "app/console/console.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <spawn.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>
#include <algorithm>
#include <cstring>
#include <iostream>
#include <iterator>
#include <new>

#include "targets/document/text_file.hpp"

namespace kinetix::app {
namespace {

constexpr double min_share_for_estimate = 0.02;  // of a stage: a smaller share is too little for an estimate
constexpr double about_ratio = 1.25, about_s = 1;  // ratio and s by which "about" may be too short

}  // namespace

void TimeLeft::update(double seconds, double done) {
  if (done < 0 || done == done_) return;
  if (began_ < 0) {
    began_ = seconds;
    before_ = done;
  }
  done_ = done;
  if (done - before_ > min_share_for_estimate && done < 1)
    total_ = seconds + (seconds - began_) * (1 - done) / (done - before_);
}

std::optional<double> TimeLeft::at(double seconds) {
  const double left = total_ - seconds;
  if (!is_known() || !(left > 0)) return std::nullopt;
  displayed_s_ = std::min(displayed_s_, left);
  return left <= about_ratio * displayed_s_ + about_s ? std::optional(displayed_s_) : std::nullopt;
}

std::string TimeLeft::text(double seconds) {
  if (!is_known() || done_ >= 1) return "";
  const auto left = at(seconds);
  return left ? "about " + duration_text(*left) + " left" : "still working, longer than estimated";
}

std::string duration_text(double seconds) {
  const auto whole = static_cast<long>(seconds);
  if (seconds < 10) return fmt::format("{:.2g} s", seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

}  // namespace kinetix::app

extern char** environ;

namespace kinetix::app {
namespace {

constexpr int bar_width = 20;         // characters: leaves room for stage and note on a line of 80
constexpr std::size_t most_bar = 79;  // columns: a full line of 80 would wrap on some terminals
constexpr std::chrono::milliseconds refresh{1000};  // ms between updates of the line on a terminal
constexpr auto pulse = refresh / 4;                 // ms between checks: reports are at most this late
static_assert(pulse.count() > 0, "a heart that does not wait takes a core for itself");

/// Returns the mutex that is locked while the heartbeat writes and while this process forks. A child inherits all
/// locks of the memory allocator and of the stream. The thread that would unlock them is not in the child.
std::mutex& forks() {
  static std::mutex mutex;
  static const int registered =
      pthread_atfork([] { forks().lock(); }, [] { forks().unlock(); }, [] { forks().unlock(); });
  static_cast<void>(registered);
  return mutex;
}

spdlog::logger& log() {
  static const auto logger = [] {
    auto made = spdlog::stderr_logger_mt("kinetix");
    made->set_pattern("%v");
    return made;
  }();
  return *logger;
}

/// Returns the code point of one UTF-8 character.
unsigned code_point(std::string_view character) {
  const auto lead = static_cast<unsigned char>(character[0]);
  unsigned code = character.size() == 1 ? lead : lead & (0xffu >> (character.size() + 1));
  for (const char c : character.substr(1)) code = code << 6 | (static_cast<unsigned char>(c) & 0x3fu);
  return code;
}

/// Finds the control characters C0 and C1 (ISO 6429) and those that change the direction of text (Unicode, UAX 9).
bool changes_terminal(unsigned code) {
  return (code < 0x20 && code != '\t' && code != '\n') || (code >= 0x7f && code < 0xa0) ||
         (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

bool is_plain(char c) { return (c >= 0x20 && c < 0x7f) || c == '\n' || c == '\t'; }

}  // namespace

Console::Console(bool quiet, bool logs_starts, std::chrono::milliseconds between_lines)
    : quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      logs_starts_(logs_starts),
      between_lines_(between_lines) {
  forks();
  if (quiet_) return;
  heartbeat_ = std::thread([this] {
    awake_.count_down();
    heartbeat();
  });
  awake_.wait();
}

Console::~Console() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    clear_line();
  }
  end_.notify_one();
  if (heartbeat_.joinable()) heartbeat_.join();
}

void Console::heartbeat() {
  std::unique_lock lock(mutex_);
  while (!end_.wait_for(lock, pulse, [this] { return ends_; }))
    if (!stage_.empty() && Clock::now() >= next_) {
      const std::lock_guard alone(forks());
      try {
        show();
      } catch (const std::bad_alloc&) {
        stage_.clear();  // a run without memory for a note reports that itself
      }
    }
}

std::string Console::note(double seconds) {
  if (!note_.empty()) return note_;
  const std::string text = (so_far_.empty() ? "" : so_far_ + ", ") + duration_text(seconds),
                    left = done_ < 0 ? "" : left_.text(seconds);
  return left.empty() ? text : text + ", " + left;
}

Console::Clock::duration Console::interval() const { return terminal_ ? refresh : between_lines_; }

void Console::show() {
  next_ = repeats_ ? Clock::now() + interval() : Clock::time_point::max();
  const double seconds = std::chrono::duration<double>(Clock::now() - since_).count();
  if (terminal_)
    show_bar(seconds);
  else if (done_ >= 0)
    log().info("{} ... {:.0f} %, {}", stage_, 100 * done_, note(seconds));
  else
    log().info("{} ... {}", stage_, note(seconds));
}

void Console::show_bar(double seconds) {
  on_screen_ = true;
  const int filled = bar_width * std::max(shown_percent_, 0) / 100;
  std::string text = done_ < 0 ? fmt::format("{:<18} {}", stage_, note(seconds))
                               : fmt::format("{:<18} [{:#<{}}{:.<{}}] {:3d} % {}", stage_, "", filled, "",
                                             bar_width - filled, shown_percent_, note(seconds));
  if (text.size() > most_bar) text.resize(most_bar);
  fmt::print(stderr, "\r{}\033[K", text);
  std::fflush(stderr);
}

void Console::clear_line() {
  if (on_screen_) fmt::print(stderr, "\r\033[K");
  on_screen_ = false;
}

void Console::stage(const std::string& name, double done, const std::string& note,
                    const std::string& so_far) {
  if (quiet_) return;
  const std::lock_guard lock(mutex_);
  const bool is_new = name != stage_;
  if (is_new) {
    clear_line();
    stage_ = name;
    since_ = Clock::now();
    next_ = since_ + interval();
    left_ = {};
    repeats_ = true;
    if (!terminal_ && logs_starts_) log().info("{} ...{}", name, note.empty() ? "" : " " + note);
  }
  const int percent = done < 0 ? -1 : static_cast<int>(100 * std::min(done, 1.0));
  const bool changes = is_new || percent != shown_percent_ || note != note_ || so_far != so_far_;
  done_ = done;
  left_.update(std::chrono::duration<double>(Clock::now() - since_).count(), done);
  shown_percent_ = percent;
  note_ = note;
  so_far_ = so_far;
  if (terminal_ && changes) show();
}

void Console::stage_once(const std::string& name, const std::string& note) {
  stage(name, -1, note);
  const std::lock_guard lock(mutex_);
  repeats_ = false;
  if (!quiet_ && !terminal_ && !logs_starts_) show();
}

void Console::error(const std::string& message) {
  const std::lock_guard lock(mutex_);
  clear_line();
  log().error("error: {}", printable(message));
}

void Console::warning(const std::string& message) {
  if (quiet_) return;
  const std::lock_guard lock(mutex_);
  clear_line();
  log().warn("warning: {}", printable(message));
}

Progress Console::progress() {
  return [this](const std::string& name, double done, const std::string& so_far) {
    stage(name, done, {}, so_far);
  };
}

void open_report(const std::string& path) {
  std::string program = "xdg-open", file = path;
  char* words[] = {program.data(), file.data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, words[0], nullptr, nullptr, words, environ);
  if (error != 0) std::cerr << path << " cannot be shown: xdg-open: " << std::strerror(error) << "\n";
}

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
