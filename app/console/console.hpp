#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <latch>
#include <mutex>
#include <optional>
#include <streambuf>
#include <string>
#include <string_view>
#include <thread>

#include "app/console/time_left.hpp"
#include "app/run/run_options.hpp"

namespace kinetix::app {

/// Progress on stderr: a bar where stderr is a terminal, lines where it is not, nothing when quiet. A stage that takes
/// longer than a second says so every second: how long it has been going on, and how much of it is done and left where
/// that is known. Calls may come from any thread.
class Console {
 public:
  /// @param says_starts a line for each stage as it begins, where stderr is no terminal; else a stage that is over within
  /// a second says nothing, so that a refusal stands alone
  explicit Console(bool quiet, bool says_starts = true);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  /// @param done share of the stage, 0 to 1 (negative: not known)
  /// @param note stands at the end, in the place of the time left   @param so_far in words, before the time
  void stage(const std::string& name, double done, const std::string& note = {},
             const std::string& so_far = {});
  void error(const std::string& message);
  void warning(const std::string& message);  ///< nothing where quiet
  Progress progress();

 private:
  using Clock = std::chrono::steady_clock;

  void beat();
  void show();
  void show_bar(double seconds);
  std::string note(double seconds);
  void clear_line();

  const bool quiet_, terminal_, says_starts_;
  std::mutex mutex_;  ///< of all below
  std::condition_variable end_;
  bool ends_ = false;
  bool on_screen_ = false;  ///< a bar
  int shown_percent_ = -1;
  double done_ = -1;
  TimeLeft left_;                   ///< of the stage
  Clock::time_point since_, next_;  ///< the stage began; its next word is due
  std::string stage_, note_, so_far_;
  std::latch awake_{1};  ///< the heart's thread has begun: beginnings take memory, too
  std::thread heart_;
};

/// Shows a file in the user's browser, by xdg-open, and does not wait for it. Says on stderr where there is none.
void open_report(const std::string& path);

/// Exit codes of formats.md.
enum ExitCode {
  done = 0,
  internal_error = 1,
  bad_input = 2,
  target_missed = 3,
  physics_disagrees = 4,
  interrupted_early = 130
};

/// What every command takes.
struct CommandOptions {
  std::string file;
  std::string
      folder;  ///< empty: results/<name>, with _verified, _exact, _equilibrium or _bullet for a design
  bool folder_given = false;
  bool json = false;
  bool quiet = false;
  bool verify = true;
  bool fidelity = false;               ///< of a target and verify: physics runs of coarser steps too
  std::optional<double> time_limit_s;  ///< of a target and simulate: the best so far is kept
  bool open = false;                   ///< shows the report when it is written
  int prints = 0;                      ///< of a target: to confirm what prints come to
  int threads = 0;
  std::uint64_t seed = 0;
  bool seed_given = false;
  std::string model = "exact";  ///< of simulate: exact, equilibrium or bullet
  double theta_deg = 0;         ///< of simulate, deg
  bool theta_given = false;
  bool drives = false;  ///< of simulate: tries drives instead of the design's own
  bool resume = false;  ///< of sweep

  /// Where results go. @param suffix keeps those of one command from replacing another's
  std::string folder_of(const std::string& name, const std::string& suffix = "") const {
    return folder_given ? folder : "results/" + name + suffix;
  }
};

/// A text without anything that changes how a terminal works or in which order it shows letters: control characters but tab and
/// line end as \uXXXX, as JSON has them, and bytes that are not UTF-8 as \xXX. File names may hold them.
std::string printable(std::string_view text);

/// Makes a text printable on one line: line ends become \n as well.
std::string printable_line(std::string_view text);

/// Makes what std::cout and std::cerr print printable while it lives.
class PrintableStreams {
 public:
  PrintableStreams();
  ~PrintableStreams();
  PrintableStreams(const PrintableStreams&) = delete;
  PrintableStreams& operator=(const PrintableStreams&) = delete;

 private:
  class Buffer : public std::streambuf {
   public:
    explicit Buffer(std::streambuf* to) : to_(to) {}
    std::streambuf* to() const { return to_; }

   protected:
    std::streamsize xsputn(const char* text, std::streamsize count) override;
    int_type overflow(int_type c) override;
    int sync() override { return to_->pubsync(); }

   private:
    std::streambuf* to_;
  };

  Buffer out_, error_;
};

}  // namespace kinetix::app
