#include <fmt/format.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "benchmarks/figure.hpp"
#include "model/base/parallel_runs.hpp"
#include "tests/support/stl_volume.hpp"

namespace kinetix::bench {
namespace {

namespace fs = std::filesystem;

const char* const shapes_folder = KINETIX_SHAPES;

/// Output of a command, both streams, and its exit code.
struct CommandText {
  int code = 0;
  std::string text;
};

CommandText command_output(const std::string& command) {
  CommandText said;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  char text[4096];
  while (const std::size_t n = std::fread(text, 1, sizeof text, pipe)) said.text.append(text, n);
  said.code = WEXITSTATUS(pclose(pipe));
  return said;
}

double number_after(const std::string& text, const std::string& pattern) {
  std::smatch match;
  if (!std::regex_search(text, match, std::regex(pattern + R"(\s*([-+0-9.eE]+))"))) return NAN;
  return std::stod(match[1]);
}

/// Verdicts on every shipped target, with each hinge and process. Cells are as large as the program requires.
struct Verdicts {
  int exported = 0, larger = 0, refused = 0, unclean = 0, crossing = 0, misread = 0;
  double volume = 0;  ///< largest difference of a file's volume from print.json's, over that
  std::string first_fault;

  void fault(int& count, const std::string& what) {
    ++count;
    if (first_fault.empty()) first_fault = what;
  }
  void add(const Verdicts& more) {
    exported += more.exported, larger += more.larger, refused += more.refused;
    unclean += more.unclean, crossing += more.crossing, misread += more.misread;
    volume = std::max(volume, more.volume);
    if (first_fault.empty()) first_fault = more.first_fault;
  }
};

double volume_mm3(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return testing::volume_of_stl(std::string(std::istreambuf_iterator<char>(in), {}));
}

bool is_clean(const std::string& admesh) {
  std::smatch original;
  if (!std::regex_search(admesh, original, std::regex(R"(Facets with 3 disconnected edges\s*:\s*(\d+))")) ||
      original[1] != "0")
    return false;
  for (const char* what : {"Degenerate facets", "Edges fixed", "Facets removed", "Facets added",
                           "Facets reversed", "Backwards edges", "Normals fixed"})
    if (!(number_after(admesh, std::string(what) + R"(\s*:)") == 0)) return false;
  return true;
}

void judge(const fs::path& folder, const std::string& name, Verdicts& verdicts) {
  for (const char* part : {"hard.stl", "soft.stl"}) {
    const std::string file = folder / part;
    if (!fs::exists(file)) continue;
    if (!is_clean(command_output("admesh " + file).text)) verdicts.fault(verdicts.unclean, name + ": admesh");
    if (command_output(std::string(KINETIX_SELF_CROSSING) + " " + file)
            .text.find("manifold 1\nclosed 1\ncrossing 0") == std::string::npos)
      verdicts.fault(verdicts.crossing, name + ": CGAL");
  }
  const auto json = nlohmann::json::parse(command_output("cat " + std::string(folder / "print.json")).text);
  const std::string info = command_output("prusa-slicer --info " + std::string(folder / "all.stl")).text;
  const int parts = int(json["bodies"]) + (json["hinge"] == "pin" ? 0 : int(json["hinges"]));
  if (info.find("manifold = yes") == std::string::npos || number_after(info, "number_of_parts =") != parts)
    verdicts.fault(verdicts.misread, name + ": PrusaSlicer");
  for (const char* part : {"hard", "soft"})
    if (const double own = json["volume_mm3"][part]; own > 0)
      verdicts.volume =
          std::max(verdicts.volume, std::abs(volume_mm3(folder / (std::string(part) + ".stl")) / own - 1));
}

/// Whether a design exports at its size, or at the one that the refusal names.
bool exports(const std::string& command, Verdicts& verdicts) {
  CommandText run = command_output(command);
  if (run.code == 0) return true;
  std::smatch edge;
  if (!std::regex_search(run.text, edge, std::regex(R"(--cell-mm ([0-9.]+))"))) return false;
  ++verdicts.larger;
  return command_output(command + " --cell-mm " + edge.str(1)).code == 0;
}

Verdicts verdicts_on(const fs::path& target, const fs::path& scratch) {
  Verdicts verdicts;
  const std::string name = target.stem(), found = scratch / name;
  const std::string program = KINETIX_OPT;
  const bool is_design =
      command_output(program + " " + std::string(target) + " --no-verify --quiet -o " + found).code == 2;
  const std::string source = is_design ? std::string(target) : found;
  for (const char* hinge : {"pin", "block"})
    for (const char* process : {"polyjet", "fdm", "sla"}) {
      const fs::path folder = scratch / (name + "_print");
      fs::remove_all(folder);
      const std::string what = fmt::format("{}, {}, {}", name, hinge, process);
      if (exports(fmt::format("{} export {} --format stl --hinge {} --process {} -o {}", program, source,
                              hinge, process, folder.string()),
                  verdicts)) {
        ++verdicts.exported;
        judge(folder, what, verdicts);
      } else {
        ++verdicts.refused;
      }
    }
  return verdicts;
}

}  // namespace

std::vector<Figure> print_judge_figures() {
  const fs::path scratch = fs::temp_directory_path() / fmt::format("kinetix-judges-{}", getpid());
  fs::create_directories(scratch);
  Verdicts verdicts;
  std::vector<fs::path> targets;
  for (const auto& entry : fs::directory_iterator(shapes_folder))
    if (entry.path().extension() == ".yaml" && entry.path().stem() != "qr_code")
      targets.push_back(entry.path());
  std::sort(targets.begin(), targets.end());
  std::vector<Verdicts> each(targets.size());
  model::run_in_parallel(int(targets.size()), 0, [&](int k) { each[k] = verdicts_on(targets[k], scratch); });
  for (const Verdicts& of_target : each) verdicts.add(of_target);
  fs::remove_all(scratch);
  const auto none = [&](const std::string& what, int count) {
    return Figure{what, "0", count == 0 ? "0" : fmt::format("{}, first {}", count, verdicts.first_fault),
                  count == 0};
  };
  return {{fmt::format("{} targets x {{pin, block}} x {{polyjet, fdm, sla}}: exported", targets.size()),
           "all but hinges that stretch, as pins",
           fmt::format("{}, {} of them in larger cells; {} refused", verdicts.exported, verdicts.larger,
                       verdicts.refused),
           verdicts.exported > 0},
          none("files that admesh would repair", verdicts.unclean),
          none("files with faces that cross, by CGAL", verdicts.crossing),
          none("sheets that PrusaSlicer does not see as manifold parts, as many as bodies and blocks",
               verdicts.misread),
          {"volume of the files over that of print.json, less 1", "at most 1e-6",
           fmt::format("{:.1e}", verdicts.volume), verdicts.volume <= 1e-6}};
}

}  // namespace kinetix::bench
