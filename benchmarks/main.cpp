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

}  // namespace

/// Measures every figure of the table and prints it; with `--write FILE` puts it into that page as well, and
/// the picture beside it.
int main(int argc, char** argv) {
  std::string table = "Measured on " + machine() + ", release build, one run of `make bench`.\n\n";
  table += "| what | asked | measured | met |\n|---|---|---|---|\n";
  bool all_met = true;
  for (const auto& figures :
       {kinetix::bench::model_figures, kinetix::bench::elastic_figures, kinetix::bench::load_path_figures,
        kinetix::bench::stable_state_figures,
        kinetix::bench::search_figures, kinetix::bench::physics_figures, kinetix::bench::elastic_physics_figures,
        kinetix::bench::display_figures, kinetix::bench::fold_figures})
    for (const Figure& figure : figures()) {
      std::cerr << (figure.met ? "met     " : "MISSED  ") << figure.what << ": " << figure.measured
                << std::endl;
      table += row(figure);
      all_met = all_met && figure.met;
    }
  const std::string solvers = kinetix::bench::solver_table();
  std::cout << table << "\n" << solvers;
  if (argc == 3 && std::string(argv[1]) == "--write") {
    kinetix::bench::write_into(argv[2], {{"table", table}, {"solvers", solvers}});
    std::ofstream(std::filesystem::path(argv[2]).replace_filename("twist_barrier.svg"))
        << kinetix::bench::barrier_plot();
  }
  return all_met ? 0 : 1;
}
