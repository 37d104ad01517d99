#include <fmt/format.h>
#include <glog/logging.h>
#include <malloc.h>
#include <sys/mman.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <iostream>
#include <new>

#include "app/cli/commands.hpp"
#include "app/cli/error_report.hpp"
#include "app/console/console.hpp"
#include "app/files/design_file.hpp"
#include "app/imports/import_command.hpp"
#include "app/io/atomic_file.hpp"
#include "app/print/export_command.hpp"
#include "app/print/fit.hpp"
#include "app/run/run_options.hpp"
#include "app/studio/view_command.hpp"
#include "app/sweep/sweep_command.hpp"
#include "app/version.hpp"
#include "model/base/invalid_input.hpp"

namespace {

using kinetix::app::CommandOptions;

/// Returns a check that a number is in a range. CLI::Range accepts text that is not a number.
CLI::Validator within(double least, double most) {
  const auto problem = [=](std::string& text) {
    double value = NAN;
    const bool is_number = CLI::detail::lexical_cast(text, value);
    return is_number && value >= least && value <= most
               ? std::string()
               : fmt::format("{} is not a number from {:g} to {:g}", text, least, most);
  };
  return {problem, fmt::format("FLOAT in [{:g} - {:g}]", least, most)};
}

/// Formats a usage error as one line, like all errors.
std::string usage_error(const CLI::App*, const CLI::Error& e) {
  return fmt::format("{} (see --help)\n", e.what());
}

void add_common(CLI::App& app, CommandOptions& options) {
  app.add_flag("--json", options.json, "print the whole result as one JSON document on stdout");
  app.add_flag("--quiet", options.quiet, "no progress on stderr");
  app.add_option("--threads", options.threads,
                 "threads to work with; 0 = all cores; the answer does not depend on it")
      ->check(CLI::Range(0, 1024));
  app.add_option_function<std::uint64_t>(
         "--seed",
         [&options](const std::uint64_t& seed) {
           options.seed = seed;
           options.seed_given = true;
         },
         "seed of the random starts or samples, at most 9e15; same seed, same answer")
      ->check(CLI::Range(0.0, 9e15).description(""))
      ->type_name("UINT");
}

void add_output(CLI::App& app, CommandOptions& options, const std::string& what) {
  app.add_option_function<std::string>(
         "-o",
         [&options](const std::string& folder) {
           options.folder = folder;
           options.folder_given = true;
         },
         what)
      ->type_name("DIR");
}

void add_open(CLI::App& app, CommandOptions& options) {
  app.add_flag("--open", options.open, "shows the report in the browser");
}

void add_time_limit(CLI::App& app, CommandOptions& options, const std::string& kept) {
  app.add_option("--time-limit", options.time_limit_s,
                 "stops then and keeps " + kept + ", as the first Ctrl-C does")
      ->type_name("SECONDS")
      ->check(within(1e-3, 1e9));
}

constexpr const char* results_folder =
    "folder for result.json, design.yaml and report.html (default results/NAME, with _verified, _exact, "
    "_equilibrium or _bullet for a design, and _2 where that is the design's own)";

void add_file(CLI::App& app, CommandOptions& options, const std::string& name, const std::string& what) {
  app.add_option(name, options.file, what)->required()->type_name("");
}

/// Adds the options that replace keys of the file: how the sheet is made.
void add_choices(CLI::App& app, CommandOptions& options) {
  const auto add = [&](const char* name, const char* key, std::string form, const char* what) {
    return app.add_option_function<std::string>(
        name,
        [&options, key, form = std::move(form)](const std::string& value) {
          options.changes.emplace_back(key, fmt::format(fmt::runtime(form), value));
        },
        what);
  };
  std::vector<std::string> processes;
  for (const kinetix::model::Process& process : kinetix::model::processes())
    processes.push_back(process.name);
  add("--process", "process", "{}", "polyjet, fdm, sla, sls or laser, in place of the file's process")
      ->type_name("NAME")
      ->check(CLI::IsMember(processes));
  add("--hinge", "hinge", "{{kind: {}}}",
      "pin, block, film or rod, in place of the file's hinges; sizes follow from the process")
      ->type_name("KIND")
      ->check(CLI::IsMember({"pin", "block", "film", "rod"}));
  add("--bed", "bed_mm", "[{}]", "bed of your printer, mm: a larger sheet is cut into tiles")
      ->type_name("X,Y");
  add("--lock", "lock", "{}", "clip, strap or none: what keeps the sheet folded")
      ->type_name("KIND")
      ->check(CLI::IsMember({"clip", "strap", "none"}));
}

void add_export(CLI::App& app, CommandOptions& options, kinetix::app::PrintRequest& request) {
  app.add_option("DESIGN.yaml|DIR", request.source, "a design, or the folder of a result")->type_name("");
  add_common(app, options);
  add_output(app, options, "folder for the files (default results/NAME_print)");
  app.add_option("--format", request.formats,
                 kinetix::app::format_help() + "; default with --coupon: 3mf, of laser dxf,svg")
      ->delimiter(',')
      ->allow_extra_args(false)  // the design may stand behind it
      ->type_name("NAME");
  app.add_option("--process", request.process,
                 "polyjet, fdm, sla, sls or laser: what it can make is checked (default: the design's)")
      ->type_name("NAME");
  app.add_option("--hinge", request.hinge,
                 "pin, block, film or rod (wire pushed in), where the design leaves hinges open or computes "
                 "them as joints "
                 "(default: those of "
                 "the design, else the first kind of the process that fits)")
      ->type_name("KIND");
  app.add_option(
         "--clearance", request.clearance_mm,
         "of pins, a side: the least gap of your printer's coupon that turns, instead of the process's")
      ->type_name("MM")
      ->check(within(0.01, 10.0));
  app.add_option("--cell-mm", request.cell_mm,
                 "makes the sheet with cells of this edge instead of its own; walls stay as thick and high, "
                 "but for what the process needs")
      ->type_name("MM")
      ->check(within(0.1, 1e4));
  app.add_option("--bed", request.bed_mm,
                 "the printer's bed: a larger sheet is cut into tiles that join by hinges")
      ->expected(2)
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("X,Y")
      ->check(within(1.0, 1e5));
  app.add_option("--lock", request.lock,
                 "clip, strap or none: what keeps the sheet folded (default: the design's)")
      ->type_name("KIND");
  app.add_flag("--loose-rods", request.loose_rods, "rods of pins as parts of their own, to be pushed in");
  app.add_flag("--caps", request.caps,
               "knuckles of pins as round caps that all look alike, wherever their axes are in them");
  app.add_option("--orient", request.orient,
                 "of stl, 3mf and step: flat (default), over, on the other side, or best: whichever has the "
                 "least overhang")
      ->type_name("WAY");
  app.add_option("--slicer", request.slicer,
                 "prusa, orca, bambu or cura, that 3mf is for (default: one file for all of them)")
      ->type_name("NAME");
  app.add_flag("--slice", request.slice, "asks PrusaSlicer how long fdm or sla takes, and for the material");
  app.add_flag("--coupon", request.coupon,
               "instead of a design, pins with gaps of 0.1 to 0.6 mm: prints tell which ones turn; of laser "
               "bridges 0.4 to 1.6 mm wide: the narrowest that stays is your cutter's");
  app.add_option_function<std::string>(
         "--state", [&request](const std::string& state) { request.folded = state == "folded"; },
         "flat (default), as it is printed, or folded")
      ->check(CLI::IsMember({"flat", "folded"}));
}

void add_import(CLI::App& app, CommandOptions& options, kinetix::app::ImportRequest& request) {
  app.add_option("MODEL", request.model,
                 "a 3MF, STEP, GLB, OBJ, PLY or STL file with hard and soft parts; or a folder of tiles with "
                 "vertices.txt and "
                 "constraints.txt")
      ->type_name("");
  add_common(app, options);
  add_output(app, options, "folder for design.yaml and its part files (default results/NAME)");
  app.add_option("--hard", request.hard, "instead of MODEL, a file of the hard parts")->type_name("FILE");
  app.add_option("--soft", request.soft, "beside --hard, a file of the soft parts")->type_name("FILE");
  app.add_option("--unit", request.unit,
                 "of the model's numbers: mm, cm, m, in or ft (default: as the file says, else guessed)")
      ->type_name("UNIT");
  app.add_option(
         "--soft-material", request.soft_material,
         "name of the material, colour or part that is soft (default: by words such as soft, tpu, tango)")
      ->type_name("NAME");
  app.add_option(
         "--material", request.material,
         "of the soft parts, for their stiffness: tango (default), tpu95a, pp, pa12, acrylic or steel")
      ->type_name("NAME");
  app.add_option("--hinges", request.hinges, "YAML file with the axes of hinges that the shape leaves open")
      ->type_name("FILE");
  app.add_option("--tile-mm", request.tile_mm, "of tiles: their median edge, mm (default 20)")
      ->type_name("MM");
  app.add_option("--thickness-mm", request.thickness_mm,
                 "of tiles: of their sheet, mm (default a twentieth of the median edge)")
      ->type_name("MM");
  app.add_option("--kerf-mm", request.kerf_mm,
                 "of tiles: width of the cuts, mm (default 0.03 of the median edge)")
      ->type_name("MM");
}

void add_view(CLI::App& app, CommandOptions& options, kinetix::app::ViewRequest& request) {
  app.add_option("DIR|DESIGN.yaml|TARGET.yaml", request.source,
                 "the folder of a result, a design, or a target to search for; nothing: a template")
      ->type_name("");
  add_common(app, options);
  add_choices(app, options);
  app.add_flag_callback(
      "--no-open", [&request] { request.opens_browser = false; }, "prints the address and opens no browser");
  app.add_option("--port", request.port, "of 127.0.0.1; 0 (default): any that is free")
      ->type_name("PORT")
      ->check(CLI::Range(0, 65535));
}

// Text at the end of --help.
constexpr const char* footer = R"(
examples:
  kinetix-opt targets/shapes/helmet_rib.yaml -o out       search, verify, write out/report.html
  kinetix-opt simulate out/design.yaml --theta-deg 20     the same design, half folded
  kinetix-opt simulate panel.yaml --model equilibrium     elastic hinges: force, energy, snaps, contact
  kinetix-opt simulate panel.yaml --model equilibrium --drives   where to push with least force
  kinetix-opt verify out/design.yaml                      the physics run alone
  kinetix-opt export out --format 3mf --process fdm       files for the printer
  kinetix-opt import model.3mf -o out                     a 3D model with hard and soft parts as a design
  kinetix-opt view out                                    the studio, in the browser

exit codes:
  0 done   1 internal error   2 bad input   3 target missed or not reached
  4 physics run disagrees or failed   130 Ctrl-C before there was anything to keep

documentation: share/doc/kinetix/html/index.html, or build/site/index.html after make site)";

/// Sets the default format of a coupon: a 3MF file has the settings that keep the coupon's gaps open, and cutters read
/// drawings.
void choose_format(kinetix::app::PrintRequest& request) {
  if (!request.formats.empty()) return;
  if (!request.coupon) throw kinetix::InvalidInput("--format is required, e.g. --format 3mf (see --help)");
  const kinetix::model::Process* process = kinetix::model::find_process(request.process);
  if (process && process->cuts_sheets())
    request.formats = {"dxf", "svg"};
  else
    request.formats = {"3mf"};
}

/// Rejects options given before a command that does not have them: `--no-verify verify` would verify nothing.
void refuse_options_before(const CLI::App& app, const CLI::App& command) {
  for (const CLI::Option* option : app.get_options([](const CLI::Option* o) { return o->count() > 0; })) {
    if (command.get_option_no_throw(option->get_name())) continue;
    const std::string given = option->get_positional() ? option->results().front() : option->get_name();
    throw kinetix::InvalidInput(
        fmt::format("{} is for a search and not for {} (see --help)", given, command.get_name()));
  }
}

/// Looks for --json, also in a command line that cannot be parsed.
bool requests_json(int argc, char** argv) {
  return std::any_of(argv + 1, argv + argc,
                     [](const char* word) { return std::string_view(word) == "--json"; });
}

int run(int argc, char** argv) {
  CommandOptions options;
  CLI::App app(
      "Finds the hinge tilts of a flat KinetiX sheet that folds into a goal shape, and checks them by "
      "physics.",
      "kinetix-opt");
  app.set_version_flag("--version", std::string("kinetix-opt ") + kinetix::app::version);
  app.footer(footer);
  app.require_subcommand(0, 1);
  app.get_formatter()->column_width(34);

  add_common(app, options);
  add_output(app, options, results_folder);
  add_open(app, options);
  add_choices(app, options);
  app.add_flag_callback(
      "--no-verify", [&] { options.verify = false; }, "skip the physics run");
  add_time_limit(app, options, "the best so far");
  app.add_flag("--fidelity", options.fidelity,
               "physics runs of coarser steps too, for the report's table of speed against error");
  app.add_option("--monte-carlo", options.prints,
                 "brings so many prints with errors to their equilibrium, to confirm")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000));
  app.add_option("TARGET.yaml", options.file, "goal shape, structure and bounds")->type_name("");

  CLI::App* verify =
      app.add_subcommand("verify", "run the physics engine on a design and compare it with the model");
  CLI::App* simulate = app.add_subcommand("simulate", "compute one folded state of a design");
  CLI::App* sweep = app.add_subcommand("sweep", "run a design of experiments; also under mpirun");
  CLI::App* check = app.add_subcommand("check", "validate a target, a design or a sweep; writes nothing");
  for (CLI::App* command : {verify, simulate, check}) {
    add_file(*command, options, command == check ? "FILE.yaml|DIR" : "DESIGN.yaml|DIR",
             command == check ? "the file to read, or the folder of a result"
                              : "a design, or the folder of a result");
    add_common(*command, options);
    add_choices(*command, options);
    if (command == check) continue;
    add_output(*command, options, results_folder);
    add_open(*command, options);
    if (command == verify)
      command->add_flag("--fidelity", options.fidelity, "runs of coarser steps too, for speed against error");
  }
  add_file(*sweep, options, "DOE.yaml", "the sweep: base, factors, method, responses");
  add_common(*sweep, options);
  add_choices(*sweep, options);
  add_output(*sweep, options, "folder for the table and report.html (default results/NAME)");
  add_open(*sweep, options);
  std::string share;
  sweep->add_flag("--resume", options.resume, "continue the sweep whose table is in DIR");
  sweep
      ->add_option(
          "--share", share,
          "computes the K-th of N equal parts alone, into DIR/share-K-of-N; a run without it takes over "
          "what the shares have, computes the rest and writes the table")
      ->type_name("K/N");
  simulate
      ->add_option("--model", options.model,
                   "exact: closed form; equilibrium: elastic hinges; bullet: physics run")
      ->check(CLI::IsMember({"exact", "equilibrium", "bullet"}));
  add_time_limit(*simulate, options, "the path so far, or of --drives those that it came to");
  CLI::Option* theta = simulate
                           ->add_option("--theta-deg", options.theta_deg,
                                        "fold angle instead of the design's own, and of its drive")
                           ->check(within(-89.0, 89.0));
  simulate->add_flag(
      "--drives", options.drives,
      "tries plates, single hinges and cords to the same theta with --model equilibrium, and says which "
      "needs the least force; writes nothing but drives.json into -o DIR");

  CLI::App* print = app.add_subcommand("export", "write a design for printers, CAD and simulators");
  kinetix::app::PrintRequest request;
  add_export(*print, options, request);

  CLI::App* import = app.add_subcommand(
      "import", "turn a 3D model with hard and soft parts into a design of bodies and hinges");
  kinetix::app::ImportRequest imported;
  add_import(*import, options, imported);

  CLI::App* view =
      app.add_subcommand("view", "open the studio in the browser: press, drag, change, search, export");
  kinetix::app::ViewRequest shown;
  add_view(*view, options, shown);

  app.failure_message(usage_error);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (app.exit(e) == 0) return kinetix::app::done;
    if (requests_json(argc, argv)) kinetix::app::print_error(e.what(), kinetix::app::bad_input);
    return kinetix::app::bad_input;
  }
  for (const CLI::App* command : app.get_subcommands()) refuse_options_before(app, *command);
  options.theta_given = theta->count() > 0;
  if (verify->parsed() || simulate->parsed() || check->parsed())
    options.file = kinetix::app::design_at(options.file);
  if (verify->parsed()) return kinetix::app::verify_command(options);
  if (simulate->parsed()) return kinetix::app::simulate_command(options);
  if (sweep->parsed()) return kinetix::app::sweep_command(options, share);
  if (print->parsed()) {
    choose_format(request);
    return kinetix::app::export_command(options, request);
  }
  if (import->parsed()) return kinetix::app::import_command(options, imported);
  if (view->parsed()) return kinetix::app::view_command(options, shown);
  if (check->parsed()) return kinetix::app::check_command(options);
  if (options.file.empty()) {
    std::cerr << app.help();
    return kinetix::app::bad_input;
  }
  return kinetix::app::optimise_command(options);
}

/// Keeps freed memory in the process. Memory that is returned and allocated again comes as fresh pages. These cost a
/// search more time than its computations on them.
void keep_memory() {
  constexpr int kept = 64 << 20;  // bytes of free memory at the end of a heap
  constexpr int own = 16 << 20;   // bytes: larger blocks get separate pages
  mallopt(M_TRIM_THRESHOLD, kept);
  mallopt(M_MMAP_THRESHOLD, own);
}

constexpr std::size_t stack_bytes = 1 << 20;  // bytes: four times the largest stack of any observed run

[[gnu::noinline]] void grow_stack() {
  char stack[stack_bytes];
  volatile char* const deepest = stack;
  *deepest = 0;
}

/// Grows the stack of this thread while memory is left: a stack that cannot grow later is a crash, not an exception.
void keep_stack() {
  void* const room = mmap(nullptr, 2 * stack_bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) throw std::bad_alloc();
  munmap(room, 2 * stack_bytes);
  grow_stack();
}

/// Ends the program without the destructors of global objects, which other threads may still use. Libraries also call
/// exit: OpenMP does so if it cannot start a thread.
void exit_immediately(int code, void*) {
  kinetix::app::remove_unfinished();
  std::_Exit(code);
}

}  // namespace

int main(int argc, char** argv) {
  std::set_terminate(kinetix::app::terminate_with_message);
  on_exit(exit_immediately, nullptr);
  const bool as_json = requests_json(argc, argv);
  const kinetix::app::PrintableStreams printable;
  try {
    keep_stack();
    keep_memory();
    FLAGS_minloglevel = google::GLOG_FATAL;  // Ceres logs points without a value, which searches handle
    kinetix::app::remove_parts_when_interrupted();
    const int code = run(argc, argv);
    std::cout.flush();
    if (std::cout) return code;
    std::cerr << "standard output cannot be written\n";
    return kinetix::app::internal_error;
  } catch (const kinetix::app::NotPrintable& e) {
    kinetix::app::report_error(e, kinetix::app::target_missed, as_json);
    return kinetix::app::target_missed;
  } catch (const kinetix::InvalidInput& e) {
    kinetix::app::report_error(e, kinetix::app::bad_input, as_json);
    return kinetix::app::bad_input;
  } catch (const kinetix::app::Interrupted& e) {
    std::cerr << e.what() << ": nothing is written\n";
    if (as_json) kinetix::app::print_error(e.what(), kinetix::app::interrupted_early);
    return kinetix::app::interrupted_early;
  } catch (const std::exception& e) {
    const std::string message = kinetix::app::failure_text(e);
    std::cerr << message << "\n";
    if (as_json) kinetix::app::print_error(message, kinetix::app::internal_error);
    return kinetix::app::internal_error;
  }
}
