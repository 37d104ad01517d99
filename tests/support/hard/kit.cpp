#include <algorithm>
#include <cmath>

#include "model/closure/closure.hpp"
#include "model/elastic/elastic_system.hpp"
#include "tests/support/hard/kit.hpp"

namespace kinetix::testing {
namespace {

using Mark = HardAnswer::Mark;

double fold_energy(const HardScene& scene, const model::State& state) {
  return energy_of({scene.structure, scene.drive, scene.elasticity, false}, state);
}

/// Force times this is energy by the drive's coordinate.
double travel(const HardScene& scene) {
  const auto* plates = std::get_if<model::Plates>(&scene.drive);
  if (!plates) return 1;
  const auto rows = gripped_bodies(scene.structure, plates->axis);
  const auto at = [&](int side) {
    const model::Vertex v = scene.structure.bodies[rows[side].front()];
    return plates->axis == model::Axis::x ? v.i : v.j;
  };
  return (at(1) - at(0)) * scene.structure.size.edge_mm;
}

/// Integrates the load over the drive by the trapezoidal rule.
double load_by_drive(const model::EquilibriumPath& path) {
  double sum = 0;
  for (std::size_t k = 1; k < path.steps.size(); ++k)
    sum +=
        (path.steps[k].load + path.steps[k - 1].load) / 2 * (path.steps[k].drive - path.steps[k - 1].drive);
  return sum;
}

struct EventCount {
  model::PathEvent::Kind kind;
  double theta;
  int more;
};

std::vector<EventCount> first_of_each_kind(const std::vector<model::PathEvent>& events) {
  std::vector<EventCount> counts;
  for (const model::PathEvent& event : events) {
    const auto same =
        std::find_if(counts.begin(), counts.end(), [&](const EventCount& t) { return t.kind == event.kind; });
    if (same == counts.end())
      counts.push_back({event.kind, event.at.theta, 0});
    else
      ++same->more;
  }
  return counts;
}

}  // namespace

model::Elasticity of_ratio(double ratio) {
  model::Elasticity elasticity;
  elasticity.k_turn = ratio * elasticity.k_point * 100;
  return elasticity;
}

model::EquilibriumPath followed(const HardScene& scene, model::EquilibriumPathOptions options) {
  options.contact = scene.contact;
  return trace_equilibrium(driven(scene.structure, scene.drive), scene.elasticity, options);
}

model::EquilibriumPath followed_finely(const HardScene& scene) {
  model::EquilibriumPathOptions options;
  options.longest_step = options.first_step = 0.005;
  return followed(scene, options);
}

double energy_of(const HardScene& scene, const model::State& state) {
  const model::ElasticSystem system(scene.structure, scene.elasticity, drive_on(scene.structure, scene.drive),
                                    false, scene.contact);
  return system.elastic_energy(state) * energy_unit(scene.elasticity, scene.structure.size.edge_mm);
}

double work_of(const HardScene& scene, const model::EquilibriumPath& path) {
  return load_by_drive(path) * travel(scene);
}

std::string describe_path(const model::EquilibriumPath& path, const std::string& found) {
  std::string all = text("%s: E %.4g N mm, gap %.1e", to_string(path.stop).c_str(), path.steps.back().energy,
                         path.gaps.max);
  for (const EventCount& event : first_of_each_kind(path.events)) {
    all += text(", %s at %.4g deg", to_string(event.kind).c_str(), to_degrees(event.theta));
    if (event.more > 0) all += text(" and %d more", event.more);
  }
  return found.empty() ? all : all + "; " + found;
}

HardAnswer answer(const model::EquilibriumPath& path, bool right, const std::string& found) {
  const bool stable = path.steps.back().stable;
  return {right && stable ? Mark::right : Mark::wrong, "no closed form", describe_path(path, found), {}};
}

HardAnswer answer(const HardScene& scene, const model::EquilibriumPath& path, bool right,
                  const std::string& found) {
  HardAnswer a = answer(path, right, found);
  a.settled = {scene.structure, scene.drive, scene.elasticity, scene.contact, path.planar, path.state};
  return a;
}

HardAnswer follow_closed_form(const HardScene& scene, double allowed) {
  const model::EquilibriumPath path = followed(scene);
  const double theta = scene.theta();
  const model::State exact = fold(classify(scene.structure), scene.structure, theta);
  const double error = aligned_distance(scene.structure, path.state, exact).rms;
  HardAnswer a = answer(scene, path, path.stop == model::EquilibriumPath::Stop::reached && error <= allowed,
                        text("rms %.1e from exact", error));
  a.exact = text("E %.4g N mm, gap %.1e", fold_energy(scene, exact), hinge_gaps(scene.structure, exact).max);
  return a;
}

HardCase closed_form_case(std::string name, std::function<HardScene()> scene, double allowed) {
  return {std::move(name), text("closed form, rms <= %.0e", allowed),
          [=] { return follow_closed_form(scene(), allowed); }};
}

HardAnswer follow_strained(const HardScene& scene, double allowed) {
  const model::EquilibriumPath path = followed_finely(scene);
  const double off = std::abs(work_of(scene, path) / path.steps.back().energy - 1);
  return answer(scene, path, path.stop == model::EquilibriumPath::Stop::reached && off <= allowed,
                text("work differs by %.1e", off));
}

model::EquilibriumPath followed(const LinkageScene& scene) {
  return trace_equilibrium(scene.driven, scene.elasticity, scene.options);
}

double work_of(const LinkageScene& scene, const model::EquilibriumPath& path) {
  const model::ElasticSystem system(scene.driven.linkage, scene.elasticity, scene.driven.drive, path.planar,
                                    false);
  return load_by_drive(path) * system.drive().travel(system.structure());
}

double turning_energy(const LinkageScene& scene, const model::State& state) {
  double sum = 0;
  for (std::size_t h = 0; h < scene.driven.linkage.hinges.size(); ++h) {
    const double turn = hinge_turn(scene.driven.linkage, state, static_cast<int>(h));
    sum += scene.elasticity.of(h).k_turn * turn * turn / 2;
  }
  return sum;
}

HardAnswer follow_strained(LinkageScene scene, double allowed) {
  scene.options.longest_step = scene.options.first_step = 0.005;
  const model::EquilibriumPath path = followed(scene);
  const double stored = path.steps.back().energy - path.steps.front().energy;
  const double off = std::abs(work_of(scene, path) / stored - 1);
  return answer(path, path.stop == model::EquilibriumPath::Stop::reached && off <= allowed,
                text("work differs by %.1e", off));
}

void check_branching(const LinkageScene& scene, const model::EquilibriumPath& path, HardAnswer& answer) {
  constexpr double other_motion = 0.1;  // rad of a hinge: springs of the cases bend a closed form by less
  if (!scene.driven.exact) return;
  const double off = turn_distance(scene.driven.linkage, path.state, scene.driven.exact.at(path.theta));
  if (off <= other_motion) return;
  if (!first_event(path, model::PathEvent::Kind::departure)) answer.mark = Mark::wrong;
  if (answer.mark == Mark::right) answer.mark = Mark::diagnosed;
}

namespace {

/// Distance of an equilibrium from its closed form.
struct Softened {
  model::EquilibriumPath path;
  double off = 0, missing = 0;  ///< rms, cell edges; energy, as a part of the closed form's
};

Softened softened(const LinkageScene& scene, double theta) {
  const model::State exact = scene.driven.exact.at(theta);
  Softened out{followed(scene)};
  out.off = aligned_distance(scene.driven.linkage, out.path.state, exact).rms;
  out.missing = 1 - out.path.steps.back().energy / turning_energy(scene, exact);
  return out;
}

bool is_ten(double ratio) { return std::abs(ratio / 10 - 1) <= 0.01; }

}  // namespace

HardAnswer follow_softly(const std::function<LinkageScene(double ratio)>& scene, double theta) {
  using Stop = model::EquilibriumPath::Stop;
  const LinkageScene of_soft = scene(1e-8);
  const Softened soft = softened(of_soft, theta), stiff = softened(scene(1e-9), theta);
  const bool right = soft.path.stop == Stop::reached && stiff.path.stop == Stop::reached &&
                     is_ten(soft.off / stiff.off) && is_ten(soft.missing / stiff.missing);
  HardAnswer a = answer(soft.path, right,
                        text("rms %.2e from exact, %.5g times as far; energy %.1e below, %.5g times as much",
                             soft.off, soft.off / stiff.off, soft.missing, soft.missing / stiff.missing));
  a.exact = text("E %.4g N mm", turning_energy(of_soft, of_soft.driven.exact.at(theta)));
  return a;
}

HardAnswer closed_to(double worst, double allowed, const std::string& what) {
  return {worst <= allowed ? Mark::right : Mark::wrong, text("%s %.1e", what.c_str(), worst), "not run", {}};
}

HardAnswer check_distinct(bool right, const std::string& exact, const std::string& found) {
  return {right ? Mark::diagnosed : Mark::wrong, exact, found, {}};
}

}  // namespace kinetix::testing
