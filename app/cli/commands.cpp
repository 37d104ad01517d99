#include "app/cli/commands.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <system_error>

#include "app/exports/exporters.hpp"
#include "app/files/bodies_section.hpp"
#include "app/files/cuts_section.hpp"
#include "app/files/drawing_section.hpp"
#include "app/files/lattice_section.hpp"
#include "app/goals/registry.hpp"
#include "app/io/atomic_file.hpp"
#include "app/pictures/drawing_picture.hpp"
#include "app/pictures/panel_picture.hpp"
#include "app/pipeline/closed_form.hpp"
#include "app/pipeline/drive_loads.hpp"
#include "app/pipeline/pipeline.hpp"
#include "app/print/fit.hpp"
#include "app/result/motion_evidence.hpp"
#include "app/result/result_json.hpp"
#include "app/result/state_json.hpp"
#include "app/result/summary.hpp"
#include "app/result/verdict.hpp"
#include "app/run/design_hinges.hpp"
#include "app/sweep/plan/sweep_plan.hpp"
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

namespace {

/// Draws pieces and bridges of a sheet with cuts, or only the lines of one that is refused.
std::string picture_of_cuts(const targets::Node& root, const targets::DrawnWalls& lines) {
  try {
    return cut_picture(*read_design(root).cuts);
  } catch (const InvalidInput&) {
    return drawing_picture(lines);
  }
}

/// Writes the picture of `check --picture`: the lines of a drawing, or the flat sheet of another file. Nothing is written
/// if a file without a drawing was refused.
void write_check_picture(const CommandOptions& options, const std::optional<Forecast>& forecast) {
  if (options.picture.empty()) return;
  if (const auto drawn = find_drawn_structure(document_of(options))) {
    const targets::DrawnWalls walls = examine_drawn_structure(*drawn);
    std::error_code missing;  // set if the picture does not exist yet
    if (std::filesystem::equivalent(options.picture, walls.file, missing))
      throw InvalidInput("--picture would replace the drawing. Give another file", {options.picture});
    if (!walls.fault && drawn->knows("cuts"))
      return write_file(options.picture, picture_of_cuts(document_of(options), walls));
    return write_file(options.picture, drawing_picture(walls));
  }
  if (!forecast)
    throw InvalidInput("--picture draws sheets, and this file has none. Remove the option", {options.file});
  const model::Linkage sheet = forecast->sheet;
  write_file(options.picture, panel_picture(sheet, rest_state(sheet), {}));
}

CheckedFile check_and_draw(const CommandOptions& options, const Progress& progress) {
  try {
    CheckedFile checked = check_file(options.file, options.changes, progress);
    write_check_picture(options, checked.forecast);
    return checked;
  } catch (const InvalidInput& fault) {
    try {
      write_check_picture(options, {});
    } catch (const InvalidInput&) {
      // The file cannot be drawn, and its fault is the answer.
    }
    throw InvalidInput(fault);
  }
}

}  // namespace

int check_command(const CommandOptions& options) {
  Console console(options.quiet);
  const CheckedFile checked = check_and_draw(options, console.progress());
  if (options.json)
    std::cout << checked.json().dump(1) << "\n";
  else
    print_on_stdout(options.verbose ? checked.text() : format_short(checked.short_form()));
  return done;
}

namespace {

std::optional<double> available_bytes() {
  std::ifstream file("/proc/meminfo");
  std::string key, unit;
  double kib = 0;
  while (file >> key >> kib && std::getline(file, unit))
    if (key == "MemAvailable:") return kib * 1024;
  return std::nullopt;
}

/// Returns the bytes that the limit of address space leaves, or infinity without a limit.
double left_of_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return std::numeric_limits<double>::infinity();
  double pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return std::max(static_cast<double>(limit.rlim_cur) - pages * static_cast<double>(sysconf(_SC_PAGESIZE)),
                  0.0);
}

/// Returns the memory that this process can still allocate, bytes. It is what the system has available, or what the
/// limit of the process (`ulimit -v`) leaves, if that is less. Empty if the system does not report it.
std::optional<double> free_memory() {
  const std::optional<double> available = available_bytes();
  if (!available) return std::nullopt;
  return std::min(*available, left_of_limit());
}

// Text after the folded size of a design, whose file has no goal. A search's report turns the fold to its goal.
constexpr const char* of_motion = " along x, y and z of the design's motion";

// Number of bodies up to which the collision-free range is computed within a second.
constexpr int max_bodies_for_contact = 4000;

// Measured on square sheets of 250 x 250 and 1000 x 1000 cells, after reading.
constexpr double check_seconds_per_body = 1e-5, check_bytes_per_body = 1.6e3;

std::string size_text(const Eigen::Vector3d& mm) {
  return fmt::format("{:.1f} x {:.1f} x {:.1f} mm", mm.x(), mm.y(), mm.z());
}

std::string line(const char* name, const std::string& text) {
  return fmt::format("  {:<10} {}\n", name, text);
}

double physics_of(const Forecast& f) { return f.has_physics ? physics_seconds(f.sheet) : 0; }

std::string time_text(const Forecast& f, const model::Linkage& linkage) {
  const double physics = physics_of(f);
  const double memory_mb = memory_needed(linkage) / 1e6;
  std::string parts;
  if (f.search_s + physics >= 1)
    parts = fmt::format(" (search {}, simulation {})", about(f.search_s),
                        f.has_physics ? about(physics) : "skipped: too large");
  return fmt::format("{}{}, {:.0f} MB of memory", about(f.search_s + physics), parts, memory_mb);
}

/// Formats a forecast. @param lies text on the axes of the folded size; empty for targets
std::string text_of(const Forecast& f, const char* lies) {
  const model::Linkage linkage = f.sheet;
  std::string out =
      line("sheet", fmt::format("{} bodies, {} hinges; flat {}, cells of {:.4g} mm, walls {:.3g} mm thick",
                                f.sheet.bodies(), f.sheet.hinges(), size_text(flat_size(linkage)),
                                f.sheet.size().edge_mm, f.sheet.size().thickness_mm));
  if (f.folded_mm) out += line("folded", "about " + size_text(*f.folded_mm) + lies);
  out += line("run time", time_text(f, linkage));
  for (const std::string& note : f.notes) out += line("note", note);
  return out;
}

nlohmann::ordered_json json_of(const Forecast& f) {
  const model::Linkage linkage = f.sheet;
  nlohmann::ordered_json out = {{"bodies", f.sheet.bodies()},
                                {"hinges", f.sheet.hinges()},
                                {"flat_mm", point_json(flat_size(linkage))},
                                {"folded_mm", nullptr},
                                {"search_s", f.search_s},
                                {"physics_s", physics_of(f)},
                                {"memory_bytes", memory_needed(linkage)},
                                {"notes", f.notes}};
  if (f.folded_mm) out["folded_mm"] = point_json(*f.folded_mm);
  return out;
}

std::optional<CheckedContact> contact_of(const Design& design) {
  const model::ExactMotion exact = exact_motion(design.structure);
  if (!exact || plan_model(design, Model::bullet) == Model::equilibrium) return std::nullopt;
  return CheckedContact{certify(design.structure, wall_error(design)), exact_theta_of(design, exact)};
}

/// Returns the size of the drawing that a design names; empty for other designs.
std::optional<CheckedDrawing> drawing_of(const targets::Node& root) {
  const auto drawn = find_drawn_structure(root);
  if (!drawn) return std::nullopt;
  const targets::DrawnWalls walls = examine_drawn_structure(*drawn);
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& vertex : walls.graph.vertices) box.extend(vertex);
  if (box.isEmpty())
    for (const targets::DrawnLine& line : walls.lines) box.extend(line.from).extend(line.to);
  return CheckedDrawing{box.sizes(), walls.unit};
}

/// Reports how long the check of a large sheet takes. @throws InvalidInput if it takes more memory than is free
void announce_check(const std::string& file, const model::Lattice& sheet, const Progress& progress) {
  const double seconds = check_seconds_per_body * sheet.bodies(),
               bytes = check_bytes_per_body * sheet.bodies();
  if (const auto free = free_memory(); free && !(bytes <= *free))
    throw InvalidInput(
        fmt::format("checking {} bodies needs about {:.0f} MB of memory, and {:.0f} MB are free. "
                    "Give fewer cells, or close other programs",
                    sheet.bodies(), bytes / 1e6, *free / 1e6),
        {file, 0, 0, "structure.cells"});
  if (seconds >= 1)
    progress(fmt::format("checking {} bodies, {}, {:.0f} MB of memory", sheet.bodies(), about(seconds),
                         bytes / 1e6),
             -1, {});
}

}  // namespace

std::string CheckedDrawing::text() const {
  return fmt::format("{:.4g} x {:.4g} mm; {}", size_mm.x(), size_mm.y(), unit);
}

std::string CheckedFile::text() const {
  std::string out = fmt::format("{}: valid {} '{}'\n", file, kind, name);
  if (drawing) out += line("drawing", drawing->text());
  if (!cuts.empty()) out += line("sheet", cuts);
  if (forecast) out += text_of(*forecast, kind == "design" ? of_motion : "");
  if (contact)
    for (const auto& [label, words] :
         certified_lines(contact->certified, forecast->sheet, contact->theta, ClosedFormRelation::same))
      out += line(label.c_str(), words);
  if (kind == "sweep") out += line("samples", fmt::format("{:.0f}", samples));
  return out;
}

ShortForm CheckedFile::short_form() const {
  ShortForm out{.title = fmt::format("{}: valid {} '{}'", file, kind, name)};
  if (forecast) {
    const model::Linkage linkage = forecast->sheet;
    const model::CellSize size = forecast->sheet.size();
    out.lines = {{"sheet", fmt::format("{} bodies, {} hinges; cells of {} mm, walls {} mm thick",
                                       forecast->sheet.bodies(), forecast->sheet.hinges(),
                                       format_figures(size.edge_mm), format_figures(size.thickness_mm))},
                 {"size", "flat " + size_text(flat_size(linkage))},
                 {"time", time_text(*forecast, linkage)}};
    if (forecast->folded_mm) out.lines[1][1] += "; folded about " + size_text(*forecast->folded_mm);
    for (const std::string& note : forecast->notes) out.problems.push_back({"warning", note});
  }
  if (drawing) out.lines.push_back({"drawing", drawing->text()});
  if (!cuts.empty()) out.lines.push_back({"sheet", cuts});
  if (contact)
    out.lines.push_back(
        certified_lines(contact->certified, forecast->sheet, contact->theta, ClosedFormRelation::same)
            .front());
  if (kind == "sweep") out.lines.push_back({"samples", fmt::format("{:.0f}", samples)});
  return out;
}

nlohmann::ordered_json CheckedFile::json() const {
  nlohmann::ordered_json out = {{"file", file}, {"kind", kind}, {"name", name}, {"valid", true}};
  if (forecast) out["expected"] = json_of(*forecast);
  if (drawing)
    out["drawing"] = {{"size_mm", {drawing->size_mm.x(), drawing->size_mm.y()}}, {"unit", drawing->unit}};
  if (!cuts.empty()) out["cuts"] = cuts;
  if (contact)
    out["certified"] =
        certified_json(contact->certified, forecast->sheet, contact->theta, ClosedFormRelation::same);
  if (kind == "sweep") out["samples"] = samples;
  return out;
}

CheckedFile check_file(const std::string& file, const targets::DocumentChanges& changes,
                       const Progress& progress) {
  const targets::Node root = targets::read_changed_document(file, max_design_bytes, changes);
  if (root.kind() != targets::Node::Kind::map)
    throw root.error("this is not a kinetix file. Write YAML keys, starting with `kinetix: 1`");
  if (root.optional("factors")) {
    const SweepPlan plan = make_sweep_plan(file, {}, changes);
    return {
        .file = file, .kind = "sweep", .name = plan.doe.name, .samples = static_cast<double>(plan.size())};
  }
  if (root.optional("target")) {
    const Target target = read_target(root);
    return {file, "target", target.goal->name, target.goal->forecast()};
  }
  const Design design = read_design(root);
  if (design.structure.assembly()) {
    CheckedFile out{.file = file, .kind = "design", .name = design.name, .drawing = drawing_of(root)};
    if (design.cuts) out.cuts = describe_cuts(*design.cuts, design.process.kerf_mm);
    return out;
  }
  announce_check(file, design.structure, progress);
  CheckedFile out{.file = file, .kind = "design", .name = design.name, .forecast = forecast_design(design)};
  out.drawing = drawing_of(root);
  if (design.structure.bodies() <= max_bodies_for_contact)
    out.contact = contact_of(design);
  else
    out.forecast->notes.push_back(
        fmt::format("the collision-free range is computed here for up to {} bodies. Run `simulate`, which "
                    "needs {} for it",
                    max_bodies_for_contact, about(contact_seconds(design.structure))));
  return out;
}

}  // namespace kinetix::app
