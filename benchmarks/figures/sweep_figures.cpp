#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "app/sweep/evaluators/evaluator.hpp"
#include "benchmarks/figure.hpp"
#include "benchmarks/stopwatch.hpp"
#include "tests/app/program.hpp"
#include "tests/app/sweep/launch.hpp"

namespace kinetix::bench {
namespace {

using testing::Scratch;

constexpr int columns = 40;  // cells of the strip: as many as of a curve by default

/// A strip whose columns bend in turn, as the base of the sweeps.
std::string strip() {
  std::string text = fmt::format(
      "kinetix: 1\nstructure: {{cells: [{}, 1], cell_mm: 10}}\ndesign:\n  theta_deg: 20\n  hinges:\n",
      columns);
  for (int c = 0; c < columns; ++c)
    for (int row = 0; row < 2; ++row)
      text += fmt::format("    - {{wall: [[{0}, {1}], [{2}, {1}]], beta_deg: {3}}}\n", c, row, c + 1,
                          (c + row) % 2 ? -9 : 9);
  return text;
}

/// Returns a sweep of fold angle and all tilts at once, by Latin hypercube.
std::string sweep(int samples, const std::string& model) {
  return fmt::format(
      "kinetix: 1\nname: swept\nbase: strip.yaml\nmodel: {}\nmethod: {{kind: lhs, samples: {}}}\nfactors:\n"
      "  - {{path: design.theta_deg, range: [5, 30]}}\n"
      "  - {{path: \"design.columns[*].beta_deg\", range: [-20, 20]}}\n"
      "responses: [end_mm, turn_deg]\n",
      model, samples);
}

struct Sweep {
  Scratch folder;
  std::string file;

  Sweep(int samples, const std::string& model = "exact") {
    folder.write("strip.yaml", strip());
    file = folder.write("doe.yaml", sweep(samples, model));
  }
  std::string out(const std::string& name) const { return folder / name; }
};

Figure states_per_second() {
  constexpr int samples = 200000;
  const Sweep files(samples);
  const app::SweepPlan plan = app::make_sweep_plan(files.file, std::nullopt);
  const auto evaluator = make_evaluator(plan);
  int failed = 0;
  const double time = median_seconds(5, 1, [&] {
    for (int k = 0; k < samples; ++k)
      failed += run_sample(plan, *evaluator, k).status != app::SampleStatus::ok;
  });
  return {
      fmt::format("sweep of the exact model, {}-column strip, end point and total turn, one core", columns),
      ">= 100 000 states a second", fmt::format("{:.0f} a second, {} failed", samples / time, failed),
      samples / time >= 1e5 && failed == 0};
}

/// Returns the samples per second that the program stores; 0 if it fails.
double stored_per_second(const Sweep& files, const std::string& launcher, int threads) {
  const std::string out = files.out("out"), log = files.out("log");
  const int status =
      std::system(fmt::format("{} {} sweep {} -o {} --quiet --json --threads {} >{} 2>/dev/null", launcher,
                              KINETIX_OPT, files.file, out, threads, log)
                      .c_str());
  testing::fs::remove_all(out);
  if (status != 0) return 0;
  const auto summary = nlohmann::json::parse(testing::text_of(log));
  return summary["computed"].get<double>() / summary["seconds"].get<double>();
}

/// Launcher that restricts the program to one core.
const std::string on_one_core = "taskset -c 0";

Figure stored() {
  const Sweep files(400000);
  std::vector<double> rates;
  for (int run = 0; run < 5; ++run) rates.push_back(stored_per_second(files, on_one_core, 1));
  const double rate = median(rates);
  return {"the same, every sample durable (SQLite, synchronous), the whole program on one core",
          ">= 20 000 samples a second", fmt::format("{:.0f} a second", rate), rate >= 2e4};
}

/// Sweep that compares two workers with one.
struct Scaling {
  const char* what;
  const char* model;
  int samples;
  double least;  ///< ratio asked for
};

// Samples: a run takes seconds with these, so that the start of the workers is negligible.
constexpr Scaling scalings[] = {{"exact model", "exact", 500000, 1.8},
                                {"equilibrium model", "equilibrium", 150, 1.9}};

Figure two_workers(const Scaling& scaling, const std::string& kind,
                   const std::function<double(const Sweep&, int)>& rate) {
  const Sweep files(scaling.samples, scaling.model);
  std::vector<double> twice, four_times;
  for (int run = 0; run < 5; ++run) {
    const double one = rate(files, 1);
    twice.push_back(rate(files, 2) / one);
    four_times.push_back(rate(files, 4) / one);
  }
  const double ratio = median(twice);
  return {fmt::format("sweep of the {}: two {} against one", scaling.what, kind),
          fmt::format(">= {:g} times", scaling.least),
          fmt::format("{:.2f} times: grows with their number to the {:.2f} (four on {} cores: {:.2f} times)",
                      ratio, std::log2(ratio), std::thread::hardware_concurrency(), median(four_times)),
          ratio >= scaling.least};
}

std::vector<Figure> two_against_one() {
  std::vector<Figure> figures;
  for (const Scaling& scaling : scalings) {
    figures.push_back(two_workers(scaling, "cores (threads)", [](const Sweep& files, int count) {
      return stored_per_second(files, count == 1 ? on_one_core : "", count);
    }));
    figures.push_back(two_workers(scaling, "ranks", [](const Sweep& files, int count) {
      return stored_per_second(files, testing::ranks(count), 1);
    }));
  }
  return figures;
}

/// Kills the program at a random moment, resumes it to the end, and compares tables; 20 times over. Then kills one
/// sweep 20 times during its run.
Figure kills() {
  constexpr int count = 20;
  const Sweep files(60000);
  const std::string whole = files.out("whole");
  const auto arguments = [&](const std::string& out) {
    return std::vector<std::string>{KINETIX_OPT, "sweep",    files.file,  "-o",
                                    out,         "--resume", "--threads", "2"};
  };
  const auto finish = [&](const std::string& out) {
    return testing::kinetix_opt("sweep " + files.file + " --quiet --resume -o " + out).code;
  };
  const double time = 1e3 * seconds([&] { finish(whole); });
  const std::string table = testing::text_of(whole + "/samples.csv");
  std::mt19937 random(20);
  std::uniform_real_distribution<double> moment(0, time);
  int killed = 0, same = 0;
  for (int k = 0; k < count; ++k) {
    const std::string out = files.out("killed");
    killed += testing::run_and_kill(arguments(out), moment(random));
    same += finish(out) == 0 && testing::text_of(out + "/samples.csv") == table;
    testing::fs::remove_all(out);
  }
  const std::string often = files.out("often");
  int of_one = 0;
  for (int k = 0; k < count; ++k) of_one += testing::run_and_kill(arguments(often), moment(random) / 3);
  const bool same_at_last = finish(often) == 0 && testing::text_of(often + "/samples.csv") == table;
  return {"kill -9 at 20 random moments, then resume: tables that are the same, byte for byte",
          "each, no sample lost or doubled",
          fmt::format("{} of {} ({} were still running); one sweep killed {} times: {}", same, count, killed,
                      of_one, same_at_last ? "the same" : "NOT the same"),
          same == count && same_at_last && !table.empty()};
}

}  // namespace

std::vector<Figure> sweep_figures() {
  std::vector<Figure> figures = {states_per_second(), stored()};
  for (Figure& figure : two_against_one()) figures.push_back(std::move(figure));
  figures.push_back(kills());
  return figures;
}

}  // namespace kinetix::bench
