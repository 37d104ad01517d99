#include "app/cli/commands.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <atomic>
#include <filesystem>
#include <iostream>

#include "app/exports/exporters.hpp"
#include "app/goals/registry.hpp"
#include "app/io/atomic_file.hpp"
#include "app/pipeline/drive_loads.hpp"
#include "app/pipeline/pipeline.hpp"
#include "app/print/fit.hpp"
#include "app/result/result_json.hpp"
#include "app/result/summary.hpp"
#include "app/result/verdict.hpp"
#include "targets/document/edit_document.hpp"

namespace kinetix::app {
namespace {

/// Watch that asks a run to stop and keep the best so far, at the first Ctrl-C or when its time is up. A second Ctrl-C
/// ends the program as usual.
class Stopper {
 public:
  /// @param time_limit_s from now, s, > 0; empty: no limit
  explicit Stopper(std::optional<double> time_limit_s);
  ~Stopper();
  Stopper(const Stopper&) = delete;
  Stopper& operator=(const Stopper&) = delete;

  std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::mutex mutex_;
  std::condition_variable end_;
  bool ends_ = false;
  std::thread watch_;
};

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds poll_interval{20};  // ms: too short for users to notice

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may write it");
struct sigaction before;

extern "C" void note_interrupt(int signal_number) {
  interrupted = true;
  sigaction(signal_number, &before, nullptr);
}

void watch_for_interrupts() {
  interrupted = false;
  struct sigaction noting {};
  noting.sa_handler = note_interrupt;
  sigaction(SIGINT, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(SIGINT, &noting, nullptr);
}

Stopper::Stopper(std::optional<double> time_limit_s) {
  watch_for_interrupts();
  const Clock::time_point begin = Clock::now();
  watch_ = std::thread([this, begin, time_limit_s] {
    std::unique_lock lock(mutex_);
    while (!source_.stop_requested() && !end_.wait_for(lock, poll_interval, [this] { return ends_; })) {
      const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
      const bool late = time_limit_s && seconds >= *time_limit_s;
      if (interrupted || late) {
        std::cerr << (late ? "time limit reached" : "interrupted")
                  << ": stopping and saving the best result so far (Ctrl-C again quits without saving)\n";
        source_.request_stop();
      }
    }
  });
}

Stopper::~Stopper() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  end_.notify_one();
  watch_.join();
  if (before.sa_handler != SIG_IGN) sigaction(SIGINT, &before, nullptr);
}

bool would_replace(const std::string& input, const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code missing;  // set if the file does not exist yet: then it is not the input
  return fs::equivalent(input, fs::path(folder) / "design.yaml", missing) ||
         fs::equivalent(input, fs::path(folder) / "result.json", missing);
}

/// Chooses the folder for results, which must not replace their input. A file written by hand would lose its comments
/// and patterns, and a result its goal.
/// @param folder for design.yaml and result.json; need not exist.
/// @param is_given whether the user named the folder; then it does not change.
/// @return the folder, or NAME_2 next to it if the input is in it.
/// @throws InvalidInput if the user named the folder and one of these two files in it is the input
std::string folder_beside_input(const std::string& input, const std::string& folder, bool is_given) {
  if (!would_replace(input, folder)) return folder;
  if (is_given)
    throw InvalidInput("results in " + folder + " would replace this file. Give another folder: -o DIR",
                       {input});
  return folder + "_2";
}

RunOptions run_options(const CommandOptions& options, Console& console, const std::stop_token& stop) {
  return {.threads = options.threads,
          .seed = options.seed,
          .verify = options.verify,
          .progress = console.progress(),
          .prints = options.prints,
          .stop = stop,
          .fidelity = options.fidelity,
          .printable = answer_of_export,
          .printable_size = find_printable_size,
          .seeks_remedy = true};
}

using RunFunction = std::function<Run(const RunOptions&)>;

/// Runs a function and adds the file's name to bad input that is found after reading.
Run located(const std::string& file, const RunFunction& run, const RunOptions& options) {
  try {
    return run(options);
  } catch (const InvalidInput& e) {
    if (!e.place().file.empty()) throw;
    throw InvalidInput(e.reason(), {file, 0, 0, e.place().key});
  }
}

void print(const Run& run, const nlohmann::ordered_json& json, const std::string& folder,
           const CommandOptions& options) {
  if (options.json) {
    std::cout << json.dump(1) << "\n";
  } else if (options.verbose) {
    print_on_stdout(summary(run) + fmt::format("  {:<10} {}/{}\n", "written", folder,
                                               std::string("report.html, result.json, design.yaml") +
                                                   (run.closed_path ? ", parts" : "")));
  } else {
    ShortForm form = short_form(run);
    form.ends = last_parts(run, folder);
    print_on_stdout(format_short(form));
  }
}

/// Runs a function, writes its results and prints the summary. @param watch started before the file was read.
/// @param has_parts whether a stopped run has anything to keep
int run_and_write(const CommandOptions& options, const RunFunction& function, const std::string& name,
                  const std::string& suffix, Stopwatch watch, bool has_parts = true) {
  OutputFolder folder(
      folder_beside_input(options.file, options.folder_of(name, suffix), options.folder_given));
  const double load = watch.lap();
  Console console(options.quiet);
  std::optional<Stopper> stopper;
  if (has_parts || options.time_limit_s) stopper.emplace(options.time_limit_s);
  const std::stop_token stop = stopper ? stopper->token() : std::stop_token();
  Run run = located(options.file, function, run_options(options, console, stop));
  run.timings.load = load;
  console.progress()("files", -1);
  const WrittenResults written = write_results(run, folder.path());
  folder.keep();
  if (!written.kept_design.empty())
    console.warning(
        fmt::format("{0}/design.yaml was changed after a run wrote it. The changed file is kept as {0}/{1}",
                    folder.path(), written.kept_design));
  print(run, written.result, folder.path(), options);
  if (options.open) open_report(folder.path() + "/report.html");
  return exit_code(verdict_of(run));
}

/// Reads the file once, with the keys that options replace. A file that changes between two reads would be two designs.
targets::Node document_of(const CommandOptions& options) {
  return targets::read_changed_document(options.file, max_design_bytes, options.changes);
}

/// Applies --fold-angle-deg to imported bodies. It drives the hinge that the file names, or the hinge that turns most in
/// the first motion.
Design turned_to(Design design, const CommandOptions& options) {
  if (body_pull_of(design))
    throw InvalidInput("the drive pulls bodies, and --fold-angle-deg needs a hinge. Remove the option",
                       {options.file, 0, 0, "drive"});
  design.theta = options.theta_deg * radians_per_degree;
  if (const model::HingeTurn* turn = turn_of(design))
    design.drive = model::HingeTurn{turn->hinge, drive_of(design).to(design.theta).angle};
  return design;
}

/// Reads the design and applies --fold-angle-deg, if given. A sheet then folds without its `drive:`.
Design design_of(const CommandOptions& options, const targets::Node& root) {
  Design design = read_design(root);
  if (!options.theta_given) return design;
  if (design.structure.assembly()) return turned_to(std::move(design), options);
  if (design.drive && !options.drives)
    Console(options.quiet)
        .warning("--fold-angle-deg replaces `drive:`. The sheet folds like a design without a drive");
  design.theta = options.theta_deg * radians_per_degree;
  design.drive.reset();
  return design;
}

DriveTrials located_trials(const CommandOptions& options, const Design& design) {
  Console console(options.quiet);
  const Stopper stopper(options.time_limit_s);
  try {
    return try_drives(design, run_options(options, console, stopper.token()));
  } catch (const InvalidInput& e) {
    throw InvalidInput(e.reason(), {options.file, 0, 0, e.place().key});
  }
}

int compare_drives(const CommandOptions& options) {
  if (options.model != "equilibrium")
    throw InvalidInput("--drives compares forces of elastic hinges. Add --model equilibrium");
  if (options.open) throw InvalidInput("--open: --drives writes no report. Remove one of the two options");
  const targets::Node root = document_of(options);
  const Design design = design_of(options, root);
  if (design.structure.assembly())
    throw InvalidInput("--drives only applies to sheets, and this is a design of bodies. Remove the option",
                       {options.file});
  std::optional<OutputFolder> folder;
  if (options.folder_given) folder.emplace(options.folder);
  const DriveTrials trials = located_trials(options, design);
  if (trials.stopped && trials.trials.empty()) throw Interrupted("stopped before a drive was through");
  const std::string json = drive_trials_json(trials).dump(1) + "\n";
  if (folder) {
    write_file(folder->path() + "/drives.json", json);
    folder->keep();
  }
  if (options.json)
    std::cout << json;
  else
    print_on_stdout(options.verbose ? summary(trials) : format_short(short_form(trials)));
  return trials.least_force < 0 ? target_missed : done;
}

/// Runs a design. @throws Interrupted for a simulation that was stopped before it settled
Run settled_run(const Design& design, Model model, const RunOptions& options) {
  Run run = run_design(design, model, options);
  if (model == Model::bullet && run.stopped && !run.verification)
    throw Interrupted("the simulation was stopped before it settled");
  return run;
}

int run_design_command(const CommandOptions& options, Model model, const std::string& suffix) {
  Stopwatch watch;
  const targets::Node root = document_of(options);
  const Design design = design_of(options, root);
  // A closed form has no partial result: Ctrl-C ends the program at once. Imported bodies move step by step.
  const bool has_parts = model != Model::exact || design.structure.assembly();
  return run_and_write(
      options, [&](const RunOptions& of) { return settled_run(design, model, of); }, design.name, suffix,
      watch, has_parts);
}

}  // namespace

int optimise_command(const CommandOptions& options) {
  Stopwatch watch;
  const Target target = read_target(document_of(options));
  return run_and_write(
      options, [&](const RunOptions& of) { return run_goal(*target.goal, of); }, target.goal->name, "",
      watch);
}

int verify_command(const CommandOptions& options) {
  return run_design_command(options, Model::bullet, "_verified");
}

int simulate_command(const CommandOptions& options) {
  if (options.drives) return compare_drives(options);
  const Model model = options.model == "bullet"        ? Model::bullet
                      : options.model == "equilibrium" ? Model::equilibrium
                                                       : Model::exact;
  return run_design_command(options, model, "_" + options.model);
}

}  // namespace kinetix::app
