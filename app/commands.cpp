#include "app/commands.hpp"

#include <fmt/format.h>

#include <functional>
#include <iostream>

#include "app/atomic_file.hpp"
#include "app/console.hpp"
#include "app/design_motion.hpp"
#include "app/output.hpp"
#include "app/result_json.hpp"
#include "app/run_design.hpp"
#include "app/run_target.hpp"
#include "app/stopwatch.hpp"
#include "app/sweep/sweep_plan.hpp"
#include "model/invalid_input.hpp"
#include "targets/document.hpp"

namespace kinetix {
namespace {

/// @param suffix keeps the results of one command from replacing another's
std::string folder_of(const CommandOptions& options, const std::string& name,
                      const std::string& suffix = "") {
  return options.folder_given ? options.folder : "results/" + name + suffix;
}

RunOptions run_options(const CommandOptions& options, Console& console) {
  return {options.threads, options.seed, options.verify, console.progress()};
}

/// Bad input that was found after reading gets the file's name.
Run located(const std::string& file, const std::function<Run()>& make) {
  try {
    return make();
  } catch (const InvalidInput& e) {
    if (!e.place().file.empty()) throw;
    throw InvalidInput(e.reason(), {file, 0, 0, e.place().key});
  }
}

int exit_code(const Run& run) {
  if (run.curve && !run.curve->met) return target_missed;
  if (run.display && !run.display->met()) return target_missed;
  if (run.fold && !run.fold->met()) return target_missed;
  if (run.helmet && !run.helmet->met()) return target_missed;
  if (run.equilibrium && !run.equilibrium->reached()) return target_missed;
  if (run.verification && !run.verification->agrees) return physics_disagrees;
  return done;
}

int report(Run run, double load_seconds, OutputFolder& folder, bool as_json) {
  run.timings.load = load_seconds;
  const auto json = write_results(run, folder.path());
  folder.keep();
  if (as_json)
    std::cout << json.dump(1) << "\n";
  else
    std::cout << summary(run)
              << fmt::format("  {:<10} {}/report.html, result.json, design.yaml\n", "written", folder.path());
  return exit_code(run);
}

using DesignRun = Run (*)(const DesignFile&, const RunOptions&);

int run_design(const CommandOptions& options, DesignRun run, const std::string& suffix) {
  Stopwatch watch;
  DesignFile design = read_design(options.file);
  if (options.theta_given) {
    design.theta = options.theta_deg * radians_per_degree;
    design.drive.reset();
  }
  OutputFolder folder(folder_of(options, design.name, suffix));
  const double load = watch.lap();
  Console console(options.quiet);
  Run outcome = located(options.file, [&] { return run(design, run_options(options, console)); });
  return report(std::move(outcome), load, folder, options.json);
}

}  // namespace

int optimise_command(const CommandOptions& options) {
  Stopwatch watch;
  const Target target = read_target(options.file);
  OutputFolder folder(folder_of(options, name_of(target)));
  const double load = watch.lap();
  Console console(options.quiet);
  Run run = located(options.file, [&] { return run_target(target, run_options(options, console)); });
  return report(std::move(run), load, folder, options.json);
}

int verify_command(const CommandOptions& options) {
  return run_design(options, simulate_physics, "_verified");
}

int simulate_command(const CommandOptions& options) {
  const DesignRun run = options.model == "bullet"        ? simulate_physics
                        : options.model == "equilibrium" ? simulate_equilibrium
                                                         : simulate_exact;
  return run_design(options, run, "_" + options.model);
}

int check_command(const CommandOptions& options) {
  const Node root = read_document(options.file, max_design_bytes);
  const bool is_sweep = root.optional("factors").has_value(), is_target = root.optional("target").has_value();
  const std::string name = is_sweep    ? make_sweep_plan(options.file, {}).doe.name
                           : is_target ? name_of(read_target(root))
                                       : read_design(root).name;
  const char* kind = is_sweep ? "sweep" : is_target ? "target" : "design";
  if (options.json)
    std::cout << nlohmann::ordered_json{{"file", options.file},
                                        {"kind", kind},
                                        {"name", name},
                                        {"valid", true}}
                     .dump(1)
              << "\n";
  else
    std::cout << fmt::format("{}: valid {} '{}'\n", options.file, kind, name);
  return done;
}

}  // namespace kinetix
