#include "tests/support/hard/kit.hpp"

#include <algorithm>
#include <cmath>

#include "model/elastic/elastic_system.hpp"

namespace kinetix::testing {
namespace {

using Mark = HardAnswer::Mark;

double fold_energy(const HardScene& scene, const model::State& state) {
  return energy_of({scene.structure, scene.drive, scene.elasticity, false}, state);
}

/// Force times this is energy by the drive's coordinate.
double travel(const HardScene& scene) {
  if (scene.drive.kind == model::Drive::Kind::hinge) return 1;
  const auto rows = gripped_bodies(scene.structure, scene.drive.axis);
  const auto at = [&](int side) {
    const model::Vertex v = scene.structure.bodies[rows[side].front()];
    return scene.drive.axis == model::Axis::x ? v.i : v.j;
  };
  return (at(1) - at(0)) * scene.structure.size.edge_mm;
}

struct Told {
  model::PathEvent::Kind kind;
  double theta;
  int more;
};

std::vector<Told> first_of_each_kind(const std::vector<model::PathEvent>& events) {
  std::vector<Told> told;
  for (const model::PathEvent& event : events) {
    const auto same =
        std::find_if(told.begin(), told.end(), [&](const Told& t) { return t.kind == event.kind; });
    if (same == told.end())
      told.push_back({event.kind, event.at.theta, 0});
    else
      ++same->more;
  }
  return told;
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
  const model::ElasticSystem system(scene.structure, scene.elasticity, scene.drive.on(scene.structure), false,
                                    scene.contact);
  return system.elastic_energy(state) * energy_unit(scene.elasticity, scene.structure.size.edge_mm);
}

double work_of(const HardScene& scene, const model::EquilibriumPath& path) {
  double sum = 0;
  for (std::size_t k = 1; k < path.steps.size(); ++k)
    sum +=
        (path.steps[k].load + path.steps[k - 1].load) / 2 * (path.steps[k].drive - path.steps[k - 1].drive);
  return sum * travel(scene);
}

std::string told(const model::EquilibriumPath& path, const std::string& found) {
  std::string all = text("%s: E %.4g N mm, gap %.1e", to_string(path.stop).c_str(), path.steps.back().energy,
                         path.gaps.max);
  for (const Told& event : first_of_each_kind(path.events)) {
    all += text(", %s at %.4g deg", to_string(event.kind).c_str(), to_degrees(event.theta));
    if (event.more > 0) all += text(" and %d more", event.more);
  }
  return found.empty() ? all : all + "; " + found;
}

HardAnswer answer(const HardScene& scene, const model::EquilibriumPath& path, bool right,
                  const std::string& found) {
  const bool stable = path.steps.back().stable;
  return {right && stable ? Mark::right : Mark::wrong, "no closed form", told(path, found),
          HardEquilibrium{scene.structure, scene.drive, scene.elasticity, scene.contact, path.planar,
                          path.state}};
}

HardAnswer follow_closed_form(const HardScene& scene, double allowed) {
  const model::EquilibriumPath path = followed(scene);
  const double theta = scene.drive.theta();
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

}  // namespace kinetix::testing
