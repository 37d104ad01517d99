#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <regex>

#include "benchmarks/figure.hpp"
#include "benchmarks/stopwatch.hpp"
#include "model/base/geometry.hpp"
#include "tests/app/print/mujoco_judge.hpp"
#include "tests/app/program.hpp"

namespace kinetix::bench {
namespace {

using testing::Scratch;

/// Returns the stdout of a command; empty if it fails.
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

#ifdef KINETIX_MUJOCO
/// Returns the positions of the bodies in the first state of a result, mm, one column each.
Eigen::Matrix3Xd target_positions(const nlohmann::json& result) {
  const auto& poses = result["states"][0]["poses"];
  Eigen::Matrix3Xd out(3, poses.size());
  for (std::size_t b = 0; b < poses.size(); ++b)
    for (int k = 0; k < 3; ++k) out(k, static_cast<Eigen::Index>(b)) = poses[b]["position_mm"][k];
  return out;
}

/// Compares the exported scene, folded in MuJoCo by its actuator, with the shape that it was made for.
Figure mjcf_round_trip(const std::string& goal, const std::string& hinge) {
  Figure figure{fmt::format("MJCF there and back: {} with {}s, folded in MuJoCo", goal, hinge),
                "<= 0.05 cell edges from the exact shape", "not exported", false};
  const Scratch folder;
  const std::string found = folder / "found", printed = folder / "print";
  output_of(fmt::format("{} {}/{}.yaml --no-verify --quiet -o {}", KINETIX_OPT, KINETIX_SHAPES, goal, found));
  output_of(fmt::format("{} export {} --format mjcf --hinge {} -o {}", KINETIX_OPT, found, hinge, printed));
  const std::string scene = testing::text_of(fmt::format("{}/{}.xml", printed, goal));
  if (scene.empty()) return figure;
  const auto result = nlohmann::json::parse(testing::text_of(found + "/result.json"));
  testing::MujocoVerdict verdict;
  const double took = seconds([&] { verdict = testing::fold_in_mujoco(scene, 1, 1.2); });
  figure.measured = verdict.error;
  const Eigen::Matrix3Xd exact = target_positions(result);
  if (!verdict.error.empty() || exact.cols() != static_cast<Eigen::Index>(verdict.positions.size()))
    return figure;
  Eigen::Matrix3Xd folded(3, exact.cols());
  for (Eigen::Index b = 0; b < exact.cols(); ++b) folded.col(b) = 1e3 * verdict.positions[b];
  const Eigen::Matrix4d motion = rigid_fit(folded, exact);
  const double off =
      ((motion.topLeftCorner<3, 3>() * folded).colwise() + motion.topRightCorner<3, 1>().eval() - exact)
          .colwise()
          .norm()
          .maxCoeff() /
      double(result["structure"]["cell_mm"]);
  figure.measured = fmt::format("{:.1e} cell edges, {} bodies, {:.1f} s", off, exact.cols(), took);
  figure.met = off <= 0.05;
  return figure;
}
#endif

}  // namespace

std::vector<Figure> bridge_figures() {
  std::vector<Figure> all{python_folds(), blender_scene()};
#ifdef KINETIX_MUJOCO
  for (const char* goal : {"helmet_rib", "half_circle"})
    for (const char* hinge : {"block", "pin"}) all.push_back(mjcf_round_trip(goal, hinge));
#endif
  return all;
}

}  // namespace kinetix::bench
