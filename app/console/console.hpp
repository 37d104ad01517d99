#pragma once

#include <condition_variable>
#include <latch>
#include <limits>
#include <streambuf>
#include <string_view>
#include <thread>

#include "app/run/run_options.hpp"
#include "targets/document/edit_document.hpp"

namespace kinetix::app {

/// Time left of a stage, extrapolated from the part that is done. The displayed time never increases. If the stage
/// slows down, the time stays the same or gives way to words.
class TimeLeft {
 public:
  /// Updates the estimate. @param seconds since the stage began   @param done share of it, 0 to 1; negative: unknown
  void update(double seconds, double done);
  /// Returns the time left, s. Empty if too little is done for an estimate, or if it takes longer than displayed.
  std::optional<double> at(double seconds);
  /// Returns "about 41 s left", "still working, longer than estimated", or an empty text.
  std::string text(double seconds);

 private:
  bool is_known() const { return total_ < std::numeric_limits<double>::infinity(); }

  double began_ = -1, before_ = 0;                          ///< s and share at the first update
  double done_ = -1;                                        ///< the latest share
  double total_ = std::numeric_limits<double>::infinity();  ///< s, whole stage, extrapolated from that share
  double displayed_s_ = std::numeric_limits<double>::infinity();  ///< s left: the least displayed so far
};

/// Formats a duration: "2.3 s", "41 s", "4 min 10 s", "3 h 20 min".
std::string duration_text(double seconds);

/// Progress on stderr: on a terminal one line of at most 79 columns, updated every second. Otherwise a line every ten
/// seconds, and nothing when quiet. A report has the time of the stage so far, and its share done and time left if
/// known. Calls may come from any thread.
class Console {
 public:
  /// @param logs_starts prints a line at the start of each stage if stderr is not a terminal. Otherwise a short stage
  /// prints nothing, so that an error message is the only output
  /// @param between_lines ms between lines of a stage if stderr is not a terminal
  explicit Console(bool quiet, bool logs_starts = true,
                   std::chrono::milliseconds between_lines = std::chrono::seconds(10));
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  /// Reports a stage. @param done share of the stage, 0 to 1; negative: unknown
  /// @param note at the end, instead of the time left   @param so_far in words, before the time
  void stage(const std::string& name, double done, const std::string& note = {},
             const std::string& so_far = {});
  /// Reports a stage of which nothing will be known until it ends. Without a terminal it is one line.
  void stage_once(const std::string& name, const std::string& note);
  void error(const std::string& message);    ///< adds the word `error:`
  void warning(const std::string& message);  ///< adds the word `warning:`; nothing when quiet
  Progress progress();

 private:
  using Clock = std::chrono::steady_clock;

  void heartbeat();
  void show();
  void show_bar(double seconds);
  Clock::duration interval() const;
  std::string note(double seconds);
  void clear_line();

  const bool quiet_, terminal_, logs_starts_;
  const std::chrono::milliseconds between_lines_;
  std::mutex mutex_;  ///< guards all members below
  std::condition_variable end_;
  bool ends_ = false;
  bool repeats_ = true;     ///< whether the stage is reported every second
  bool on_screen_ = false;  ///< whether a bar is shown
  int shown_percent_ = -1;
  double done_ = -1;
  TimeLeft left_;
  Clock::time_point since_, next_;  ///< start of the stage; time of the next report
  std::string stage_, note_, so_far_;
  std::latch awake_{1};  ///< open once the heartbeat runs: starting a thread takes memory, too
  std::thread heartbeat_;
};

/// Opens a file in the user's browser by xdg-open, without waiting. Reports a missing xdg-open on stderr.
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

/// Options of all commands.
struct CommandOptions {
  std::string file;
  std::string
      folder;  ///< empty: results/<name>, with _verified, _exact, _equilibrium or _bullet for a design
  bool folder_given = false;
  /// Keys of the file that options replace, and their values in YAML.
  targets::DocumentChanges changes = {};
  bool json = false;
  bool quiet = false;
  bool verbose = false;  ///< prints the long form of the summary
  bool verify = true;
  bool fidelity = false;               ///< of a target and verify: also simulations with coarser steps
  std::optional<double> time_limit_s;  ///< s, of a target and simulate: the best so far is kept
  bool open = false;                   ///< shows the report when it is written
  int prints = 0;  ///< of a target: number of prints with errors that confirm the print tolerance
  int threads = 0;
  std::uint64_t seed = 0;
  bool seed_given = false;
  std::string model = "exact";  ///< of simulate: exact, equilibrium or bullet
  double theta_deg = 0;         ///< of simulate, deg
  bool theta_given = false;
  bool drives = false;  ///< of simulate: compares several drives instead of using the design's
  bool resume = false;  ///< of sweep
  std::string picture;  ///< of check: SVG file of what was understood; empty: none

  /// Returns the folder for results. @param suffix keeps results of one command from replacing another's
  std::string folder_of(const std::string& name, const std::string& suffix = "") const {
    return folder_given ? folder : "results/" + name + suffix;
  }
};

/// Returns a text without anything that changes a terminal or the order in which it shows letters. Control characters
/// except tab and line end become \uXXXX, as in JSON. Bytes that are not UTF-8 become \xXX. File names may hold both.
std::string printable(std::string_view text);

/// Makes a text printable on one line: line ends become \n as well.
std::string printable_line(std::string_view text);

/// Filter that makes the output of std::cout and std::cerr printable while it lives.
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
