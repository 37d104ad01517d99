#include "app/sweep/sweep_command.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "app/atomic_file.hpp"
#include "app/console.hpp"
#include "app/stopwatch.hpp"
#include "app/sweep/sweep_csv.hpp"
#include "app/sweep/thread_crew.hpp"
#include "app/sweep/work_queue.hpp"

namespace kinetix {
namespace {

/// How many samples ended how.
struct Tally {
  std::int64_t ok = 0, missed = 0, disagrees = 0, failed = 0;
};

Tally tally(const SweepTable& table) {
  Tally counts;
  table.read([&](const SampleRow& row) {
    ++(row.status == SampleStatus::ok          ? counts.ok
       : row.status == SampleStatus::missed    ? counts.missed
       : row.status == SampleStatus::disagrees ? counts.disagrees
                                               : counts.failed);
  });
  return counts;
}

void run_missing(const SweepPlan& plan, SweepTable& table, const CommandOptions& options) {
  Console console(options.quiet);
  WorkQueue queue(table.done());
  const int threads = options.threads > 0 ? options.threads : omp_get_max_threads();
  const WorkSource source = {
      [&](std::size_t count) { return queue.take(count); },
      [&](const std::vector<SampleRow>& rows) {
        table.add(rows);
        console.stage("sweep", static_cast<double>(table.count()) / static_cast<double>(plan.size()));
      }};
  run_on_threads(plan, plan.is_thread_safe() ? threads : 1, source);
}

}  // namespace

int sweep_command(const CommandOptions& options) {
  const SweepPlan plan =
      make_sweep_plan(options.file, options.seed_given ? std::optional(options.seed) : std::nullopt);
  OutputFolder folder(options.folder_given ? options.folder : "results/" + plan.doe.name);
  const SweepIdentity identity = identify(plan);
  SweepTable table(folder.path(), plan, identity, options.resume);
  folder.keep();
  Stopwatch watch;
  const std::int64_t before = table.count();
  run_missing(plan, table, options);
  const double seconds = watch.lap();
  write_csv(folder.path(), table, plan, identity);
  const Tally counts = tally(table);
  std::cout << fmt::format("{}: {} samples, {} failed, {:.0f} a second\n", plan.doe.name, plan.size(),
                           counts.failed, static_cast<double>(table.count() - before) / seconds);
  return done;
}

}  // namespace kinetix
