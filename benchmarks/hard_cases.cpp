#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>

#include "benchmarks/page.hpp"
#include "benchmarks/stopwatch.hpp"
#include "model/elastic/elastic_system.hpp"
#include "sim/physics_run.hpp"
#include "tests/support/hard/hard_cases.hpp"

namespace kinetix::bench {
namespace {

using testing::HardAnswer;
using testing::HardCase;
using testing::HardEquilibrium;

// Bodies of a case that the engine is run on as well: larger cases would hold up the table for the engine
// alone.
constexpr std::size_t max_bodies = 3000;

sim::PhysicsResult physics_of(const HardEquilibrium& found) {
  sim::PhysicsOptions options;
  options.elastic = relative(found.elasticity, found.structure.size.edge_mm);
  options.contact = found.contact;
  options.planar = found.planar;
  options.overlap_limit = 0.01;
  return run_compression(found.structure, drive_on(found.structure, found.drive), options);
}

double energy_of(const HardEquilibrium& found, const model::State& state) {
  const model::ElasticSystem system(found.structure, found.elasticity, drive_on(found.structure, found.drive),
                                    found.planar, found.contact);
  return system.elastic_energy(state) * energy_unit(found.elasticity, found.structure.size.edge_mm);
}

std::string physics_answer(const HardAnswer& answer) {
  if (!answer.settled) return "-";
  const HardEquilibrium& found = *answer.settled;
  if (found.structure.bodies.size() > max_bodies)
    return fmt::format("not run: {} bodies", found.structure.bodies.size());
  const sim::PhysicsResult run = physics_of(found);
  if (run.status == sim::PhysicsResult::Status::blew_up) return run.why;
  return fmt::format("{}: E {:.4g} N mm, gap {:.1e}; rms {:.1e} from equilibrium ({:.1f} s)",
                     to_string(run.status), energy_of(found, run.state), run.gaps.max,
                     aligned_distance(found.structure, run.state, found.state).rms, run.seconds);
}

std::string row(const HardCase& hard, const HardAnswer& answer, double time) {
  return fmt::format("| {} | {} | {} | {} ({:.2f} s) | {} | {} |\n", hard.name, hard.asked,
                     answer.exact.empty() ? "-" : answer.exact, answer.equilibrium, time,
                     physics_answer(answer), to_string(answer.mark));
}

}  // namespace
}  // namespace kinetix::bench

/// Runs every hard case and prints the table. Ends with 1 if an answer is wrong.
int main(int argc, char** argv) {
  using namespace kinetix::bench;
  CLI::App program("Runs the model at and past the edges of what it is made for, and prints the table.");
  std::string page, words;
  program.add_option("--write", page, "a page that gets the table")->check(CLI::ExistingFile);
  program.add_option("--only", words, "cases with these words in their name alone");
  CLI11_PARSE(program, argc, argv);
  std::string table = "| case | asked | exact | equilibrium | physics run | |\n|---|---|---|---|---|---|\n";
  int wrong = 0;
  for (const HardCase& hard : kinetix::testing::hard_cases()) {
    if (hard.name.find(words) == std::string::npos) continue;
    HardAnswer answer;
    const double time = seconds([&] { answer = hard.solve(); });
    const std::string line = row(hard, answer, time);
    std::cerr << line << std::flush;
    table += line;
    wrong += answer.mark == HardAnswer::Mark::wrong;
  }
  std::cout << table;
  if (!page.empty()) write_into(page, {{"hard cases", table}});
  return wrong > 0 ? 1 : 0;
}
