#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/cli/commands.hpp"
#include "app/console/console.hpp"
#include "benchmarks/alone.hpp"
#include "benchmarks/figure.hpp"
#include "benchmarks/stopwatch.hpp"
#include "tests/app/program.hpp"

namespace kinetix::bench {
namespace {

using testing::Scratch;

constexpr int repeats = 3;  // of each run, of which the median counts

/// Runs the program on a target. @return s. @throws std::runtime_error where there is no result: one that cannot be printed is one
double run_seconds(const std::string& target, const Scratch& folder) {
  testing::Outcome outcome;
  const double time =
      seconds([&] { outcome = testing::kinetix_opt(target + " --quiet -o " + (folder / "out").string()); });
  if (outcome.code != app::done && outcome.code != app::target_missed)
    throw std::runtime_error(target + ": " + outcome.err);
  return time;
}

/// Times a whole run, from the command to the last file.
Figure whole_run(const std::string& name, double required_s) {
  const Scratch folder;
  std::vector<double> times;
  for (int k = 0; k < repeats; ++k) times.push_back(run_seconds(KINETIX_SHAPES "/" + name + ".yaml", folder));
  const double time = median(std::move(times));
  return {name + ".yaml, whole run of `kinetix-opt`", fmt::format("<= {:.3g} s", required_s),
          fmt::format("{:.2f} s", time), time <= required_s};
}

/// Reports a part of a run as its result times it. @param target text of the file except its name.   @param stage of
/// timing_s
Figure stage_of_run(const std::string& what, const std::string& target, const std::string& stage,
                    double required_s) {
  const Scratch folder;
  const std::string file = folder.write("target.yaml", "kinetix: 1\nname: timed\n" + target);
  std::vector<double> times;
  for (int k = 0; k < repeats; ++k) {
    run_seconds(file, folder);
    times.push_back(nlohmann::json::parse(testing::text_of(folder / "out" / "result.json"))
                        .at("timing_s")
                        .at(stage)
                        .get<double>());
  }
  const double time = median(std::move(times));
  return {what, fmt::format("<= {:.3g} s", required_s), fmt::format("{:.2f} s", time), time <= required_s};
}

/// Measures `check` of squares of cells, in a separate process.
Figure check_of(int cells, double required_s, double required_bytes) {
  const Scratch folder;
  const std::string file = folder.write(
      "sheet.yaml",
      fmt::format("kinetix: 1\nstructure: {{cells: [{0}, {0}], cell_mm: 10}}\ndesign: {{}}\n", cells));
  const auto alone = cost_alone(
      [&] {
        Cost cost;
        cost.seconds = seconds([&] { cost.right = !app::check_file(file, {}, {}).text().empty(); });
        return cost;
      },
      60);
  return {fmt::format("`check` of {0} x {0} cells", cells),
          fmt::format("<= {:.3g} s, {:.3g} GiB", required_s, required_bytes / gib),
          alone ? fmt::format("{:.2f} s, {:.2f} GiB", alone->cost.seconds, alone->bytes / gib) : "none",
          alone && alone->cost.right && alone->cost.seconds <= required_s && alone->bytes <= required_bytes};
}

/// Returns the shipped half circle of 40 columns by 9 mm in other cells, its walls in the same proportions.
std::string half_circle(int columns, int rows, double cell_mm) {
  return fmt::format(
      "target: {{kind: curve, points: {}/half_circle.csv}}\n"
      "structure: {{cells: [{}, {}], cell_mm: {}, wall_mm: {{thickness: {}, height: {}}}}}\n"
      "variables:\n  beta: {{range_deg: [-60, 60], per: column, symmetry: none}}\n  theta: {{range_deg: [2, "
      "40]}}\n",
      KINETIX_SHAPES, columns, rows, cell_mm, 0.8 * cell_mm / 9, 6 * cell_mm / 9);
}

}  // namespace

std::vector<Figure> whole_run_figures() {
  return {whole_run("helmet_rib", 0.15),
          whole_run("cube", 0.6),
          whole_run("headform", 2),
          whole_run("letter_t", 3),
          whole_run("circle", 8),
          stage_of_run(
              "box of [20, 15, 10] cells: search",
              "target: {kind: fold, box: [20, 15, 10]}\nstructure: {cell_mm: 10, wall_mm: {thickness: 0.8, "
              "height: 6}}\n",
              "optimise", 0.5),
          stage_of_run("half circle in 40 x 20 cells: physics run", half_circle(40, 20, 9), "verify", 4),
          stage_of_run("half circle in 200 columns: search", half_circle(200, 1, 1.8), "optimise", 1),
          check_of(250, 1.5, 2 * gib),
          check_of(1000, 20, 2 * gib)};
}

}  // namespace kinetix::bench
