#include "app/console/console.hpp"

#include <pthread.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <new>

#include "app/console/duration_text.hpp"
#include "app/console/printable_text.hpp"

namespace kinetix::app {
namespace {

constexpr int bar_width = 30;  // characters: leaves room for stage and note on a line of 80
constexpr std::chrono::milliseconds interval{1000};  // after which silence makes people wonder
constexpr auto pulse = interval / 4;                 // ms, between looks: notes come little late
static_assert(pulse.count() > 0, "a heart that does not wait takes a core for itself");

/// Held while a heart writes, and while this process forks: a child inherits every lock of the memory allocator and of
/// the stream as it stood, and the thread that would have opened it is not in the child.
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

}  // namespace

Console::Console(bool quiet, bool says_starts)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1), says_starts_(says_starts) {
  forks();
  if (quiet_) return;
  heart_ = std::thread([this] {
    awake_.count_down();
    beat();
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
  if (heart_.joinable()) heart_.join();
}

void Console::beat() {
  std::unique_lock lock(mutex_);
  while (!end_.wait_for(lock, pulse, [this] { return ends_; }))
    if (!stage_.empty() && Clock::now() >= next_) {
      const std::lock_guard alone(forks());
      try {
        show();
      } catch (const std::bad_alloc&) {
        stage_.clear();  // a run without memory for a note says so itself
      }
    }
}

std::string Console::note(double seconds) {
  if (!note_.empty()) return note_;
  const std::string text = (so_far_.empty() ? "" : so_far_ + ", ") + duration_text(seconds),
                    left = done_ < 0 ? "" : left_.words(seconds);
  return left.empty() ? text : text + ", " + left;
}

void Console::show() {
  next_ = Clock::now() + interval;
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
  if (done_ < 0) {
    fmt::print(stderr, "\r{:<18} {}\033[K", stage_, note(seconds));
  } else {
    const int filled = bar_width * shown_percent_ / 100;
    fmt::print(stderr, "\r{:<18} [{:#<{}}{:.<{}}] {:3d} % {}\033[K", stage_, "", filled, "",
               bar_width - filled, shown_percent_, note(seconds));
  }
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
    next_ = since_ + interval;
    left_ = {};
    if (!terminal_ && says_starts_) log().info("{} ...", name);
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

void Console::error(const std::string& message) {
  const std::lock_guard lock(mutex_);
  clear_line();
  log().error("{}", printable(message));
}

void Console::warning(const std::string& message) {
  if (quiet_) return;
  const std::lock_guard lock(mutex_);
  clear_line();
  log().warn("{}", printable(message));
}

Progress Console::progress() {
  return [this](const std::string& name, double done, const std::string& so_far) {
    stage(name, done, {}, so_far);
  };
}

}  // namespace kinetix::app
