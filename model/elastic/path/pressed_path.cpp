#include "model/elastic/path/pressed_path.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace kinetix::model {
namespace {

// Of active sets: rows of 13 to 21 bodies take two to four.
constexpr int most_paths = 20;
// Part of the largest force of a plate on a body: a smaller pull is what Newton's method leaves.
constexpr double no_pull = 1e-6;
// Cell edges: a body that is no further behind its plate is on it, but for rounding.
constexpr double on_plate = 1e-12;

/// Of one coordinate of the bodies that plates push.
struct Pushing {
  const ElasticSystem& system;
  const State& state;
  Eigen::VectorXd gradient;
  double distance = 0;  ///< of the plates from the middle between them, cell edges
  double middle = 0;    ///< cell edges

  int axis() const { return system.drive().axis == Axis::x ? 0 : 1; }
  static double inward(int side) { return side == 0 ? 1 : -1; }
  /// k_point edge: what holds a body where it is, counted away from the plate.
  double force(int side, int body) const { return inward(side) * gradient[6 * body + 3 + axis()]; }
  /// Cell edges.
  double behind(int side, int body) const {
    const double plate = middle - inward(side) * distance;
    return inward(side) * (plate - state[body].p[axis()] / system.structure().size.edge_mm);
  }
};

Pushing pushing(const GrippedRows& rows, const ElasticSystem& system, const State& state, double theta) {
  Pushing out{system, state, system.elastic_gradient(state)};
  const auto place = [&](int side) {
    return system.structure().bodies[rows[side].front()].position[out.axis()];
  };
  out.middle = (place(0) + place(1)) / 2;
  out.distance = (place(1) - place(0)) / 2 * std::cos(theta);
  return out;
}

double largest_force(const Pushing& plates, const GrippedRows& held) {
  double largest = 0;
  for (const int side : {0, 1})
    for (const int body : held[side]) largest = std::max(largest, std::abs(plates.force(side, body)));
  return largest;
}

EquilibriumPath not_found(EquilibriumPath path, const std::string& why) {
  path.stop = EquilibriumPath::Stop::not_converged;
  path.why = "plates that press without gripping: " + why;
  return path;
}

using Seen = std::vector<std::pair<EquilibriumStep, State>>;

EquilibriumPath trace_seen(const DrivenLinkage& driven, const Elasticity& elasticity,
                           const EquilibriumPathOptions& options, Seen& seen) {
  seen.clear();
  return trace_equilibrium(
      driven, elasticity, options,
      [&](const EquilibriumStep& step, const State& state) { seen.emplace_back(step, state); });
}

}  // namespace

GrippedRows pushed_rows(const GrippedRows& rows, const ElasticSystem& system, const State& state,
                        double theta) {
  const Pushing plates = pushing(rows, system, state, theta);
  const GrippedRows& held = system.gripped();
  const double least = -no_pull * largest_force(plates, held);
  GrippedRows out;
  for (const int side : {0, 1})
    for (const int body : rows[side]) {
      const bool is_held = std::find(held[side].begin(), held[side].end(), body) != held[side].end();
      const bool is_pushed =
          is_held ? plates.force(side, body) >= least : plates.behind(side, body) > on_plate;
      if (is_pushed) out[side].push_back(body);
    }
  return out;
}

EquilibriumPath trace_pressed(const DrivenLinkage& driven, const Elasticity& elasticity,
                              const EquilibriumPathOptions& options,
                              const std::function<void(const EquilibriumStep&, const State&)>& frame) {
  DrivenLinkage now = driven;
  now.drive.press = false;
  Seen seen;
  EquilibriumPath path;
  for (int k = 0; k < most_paths; ++k) {
    path = trace_seen(now, elasticity, options, seen);
    const ElasticSystem system(now.linkage, elasticity, now.drive, path.planar, options.contact);
    GrippedRows pushed = pushed_rows(driven.drive.gripped, system, path.state, path.theta);
    if (path.stop != EquilibriumPath::Stop::reached || pushed == now.drive.gripped) {
      for (const auto& [step, state] : seen)
        if (frame) frame(step, state);
      return path;
    }
    if (pushed[0].size() < 2 || pushed[1].size() < 2)
      return not_found(std::move(path), "at most one body of a row is pushed, so that the structure would turn");
    now.drive.gripped = std::move(pushed);
  }
  return not_found(std::move(path), "no bodies were found that the plates push and never pull");
}

}  // namespace kinetix::model
