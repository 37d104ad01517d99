#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "benchmarks/figure.hpp"
#include "tests/app/program.hpp"

namespace kinetix::bench {
namespace {

using testing::Scratch;

/// What a command says on stdout; empty where it fails.
std::string output_of(const std::string& command) {
  const Scratch folder;
  const std::string out = folder / "out";
  return std::system((command + " >" + out + " 2>/dev/null").c_str()) == 0 ? testing::text_of(out) : "";
}

Figure python_folds() {
  Figure figure{"Python: 100 000 folds of a strip of 40 columns in one call, one core",
                ">= 100 000 a second; equal to the program to the last bit", "no Python module", false};
  const std::string said =
      output_of("PYTHONPATH=" KINETIX_PYTHON_PATH " taskset -c 0 /usr/bin/python3 -B " KINETIX_SOURCE
                "/benchmarks/figures/python_folds.py " KINETIX_OPT);
  if (said.empty()) return figure;
  const auto rates = nlohmann::json::parse(said);
  const double first = rates["first"], fresh = rates["fresh"], own = rates["own"];
  const bool equal = rates["equal"];
  figure.measured = fmt::format(
      "{:.0f} a second, {:.0f} in the first call, {:.0f} into an array of the caller; 20 strips {}", fresh,
      first, own, equal ? "equal to the last bit" : "DIFFER");
  figure.met = first >= 1e5 && fresh >= 1e5 && own >= 1e5 && equal;
  return figure;
}

Figure blender_scene() {
  Figure figure{"Blender: a helmet of 844 bodies becomes objects with keyframes", "<= 10 s", "no Blender",
                false};
  const Scratch folder;
  const std::string found = folder / "helmet", scene = folder / "scene.blend";
  output_of(KINETIX_OPT " " KINETIX_SHAPES "/headform.yaml --no-verify --quiet -o " + found);
  const std::string said =
      output_of("blender -b --factory-startup --python-exit-code 1 --python " KINETIX_SOURCE
                "/examples/blender/kinetix_to_blender.py -- " +
                found + "/result.json -o " + scene);
  std::smatch numbers;
  if (!std::regex_search(said, numbers, std::regex("kinetix: ([0-9]+) bodies in ([0-9.]+) s"))) return figure;
  figure.measured = fmt::format("{} bodies, {} s", numbers[1].str(), numbers[2].str());
  figure.met = numbers[1] == "844" && std::stod(numbers[2]) <= 10;
  return figure;
}

}  // namespace

std::vector<Figure> bridge_figures() { return {python_folds(), blender_scene()}; }

}  // namespace kinetix::bench
