#include <fmt/format.h>
#include <glog/logging.h>
#include <malloc.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <new>

#include "app/cli/commands.hpp"
#include "app/cli/error_report.hpp"
#include "app/cli/main_options.hpp"
#include "app/files/design_file.hpp"
#include "app/io/atomic_file.hpp"
#include "app/print/fit.hpp"
#include "app/sweep/sweep_command.hpp"
#include "app/version.hpp"
#include "model/base/invalid_input.hpp"

namespace {

using kinetix::app::CommandLine;

/// Sets the default format of a coupon: a 3MF file has the settings that keep the coupon's gaps open, and cutters read
/// drawings.
void choose_format(kinetix::app::PrintRequest& request) {
  if (!request.formats.empty()) return;
  if (!request.coupon)
    throw kinetix::InvalidInput("--format is missing. Give e.g. --format 3mf (see --help)");
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
    throw kinetix::InvalidInput(fmt::format("{} only applies to a search, not to {}. Remove it (see --help)",
                                            given, command.get_name()));
  }
}

/// Looks for --json, also in a command line that cannot be parsed.
bool requests_json(int argc, char** argv) {
  return std::any_of(argv + 1, argv + argc,
                     [](const char* word) { return std::string_view(word) == "--json"; });
}

/// Runs the command of a parsed command line. @return its exit code
int run_command(const CLI::App& app, CommandLine& line) {
  namespace kx = kinetix::app;
  kinetix::app::CommandOptions& options = line.options;
  if (options.model == "rigid_body") options.model = "bullet";
  const auto is_chosen = [&](const char* name) { return app.got_subcommand(name); };
  if (is_chosen("import")) return kx::import_command(options, line.model);
  if (is_chosen("export")) {
    kx::refuse_wrong_file(line.print.source);
    choose_format(line.print);
    return kx::export_command(options, line.print);
  }
  if (is_chosen("view")) {
    kx::refuse_wrong_file(line.view.source);
    return kx::view_command(options, line.view);
  }
  kx::refuse_wrong_file(options.file);
  if (is_chosen("sweep")) return kx::sweep_command(options, line.share);
  if (is_chosen("verify") || is_chosen("simulate") || is_chosen("check"))
    options.file = kx::design_at(options.file);
  if (is_chosen("verify")) return kx::verify_command(options);
  if (is_chosen("simulate")) return kx::simulate_command(options);
  if (is_chosen("check")) return kx::check_command(options);
  if (!options.file.empty()) return kx::optimise_command(options);
  std::cerr << kx::start_text();
  return kx::bad_input;
}

int run(int argc, char** argv) {
  CommandLine line;
  CLI::App app(
      "Designs flat sheets that fold into a goal, checks them in simulation, and exports them for printing. "
      "Without a command it searches a design for the goal of TARGET.yaml.",
      "kinetix-opt");
  app.set_version_flag("--version", std::string("kinetix-opt ") + kinetix::app::version, "print the version");
  app.set_help_flag("-h,--help", "print this help");
  add_options(app, line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (app.exit(e) == 0) return kinetix::app::done;
    if (requests_json(argc, argv)) kinetix::app::print_error(e.what(), kinetix::app::bad_input);
    return kinetix::app::bad_input;
  }
  for (const CLI::App* command : app.get_subcommands()) refuse_options_before(app, *command);
  return run_command(app, line);
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

int kinetix::app::run_command_line(int argc, char** argv) {
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
