#include "optim/ribs/fit_layout.hpp"

#include <algorithm>
#include <cmath>

#include "optim/ribs/ribs_collisions.hpp"
#include "optim/solvers/arrow_solver.hpp"

namespace kinetix::optim {
namespace {

using Eigen::Vector3d;

constexpr int most_trims = 30;  // fits with shortened ribs: remaining collisions are reported
/// Fractions of the tilt limit, tried in turn if walls meet with the whole limit.
constexpr double tilt_parts[] = {0.6, 0.4, 0.25};
// Steps of Newton's method towards the curve, each of which about squares the error.
constexpr int steps_in_plane = 6;

/// Returns the distance of p from the curve at the clearance, in the plane through p normal to `along`.
double distance_in_plane(const targets::MeshDistance& surface, const Vector3d& p, const Vector3d& along,
                         double clearance) {
  Vector3d q = p;
  for (int k = 0; k < steps_in_plane; ++k) {
    const targets::ClosestMeshPoint closest = surface.closest(q);
    const Vector3d slope = closest.normal - along.dot(closest.normal) * along;
    if (!(slope.squaredNorm() > 1e-4)) break;
    q -= (closest.distance - clearance) / slope.squaredNorm() * slope;
  }
  return (q - p).norm();
}

double rib_error(const model::Fishbone& fishbone, const model::FishboneRib& rib, const model::State& state,
                 const targets::MeshDistance& surface, double clearance) {
  const auto columns = rib_columns(fishbone, rib);
  double sum = 0;
  for (const auto& [lower, upper] : columns) {
    const Vector3d &a = state[lower].p, &b = state[upper].p;
    sum += std::pow(distance_in_plane(surface, (a + b) / 2, (b - a).normalized(), clearance), 2);
  }
  return std::sqrt(sum / static_cast<double>(columns.size()));
}

/// Returns the shape for a fishbone with shortened ribs.
RibsShape cut_to(RibsShape shape, const model::FishboneLayout& spine_and_ribs) {
  for (std::size_t r = 0; r < spine_and_ribs.ribs.size(); ++r)
    for (const int side : {0, 1}) shape.ribs[r][side].resize(spine_and_ribs.ribs[r].cells[side]);
  return shape;
}

RibsDesign fit_with_limit(const targets::MeshDistance& surface, const Vector3d& crown, const RibsSpec& spec,
                          const SolverOptions& options, RibsLayout layout, double tilt) {
  RibsShape shape = layout.start;
  for (int trims = 0, trimmed = 0;; ++trims) {
    model::Fishbone fishbone = make_fishbone(layout.spine_and_ribs, spec.size);
    const RibsProblem problem(fishbone, ribs_goal(layout, surface, crown, spec), tilt, spec.theta);
    SolveResult search = solve(problem, problem.pack(shape), options);
    shape = problem.unpack(search.x);
    model::State state = problem.state(search.x);
    fishbone.structure = problem.structure(search.x);
    const RibsCollisions collisions(fishbone, shape.theta);
    const int taken =
        trims < most_trims && !options.stop.stop_requested() ? collisions.trim(layout.spine_and_ribs) : 0;
    trimmed += taken;
    if (taken == 0) {
      RibsError error = ribs_error(fishbone, state, surface, spec.clearance_mm);
      return {std::move(layout),
              std::move(fishbone),
              std::move(shape),
              std::move(state),
              std::move(error),
              std::move(search),
              tilt,
              trimmed,
              collisions.in_words()};
    }
    shape = cut_to(std::move(shape), layout.spine_and_ribs);
  }
}

}  // namespace

RibsGoal ribs_goal(const RibsLayout& layout, const targets::MeshDistance& surface, const Vector3d& crown,
                   const RibsSpec& spec) {
  return {&surface, spec.clearance_mm, layout.rim_z, crown.x()};
}

RibsError ribs_error(const model::Fishbone& fishbone, const model::State& state,
                     const targets::MeshDistance& surface, double clearance_mm) {
  RibsError error;
  double sum = 0;
  for (const model::Pose& pose : state) {
    const double apart = surface.closest(pose.p).distance - clearance_mm;
    error.of_body.push_back(apart);
    sum += apart * apart;
    if (!(std::abs(apart) <= error.max)) error.max = std::abs(apart);
  }
  error.rms = std::sqrt(sum / static_cast<double>(state.size()));
  for (const model::FishboneRib& rib : fishbone.layout.ribs)
    error.of_ribs.push_back(rib_error(fishbone, rib, state, surface, clearance_mm));
  return error;
}

model::State placed_fishbone(const model::Fishbone& fishbone, const RibsShape& shape, double theta) {
  const model::Structure& structure = fishbone.structure;
  return placed(fold_net(make_net_tree(structure, fishbone.middle), structure, theta), fishbone.middle,
                shape.turn, shape.place);
}

RibsDesign fit_layout(const RibsLayout& layout, const targets::MeshDistance& surface, const Vector3d& crown,
                      const RibsSpec& spec, const SolverOptions& options) {
  RibsDesign first = fit_with_limit(surface, crown, spec, options, layout, spec.tilt);
  if (first.collisions.empty()) return first;
  for (const double part : tilt_parts) {
    if (options.stop.stop_requested()) break;
    RibsDesign gentler = fit_with_limit(surface, crown, spec, options, layout, part * spec.tilt);
    if (gentler.collisions.empty()) return gentler;
  }
  return first;
}

}  // namespace kinetix::optim
