#include <fmt/format.h>
#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>

#include "benchmarks/figure.hpp"
#include "benchmarks/peers/mujoco_run.hpp"
#include "benchmarks/scenes.hpp"
#include "benchmarks/stopwatch.hpp"
#include "sim/physics_run.hpp"
#include "tests/support/elastic_runs.hpp"

namespace kinetix::bench {
namespace {

/// Steps in which the drive goes from flat to its end.
struct Course {
  int steps;
  double step_s;  ///< s; damping at the end acts by it
};

// From few steps to the default of the physics run, none longer than it allows; each engine is taken at its best.
constexpr Course courses[] = {{3, 0.1},       {5, 0.1},         {7, 0.1},
                              {10, 0.1},      {15, 1.0 / 15},   {30, 1.0 / 30},
                              {60, 1.0 / 60}, {240, 1.0 / 240}, {1000, 1.0 / 1000}};
constexpr double resting_speeds[] = {1e-1, 1e-3,
                                     1e-6};      // rad/s of a hinge at which a run ends, from loose to tight
constexpr double levels[] = {1e-3, 1e-4, 1e-6};  // cell edges, of hinge gap and error, from loose to tight
// s: finer settings after such a run cannot be the fastest, even where none before has met the tightest level.
constexpr double too_long = 1.5;
constexpr double far_slower = 4;  // times the fastest that met it: finer settings are slower still

/// A structure with a closed form and the hinge that both engines drive.
struct PeerScene {
  std::string name;
  model::Structure structure;
  model::Drive drive;
  model::State exact;
};

/// One setting of one engine.
struct PeerRun {
  std::string settings;
  double seconds = 0, gap = 0,
         error = 0;  ///< largest hinge gap and rms distance from the closed form, cell edges
  bool settled = false;
};

PeerScene scene_of(const std::string& name, const model::ExactDesign<double>& design,
                   const model::Structure& structure) {
  const model::Wall middle{{design.columns() / 2, design.rows() / 2}, model::Axis::y};
  return {name, structure, testing::hinge_drive(structure, middle, design.theta), fold(design, structure)};
}

PeerScene rib(int columns) {
  const Scene scene = regression_scenes()[1];
  model::Structure structure;
  const optim::FreeCurveDesign found = fitted_strip(scene, columns, structure);
  return scene_of(fmt::format("{}, {} columns", scene.name, columns), found.design.design, structure);
}

PeerScene sheet(int side) {
  model::ExactDesign<double> design;
  const model::Structure structure = arc(side, side, design);
  return scene_of(fmt::format("sheet that bends, {0} x {0} cells", side), design, structure);
}

/// Returns the median of five runs; a long one runs once.
template <class Runner>
PeerRun timed(const PeerScene& scene, const std::string& settings, const Runner& run) {
  auto result = run();
  std::vector<double> times = {result.seconds};
  for (int repeat = 1; repeat < 5 && result.seconds < 0.2; ++repeat) times.push_back(run().seconds);
  return {settings, median(std::move(times)), result.gaps.max,
          aligned_distance(scene.structure, result.state, scene.exact).rms,
          result.status == decltype(result)::Status::settled};
}

bool meets(const PeerRun& run, double level) { return run.settled && run.gap <= level && run.error <= level; }

/// Returns the fastest run whose hinges are closed and whose bodies are in place within `level`.
std::optional<PeerRun> fastest(const std::vector<PeerRun>& runs, double level) {
  std::optional<PeerRun> best;
  for (const PeerRun& run : runs)
    if (meets(run, level) && (!best || run.seconds < best->seconds)) best = run;
  return best;
}

/// Whether what is finer than the last run cannot be the fastest at any level.
bool is_over(const std::vector<PeerRun>& runs) {
  const auto best = fastest(runs, *std::rbegin(levels));
  return runs.back().seconds > (best ? far_slower * best->seconds : too_long);
}

std::vector<PeerRun> bullet_runs(const PeerScene& scene) {
  std::vector<PeerRun> runs;
  for (const Course& course : courses)
    for (const double rest : resting_speeds)
      for (const double stiffness : {1e4, 1e8}) {
        sim::PhysicsOptions options;
        options.step_s = course.step_s;
        options.drive_seconds = course.steps * course.step_s;
        options.joint_stiffness = stiffness;
        options.settle_speed = rest;
        options.contact = false;
        runs.push_back(
            timed(scene, fmt::format("{} steps, joint stiffness {:.0e}", course.steps, stiffness), [&] {
              return run_compression(scene.structure, drive_on(scene.structure, scene.drive), options);
            }));
        if (is_over(runs)) return runs;
      }
  return runs;
}

void add_mujoco_runs(const PeerScene& scene, MujocoSettings::Bodies bodies, std::vector<PeerRun>& runs) {
  for (const Course& course : courses)
    for (const double rest : resting_speeds)
      for (const int iterations : {2, 20})
        for (const auto integrator :
             {MujocoSettings::Integrator::euler, MujocoSettings::Integrator::implicit}) {
          MujocoSettings settings;
          settings.bodies = bodies;
          settings.integrator = integrator;
          settings.step_s = course.step_s;
          settings.drive_seconds = course.steps * course.step_s;
          settings.iterations = iterations;
          settings.settle_speed = rest;
          const std::string words = fmt::format(
              "{}, {} steps, {}",
              bodies == MujocoSettings::Bodies::tree ? "tree of hinge joints" : "free bodies", course.steps,
              integrator == MujocoSettings::Integrator::euler ? "Euler" : "implicit");
          runs.push_back(timed(scene, words, [&] {
            return run_mujoco(scene.structure, drive_on(scene.structure, scene.drive), settings);
          }));
          if (is_over(runs)) return;
        }
}

std::string describe(const std::optional<PeerRun>& run) {
  return run ? fmt::format("{:.3g} ms ({})", 1e3 * run->seconds, run->settings) : "does not get there";
}

Figure at_level(const PeerScene& scene, const std::vector<PeerRun>& bullet,
                const std::vector<PeerRun>& mujoco, double level) {
  const auto ours = fastest(bullet, level), theirs = fastest(mujoco, level);
  Figure figure{fmt::format("{}: Bullet against MuJoCo, hinge gap and error at most {:g} cell edges",
                            scene.name, level),
                "at most its time",
                {},
                ours && (!theirs || ours->seconds <= theirs->seconds)};
  if (ours && theirs)
    figure.measured = fmt::format("{:.2g} times the time: ", ours->seconds / theirs->seconds);
  figure.measured += fmt::format("Bullet {}, MuJoCo {}", describe(ours), describe(theirs));
  return figure;
}

}  // namespace

std::vector<Figure> mujoco_figures() {
  if (!has_mujoco())
    return {{"Bullet against MuJoCo", "at most its time", "not measured: MuJoCo is not installed", true}};
  std::vector<Figure> figures;
  for (const PeerScene& scene : {rib(10), rib(20), rib(40), sheet(5), sheet(10)}) {
    const std::vector<PeerRun> bullet = bullet_runs(scene);
    std::vector<PeerRun> mujoco;
    for (const auto bodies : {MujocoSettings::Bodies::tree, MujocoSettings::Bodies::free})
      add_mujoco_runs(scene, bodies, mujoco);
    for (const double level : levels) figures.push_back(at_level(scene, bullet, mujoco, level));
  }
  return figures;
}

}  // namespace kinetix::bench
