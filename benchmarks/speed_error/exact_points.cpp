#include "benchmarks/speed_error/exact_points.hpp"

#include "benchmarks/stopwatch.hpp"

namespace kinetix::bench {
namespace {

constexpr int repeats = 21;  // an odd number, so that one of them is the median
// Bodies posed in each repeat: about a millisecond, which the clock resolves, whatever the sheet.
constexpr int bodies_per_repeat = 40'000;

template <class To, class From>
std::vector<To> converted(const std::vector<From>& values) {
  return {values.begin(), values.end()};
}

model::ExactDesign<long double> in_long_double(const model::ExactDesign<double>& d) {
  return {converted<long double>(d.beta), converted<long double>(d.t), converted<long double>(d.s), d.gamma,
          d.theta};
}

/// @pre the sheet folds along x and fills its rectangle, as all of the scenes do
model::State folded_in_long_double(const SpeedErrorScene& scene) {
  model::ExactDesign<double> design = scene.family.design;
  design.theta = drive_on(scene.structure, scene.drive).theta();
  std::vector<model::PoseOf<long double>> poses;
  fold(in_long_double(design), scene.structure.size.edge_mm, poses);
  model::State state;
  for (const auto& pose : poses) state.push_back({pose.R.cast<double>(), pose.p.cast<double>()});
  return state;
}

model::State folded_from_the_last_body(const SpeedErrorScene& scene) {
  const int last = static_cast<int>(scene.structure.bodies.size()) - 1;
  return fold_net(make_net_tree(scene.structure, last), scene.structure,
                  drive_on(scene.structure, scene.drive).theta());
}

/// Times a state as a search computes it, repeatedly for one structure, s.
double seconds_per_state(const SpeedErrorScene& scene) {
  const int calls = std::max(1, bodies_per_repeat / static_cast<int>(scene.structure.bodies.size()));
  const double theta = drive_on(scene.structure, scene.drive).theta(), edge_mm = scene.structure.size.edge_mm;
  model::State state;
  if (scene.family.family == model::Family::F4)
    return median_seconds(repeats, calls,
                          [&] { state = fold_net(scene.family.tree, scene.structure, theta); });
  model::ExactDesign<double> design = scene.family.design;
  design.theta = theta;
  return median_seconds(repeats, calls, [&] { fold(design, edge_mm, state); });
}

}  // namespace

double rounding_error(const SpeedErrorScene& scene) {
  const model::State other = scene.family.family == model::Family::F4 ? folded_from_the_last_body(scene)
                                                                      : folded_in_long_double(scene);
  return aligned_distance(scene.structure, other, scene.reference).rms;
}

MeasuredPoints exact_points(const SpeedErrorScene& scene) {
  if (!scene.is_exact()) return {};
  return {{.method = "exact",
           .settings = "closed form",
           .precision = "double",
           .seconds = seconds_per_state(scene),
           .error = scene.reference_error,
           .status = to_string(scene.family.family),
           .is_result = true}};
}

}  // namespace kinetix::bench
