#include "app/assembly/assembly_command.hpp"

#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "app/assembly/assembly_run.hpp"
#include "app/console/console.hpp"
#include "app/console/stopper.hpp"
#include "app/io/atomic_file.hpp"
#include "app/io/own_input.hpp"
#include "app/run/stopwatch.hpp"
#include "model/base/angle.hpp"
#include "model/base/invalid_input.hpp"

namespace kinetix::app {
namespace {

/// What only runs of sheets have, and would be left out without a word.
void refuse_what_is_of_sheets(const CommandOptions& options) {
  const auto refuse = [&](bool given, const char* what) {
    if (given)
      throw InvalidInput(std::string(what) + ", and this is an imported design of bodies", {options.file});
  };
  refuse(options.open, "--open shows the report of a sheet");
  refuse(options.fidelity, "--fidelity makes runs of sheets with coarser steps");
}

AssemblyRun located_run(const CommandOptions& options, AssemblyFile file, Model model) {
  Console console(options.quiet);
  const Stopper stopper(options.time_limit_s);
  RunOptions how;
  how.progress = console.progress();
  how.stop = stopper.token();
  const std::optional<double> theta =
      options.theta_given ? std::optional(options.theta_deg * radians_per_degree) : std::nullopt;
  try {
    return run_assembly(std::move(file), model, theta, how);
  } catch (const InvalidInput& e) {
    if (!e.place().file.empty()) throw;
    throw InvalidInput(e.reason(), {options.file, 0, 0, e.place().key});
  }
}

}  // namespace

int run_assembly_command(const CommandOptions& options, const targets::Node& root, Model model,
                         const std::string& suffix) {
  Stopwatch watch;
  refuse_what_is_of_sheets(options);
  AssemblyFile file = read_assembly(root);
  const std::string where =
      folder_beside_input(options.file, options.folder_of(file.name, suffix), options.folder_given);
  const double load = watch.lap();
  AssemblyRun run = located_run(options, std::move(file), model);
  run.load_s = load;
  OutputFolder folder(where);
  const std::string json = assembly_result(run).dump(1) + "\n";
  FileSet files(folder.path());
  files.add("result.json", json);
  AssemblyFile shown = run.file;
  if (!run.deployment) {
    shown.driven = run.driven;
    shown.angle =
        model::turn_at_theta(run.linkage.bodies[run.linkage.hinges[run.driven].lower].sense, run.theta);
  }
  for (const NamedContent& content : assembly_files(shown)) files.add(content.name, content.content);
  files.commit();
  folder.keep();
  std::cout << (options.json
                    ? json
                    : assembly_summary(run) + fmt::format("  {:<10} {}/result.json, design.yaml, parts\n",
                                                          "written", folder.path()));
  return exit_code(verdict_of(run));
}

}  // namespace kinetix::app
