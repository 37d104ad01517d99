#include "app/sweep/sweep_command.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/console/short_form.hpp"
#include "app/io/atomic_file.hpp"
#include "app/report/report.hpp"
#include "app/sweep/table/sweep_table.hpp"
#include "app/sweep/workers/ranks.hpp"
#include "app/sweep/workers/worker_pools.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {
namespace {

/// Marks the samples that are done already, or belong to other shares.
std::vector<bool> finished_or_foreign(const SweepTable& table, const Share& share) {
  std::vector<bool> done = table.done();
  for (std::size_t k = 0; k < done.size(); ++k)
    if (!share.has(static_cast<std::int64_t>(k))) done[k] = true;
  return done;
}

/// Locked queue and table, as a source of samples for the threads and for the other ranks.
class Office {
 public:
  Office(SweepTable& table, const Share& share, const std::function<void()>& added)
      : table_(table), queue_(finished_or_foreign(table, share)), added_(added) {}

  WorkSource source() {
    return {[this](std::size_t count) { return take(count); },
            [this](const std::vector<SampleRow>& rows) { give(rows); }};
  }

 private:
  std::vector<std::int64_t> take(std::size_t count) {
    const std::lock_guard lock(mutex_);
    return queue_.take(count);
  }

  void give(const std::vector<SampleRow>& rows) {
    const std::lock_guard lock(mutex_);
    try {
      table_.add(rows);
    } catch (...) {
      queue_.stop();
      throw;
    }
    added_();
  }

  SweepTable& table_;
  WorkQueue queue_;
  const std::function<void()>& added_;
  std::mutex mutex_;
};

/// Computes samples on rank 0 while serving the other ranks. MPI calls stay on main's thread.
void work_and_serve(const SweepPlan& plan, const Ranks& ranks, int threads, const WorkSource& source,
                    const std::function<void(const std::string&)>& notice) {
  std::exception_ptr own, others;
  std::thread worker([&] {
    try {
      run_on_threads(plan, threads, source);
    } catch (...) {
      own = std::current_exception();
    }
  });
  try {
    ranks.serve(source, notice);
  } catch (...) {
    others = std::current_exception();
  }
  worker.join();
  if (own) std::rethrow_exception(own);
  if (others) std::rethrow_exception(others);
}

/// Computes the samples that were lost with ranks that left early.
void compute_lost(const SweepPlan& plan, SweepTable& table, const Share& share, int threads,
                  const std::function<void()>& added) {
  if (table.count() >= share.size(plan.size())) return;
  Office office(table, share, added);
  run_on_threads(plan, threads, office.source());
}

/// Returns the number of threads for a rank.
int threads_of(const SweepPlan& plan, const Ranks& ranks, int asked) {
  if (!plan.is_thread_safe() && ranks.size() > 1) return 1;
  if (asked > 0) return asked;
  const int cores = static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u));
  return std::max(1, std::min(omp_get_max_threads(), cores) / ranks.on_this_machine());
}

/// Computes the missing samples of a share: on threads, on the other ranks, or in separate processes if the
/// model keeps global state. The table does not depend on the workers.
/// @param threads of this process; 0: the machine's cores, divided among its ranks.
/// @param added called after each batch that is on the disk.
/// @throws exceptions of the table, after the other ranks have left
void run_sweep(const SweepPlan& plan, SweepTable& table, const Share& share, const Ranks& ranks, int threads,
               const std::function<void()>& added, const std::function<void(const std::string&)>& notice) {
  Office office(table, share, added);
  const WorkSource source = office.source();
  const int used = threads_of(plan, ranks, threads);
  if (ranks.size() > 1) {
    work_and_serve(plan, ranks, used, source, notice);
    return compute_lost(plan, table, share, used, added);
  }
  if (plan.is_thread_safe()) return run_on_threads(plan, used, source);
  run_in_processes(plan, used, source);
}

/// Progress bar of a sweep: fraction done, samples per second, time left.
class SweepProgress {
 public:
  /// @param total samples of the sweep; @param before samples that the table had at the start
  SweepProgress(Console& console, std::int64_t total, std::int64_t before);

  /// @param count samples in the table now
  void show(std::int64_t count);

 private:
  Console& console_;
  std::int64_t total_, before_;
  Stopwatch since_shown_;
  TimeLeft left_;
  double seconds_ = 0, next_ = 0;
};

constexpr double between_shows_s = 0.2;  // s: looks continuous; drawing costs little

SweepProgress::SweepProgress(Console& console, std::int64_t total, std::int64_t before)
    : console_(console), total_(total), before_(before) {
  console_.stage("sweep", static_cast<double>(before) / static_cast<double>(total));
  left_.update(0, static_cast<double>(before) / static_cast<double>(total));
}

void SweepProgress::show(std::int64_t count) {
  seconds_ += since_shown_.lap();
  if (seconds_ < next_ || count == before_) return;
  next_ = seconds_ + between_shows_s;
  const double rate = static_cast<double>(count - before_) / seconds_;
  const double done = static_cast<double>(count) / static_cast<double>(total_);
  left_.update(seconds_, done);
  const std::string left = left_.text(seconds_);
  console_.stage(
      "sweep", done,
      fmt::format("{} of {}, {:.3g} per second{}{}", count, total_, rate, left.empty() ? "" : ", ", left));
}

using Json = nlohmann::ordered_json;

/// Number of samples per status, and the first that failed.
struct Tally {
  std::int64_t ok = 0, missed = 0, disagrees = 0, failed = 0;
  std::int64_t first_failed = -1;
  std::string why;
};

Tally tally(const SweepTable& table) {
  Tally counts;
  table.read([&](const SampleRow& row) {
    ++(row.status == SampleStatus::ok          ? counts.ok
       : row.status == SampleStatus::missed    ? counts.missed
       : row.status == SampleStatus::disagrees ? counts.disagrees
                                               : counts.failed);
    if (row.status != SampleStatus::failed || counts.first_failed >= 0) return;
    counts.first_failed = row.sample;
    counts.why = row.reason;
  });
  return counts;
}

/// Work of this call, for its summary.
struct Work {
  std::int64_t before = 0, computed = 0;
  std::int64_t damaged = 0;  ///< rows of the tables that existed before
  double seconds = 0;
  int ranks = 1, threads = 1;
};

Json summary_json(const SweepPlan& plan, const Tally& counts, const Work& work, const std::string& folder) {
  return {{"schema", "kinetix-sweep/1"},
          {"name", plan.doe.name},
          {"model", to_string(plan.doe.model)},
          {"seed", plan.seed},
          {"factors", plan.samples.factors().size()},
          {"responses", plan.responses.size()},
          {"samples", plan.size()},
          {"ok", counts.ok},
          {"missed", counts.missed},
          {"disagrees", counts.disagrees},
          {"failed", counts.failed},
          {"computed", work.computed},
          {"damaged", work.damaged},
          {"seconds", work.seconds},
          {"ranks", work.ranks},
          {"threads", work.threads},
          {"table", folder + "/sweep.sqlite"}};
}

/// Composes the output of a sweep. @param written files in the folder, in words
ShortForm sweep_form(const SweepPlan& plan, const Tally& counts, const Work& work, const std::string& folder,
                     const std::string& written) {
  ShortForm out;
  out.title = fmt::format("{}: {} of {}, {}, model {}", plan.doe.name,
                          targets::counted(plan.samples.size(), "sample"),
                          targets::counted(plan.samples.factors().size(), "factor"),
                          targets::counted(plan.responses.size(), "response"), to_string(plan.doe.model));
  std::string ended = fmt::format("{} ok", counts.ok);
  if (counts.missed > 0) ended += fmt::format(", {} missed", counts.missed);
  if (counts.disagrees > 0) ended += fmt::format(", {} disagree", counts.disagrees);
  if (counts.failed > 0) ended += fmt::format(", {} failed", counts.failed);
  out.lines = {{"samples", ended},
               {"run", fmt::format("{} in {}, {:.3g} per second, {} {} of {} {}", work.computed,
                                   duration_text(work.seconds),
                                   static_cast<double>(work.computed) / std::max(work.seconds, 1e-9),
                                   work.ranks, work.ranks == 1 ? "process" : "ranks", work.threads,
                                   work.threads == 1 ? "thread" : "threads")}};
  if (work.before > 0)
    out.lines.push_back({"resumed", fmt::format("{} samples were already computed", work.before)});
  if (counts.first_failed >= 0)
    out.problems.push_back(
        {"warning", fmt::format("sample {} is the first that failed: {}", counts.first_failed, counts.why)});
  if (work.damaged > 0)
    out.problems.push_back(
        {"warning", fmt::format("{} of the table damaged; their samples were computed again",
                                targets::counted(static_cast<std::size_t>(work.damaged), "row"))});
  out.ends = {"Written: " + folder + "/" + written};
  return out;
}

std::string fingerprint(const SweepIdentity& identity) {
  std::string text;
  for (const auto& [key, value] : identity) text += key + "=" + value + "\n";
  return text;
}

SweepPlan plan_of(const CommandOptions& options) {
  return make_sweep_plan(options.file, options.seed_given ? std::optional(options.seed) : std::nullopt,
                         options.changes);
}

std::string folder_of(const CommandOptions& options, const SweepPlan& plan, const Share* part) {
  const std::string folder = options.folder_of(plan.doe.name);
  return part ? folder + "/" + part->folder() : folder;
}

/// Runs a sweep on rank 0. Its constructor finds all input errors before the other ranks start.
class Lead {
 public:
  Lead(const CommandOptions& options, const std::string& share, const Ranks& ranks)
      : options_(options),
        ranks_(ranks),
        plan_(plan_of(options)),
        share_(share),
        part_(share.empty() ? Share{} : read_share(share)),
        folder_(folder_of(options, plan_, share.empty() ? nullptr : &part_)),
        identity_(identify(plan_)),
        shares_(share.empty() ? shares_in(folder_.path(), plan_, identity_) : std::vector<ShareTable>()),
        table_(folder_.path(), plan_, identity_, options.resume) {
    folder_.keep();
    for (const ShareTable& other : shares_) merge_share(other.folder, table_, plan_, identity_);
  }

  std::string fingerprint() const { return app::fingerprint(identity_); }

  int run() {
    Work work{.before = table_.count(), .damaged = warn_of_damage(), .ranks = ranks_.size()};
    work.threads = threads_of(plan_, ranks_, options_.threads);
    {
      Console console(options_.quiet);
      SweepProgress progress(console, std::max<std::int64_t>(part_.size(plan_.size()), 1), table_.count());
      Stopwatch watch;
      run_sweep(
          plan_, table_, part_, ranks_, options_.threads, [&] { progress.show(table_.count()); },
          [&](const std::string& words) { console.error(words); });
      work.seconds = watch.lap();
    }
    work.computed = table_.count() - work.before;
    if (share_.empty()) write_files();
    const Tally counts = tally(table_);
    if (options_.open) open_report(folder_.path() + "/report.html");
    print_summary(counts, work);
    return done;
  }

 private:
  /// @return number of damaged rows, including those of shares
  std::int64_t warn_of_damage() const {
    Console console(options_.quiet);
    std::int64_t all = 0;
    std::vector<ShareTable> tables = shares_;
    tables.push_back({folder_.path(), table_.damaged()});
    for (const auto& [folder, damaged] : tables) {
      if (damaged > 0)
        console.warning(
            fmt::format("{}/sweep.sqlite: {} damaged: checksum or factors do not fit; "
                        "the samples are computed again",
                        folder, targets::counted(static_cast<std::size_t>(damaged), "row")));
      all += damaged;
    }
    return all;
  }

  void write_files() const {
    write_csv(folder_.path(), table_, plan_, identity_);
    const Json analysed = sweep_json(plan_, identity_, table_);
    write_file(folder_.path() + "/report.html", sweep_html(compact_sweep(analysed).dump()));
    write_file(folder_.path() + "/sweep.json", analysed.dump(1) + "\n");
  }

  void print_summary(const Tally& counts, const Work& work) const {
    const std::string& folder = folder_.path();
    if (!options_.json) {
      const char* written = share_.empty()
                                ? "report.html, samples.csv, sweep.sqlite, sweep.json"
                                : "sweep.sqlite; a run without --share takes it over and writes the rest";
      print_on_stdout(sweep_form(plan_, counts, work, folder, written), options_.verbose);
      return;
    }
    Json json = summary_json(plan_, counts, work, folder);
    if (share_.empty())
      json.update({{"csv", folder + "/samples.csv"},
                   {"report", folder + "/report.html"},
                   {"analysis", folder + "/sweep.json"}});
    else
      json["share"] = share_;
    std::cout << json.dump(1) << "\n";
  }

  const CommandOptions& options_;
  const Ranks& ranks_;
  SweepPlan plan_;
  const std::string& share_;  // as requested; empty: all samples
  Share part_;
  OutputFolder folder_;
  SweepIdentity identity_;
  std::vector<ShareTable> shares_;
  SweepTable table_;
};

int lead(const CommandOptions& options, const std::string& share, const Ranks& ranks) {
  std::optional<Lead> leader;
  try {
    if (options.open && !share.empty()) throw InvalidInput("--open: a share has no report");
    leader.emplace(options, share, ranks);
  } catch (...) {
    ranks.from_first({});
    throw;
  }
  ranks.from_first(leader->fingerprint());
  return leader->run();
}

/// Runs a sweep on the other ranks. Only rank 0 prints errors.
int follow(const CommandOptions& options, const Ranks& ranks) {
  const std::string wanted = ranks.from_first({});
  if (wanted.empty()) return done;
  try {
    const SweepPlan plan = plan_of(options);
    if (fingerprint(identify(plan)) != wanted) throw InvalidInput("reads other files than rank 0");
    ranks.work(plan, threads_of(plan, ranks, options.threads));
  } catch (const std::exception& e) {
    ranks.leave(e.what());
  }
  return done;
}

}  // namespace

int sweep_command(const CommandOptions& options, const std::string& share) {
  const Ranks ranks;
  return ranks.rank() == 0 ? lead(options, share, ranks) : follow(options, ranks);
}

}  // namespace kinetix::app
