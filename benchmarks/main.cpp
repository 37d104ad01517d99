#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string_view>

#include "benchmarks/figure.hpp"
#include "benchmarks/page.hpp"
#include "benchmarks/stopwatch.hpp"

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
  bool is_quick = false;  ///< one of those that a quick look takes, five minutes in all
};

// The tables in the order of the page, by their names on the command line.
constexpr Group groups[] = {{"whole_runs", kinetix::bench::whole_run_figures, true},
                            {"model", kinetix::bench::model_figures, true},
                            {"elastic", kinetix::bench::elastic_figures, true},
                            {"load_path", kinetix::bench::equilibrium_path_figures},
                            {"stable_state", kinetix::bench::stable_state_figures, true},
                            {"play", kinetix::bench::play_figures},
                            {"search", kinetix::bench::search_figures, true},
                            {"physics", kinetix::bench::physics_figures, true},
                            {"elastic_physics", kinetix::bench::elastic_physics_figures},
                            {"display", kinetix::bench::display_figures},
                            {"planar", kinetix::bench::planar_figures},
                            {"scaled_display", kinetix::bench::scaled_display_figures},
                            {"qr_code", kinetix::bench::qr_code_figures},
                            {"outline", kinetix::bench::outline_figures},
                            {"creases", kinetix::bench::crease_figures},
                            {"surface", kinetix::bench::surface_figures},
                            {"space", kinetix::bench::space_figures, true},
                            {"certified", kinetix::bench::certified_figures, true},
                            {"blocks", kinetix::bench::block_stiffness_figures},
                            {"framed_physics", kinetix::bench::framed_physics_figures, true},
                            {"matter", kinetix::bench::compensation_figures},
                            {"print", kinetix::bench::print_figures},
                            {"print_judges", kinetix::bench::print_judge_figures},
                            {"measured", kinetix::bench::measured_figures, true},
                            {"studio", kinetix::bench::studio_figures},
                            {"bridges", kinetix::bench::bridge_figures},
                            {"import", kinetix::bench::import_figures},
                            {"fold", kinetix::bench::fold_figures, true},
                            {"helmet", kinetix::bench::helmet_figures},
                            {"growth", kinetix::bench::growth_figures},
                            {"sweep", kinetix::bench::sweep_figures},
                            {"regression", kinetix::bench::regression_figures},
                            {"speed_error", kinetix::bench::speed_error_figures},
                            {"mechanism", kinetix::bench::mechanism_figures, true},
                            {"mujoco", kinetix::bench::mujoco_figures},
                            {"search_peers", kinetix::bench::search_peer_figures}};

/// Addition of a group to the page next to its rows: the text of a section, or a picture.
struct Extra {
  const char* group;
  const char* name;  ///< of the section's mark, or of the picture's file
  std::string (*make)();
  bool is_picture() const { return std::string_view(name).ends_with(".svg"); }
};

// Additions of the groups: pictures and sections of the page.
constexpr Extra extras[] = {{"stable_state", "twist_barrier.svg", kinetix::bench::barrier_plot},
                            {"play", "play_barrier.svg", kinetix::bench::play_plot},
                            {"physics", "solvers", kinetix::bench::solver_table},
                            {"speed_error", "speed error", kinetix::bench::speed_error_section},
                            {"speed_error", "speed_error.svg", kinetix::bench::speed_error_picture}};

/// Returns the figures of a group. If it ends with an error, returns one that names it, so that the hour of the others
/// is not lost.
std::vector<Figure> figures_of(const Group& group) {
  try {
    return group.measure();
  } catch (const std::exception& error) {
    return {{fmt::format("figures of {}", group.name), "measured", error.what(), false}};
  }
}

/// Appends the rows of a group and reports its time. @return whether all its figures are met
bool measure(const Group& group, std::string& table) {
  bool all_met = true;
  std::vector<Figure> figures;
  const double time = kinetix::bench::seconds([&] { figures = figures_of(group); });
  std::cerr << fmt::format("{}: {:.1f} s\n", group.name, time);
  for (const Figure& figure : figures) {
    std::cerr << (figure.met ? "met     " : "MISSED  ") << figure.what << ": " << figure.measured
              << std::endl;
    table += row(figure);
    all_met = all_met && figure.met;
  }
  return all_met;
}

/// Prints a section. If there is a page, writes the section into it, and a picture next to it.
void write(const Extra& extra, const std::string& page) {
  if (extra.is_picture() && page.empty()) return;
  const std::string text = extra.make();
  if (extra.is_picture()) {
    std::ofstream(std::filesystem::path(page).replace_filename(extra.name)) << text;
    return;
  }
  std::cout << "\n" << text;
  if (!page.empty()) kinetix::bench::write_into(page, {{extra.name, text}});
}

std::vector<std::string> group_names(bool only_quick) {
  std::vector<std::string> names;
  for (const Group& group : groups)
    if (group.is_quick || !only_quick) names.push_back(group.name);
  return names;
}

/// Measures and prints some groups alone.
int measure_only(const std::vector<std::string>& names, const std::string& page) {
  std::string table;
  bool all_met = true;
  const auto is_asked = [&](const char* name) { return std::ranges::find(names, name) != names.end(); };
  for (const Group& group : groups)
    if (is_asked(group.name)) all_met = measure(group, table) && all_met;
  std::cout << table;
  for (const Extra& extra : extras)
    if (is_asked(extra.group)) write(extra, page);
  return all_met ? 0 : 1;
}

}  // namespace

/// Measures every figure of the table and prints it. Ends with 1 where one is missed.
int main(int argc, char** argv) {
  CLI::App program("Measures every figure of benchmarks/README.md and prints the table.");
  std::string page;
  std::vector<std::string> only;
  program.add_option("--write", page, "a page that gets the table and sections, and pictures beside it")
      ->check(CLI::ExistingFile);
  bool quick = false;
  auto* const names =
      program
          .add_option("--only", only,
                      "these groups alone; a page then gets their sections and pictures, not the table")
          ->check(CLI::IsMember(group_names(false)));
  program.add_flag("--quick", quick, "the groups that take seconds, five minutes in all, as by --only")
      ->excludes(names);
  CLI11_PARSE(program, argc, argv);
  if (quick) only = group_names(true);
  if (!only.empty()) return measure_only(only, page);
  std::string table = "Measured on " + machine() + ", release build, one run of `make bench`.\n\n";
  table += "| what | asked | measured | met |\n|---|---|---|---|\n";
  bool all_met = true;
  for (const Group& group : groups) all_met = measure(group, table) && all_met;
  std::cout << table;
  if (!page.empty()) kinetix::bench::write_into(page, {{"table", table}});
  for (const Extra& extra : extras) write(extra, page);
  return all_met ? 0 : 1;
}
