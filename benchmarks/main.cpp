#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iostream>

#include "benchmarks/figure.hpp"
#include "benchmarks/page.hpp"

namespace {

using kinetix::bench::Figure;

std::string first_value(const char* file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.rfind(key, 0) == 0) return line.substr(line.find_first_of(":=") + 1);
  return "unknown";
}

std::string trimmed(std::string text) {
  std::erase(text, '"');
  text.erase(0, text.find_first_not_of(" \t"));
  return text;
}

std::string machine() {
  return fmt::format("{}, {}, g++ {}.{}.{}", trimmed(first_value("/proc/cpuinfo", "model name")),
                     trimmed(first_value("/etc/os-release", "PRETTY_NAME")), __GNUC__, __GNUC_MINOR__,
                     __GNUC_PATCHLEVEL__);
}

std::string row(const Figure& f) {
  return fmt::format("| {} | {} | {} | {} |\n", f.what, f.asked, f.measured, f.met ? "yes" : "**no**");
}

struct Group {
  const char* name;
  std::vector<Figure> (*measure)();
};

constexpr Group groups[] = {{"model", kinetix::bench::model_figures},
                            {"elastic", kinetix::bench::elastic_figures},
                            {"load_path", kinetix::bench::load_path_figures},
                            {"stable_state", kinetix::bench::stable_state_figures},
                            {"search", kinetix::bench::search_figures},
                            {"physics", kinetix::bench::physics_figures},
                            {"elastic_physics", kinetix::bench::elastic_physics_figures},
                            {"display", kinetix::bench::display_figures},
                            {"fold", kinetix::bench::fold_figures},
                            {"helmet", kinetix::bench::helmet_figures},
                            {"growth", kinetix::bench::growth_figures},
                            {"sweep", kinetix::bench::sweep_figures},
                            {"regression", kinetix::bench::regression_figures}};

/// Appends the rows of a group. @return whether all its figures are met
bool measure(const Group& group, std::string& table) {
  bool all_met = true;
  for (const Figure& figure : group.measure()) {
    std::cerr << (figure.met ? "met     " : "MISSED  ") << figure.what << ": " << figure.measured
              << std::endl;
    table += row(figure);
    all_met = all_met && figure.met;
  }
  return all_met;
}

/// One group alone, printed.
int measure_only(const std::string& name) {
  std::string table;
  for (const Group& group : groups) {
    if (name != group.name) continue;
    const bool all_met = measure(group, table);
    std::cout << table;
    return all_met ? 0 : 1;
  }
  std::cerr << "no group " << name << "; there are";
  for (const Group& group : groups) std::cerr << " " << group.name;
  std::cerr << std::endl;
  return 2;
}

}  // namespace

/// Measures every figure of the table and prints it; with `--write FILE` puts it into that page as well, and
/// the picture beside it; with `--only NAME` measures one group and prints its rows.
int main(int argc, char** argv) {
  const std::string option = argc == 3 ? argv[1] : "";
  if (option == "--only") return measure_only(argv[2]);
  std::string table = "Measured on " + machine() + ", release build, one run of `make bench`.\n\n";
  table += "| what | asked | measured | met |\n|---|---|---|---|\n";
  bool all_met = true;
  for (const Group& group : groups) all_met = measure(group, table) && all_met;
  const std::string solvers = kinetix::bench::solver_table();
  std::cout << table << "\n" << solvers;
  if (option == "--write") {
    kinetix::bench::write_into(argv[2], {{"table", table}, {"solvers", solvers}});
    std::ofstream(std::filesystem::path(argv[2]).replace_filename("twist_barrier.svg"))
        << kinetix::bench::barrier_plot();
  }
  return all_met ? 0 : 1;
}
