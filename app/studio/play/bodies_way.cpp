#include "app/studio/play/bodies_way.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/assembly/assembly_motion.hpp"
#include "model/assembly/crossing.hpp"
#include "model/base/angle.hpp"
#include "model/closure/closure_solver.hpp"

namespace kinetix::app::studio {
namespace {

constexpr double farthest = 178 * radians_per_degree;  // rad: beyond, half a turn either way looks alike
// mm: faces that slide on each other are off by less in files of floats
constexpr double touching_mm = 0.01;
constexpr double turn_window = 0.6;  // rad: a hand does not throw it through a fold; twice that of theta

using Pairs = std::vector<std::array<int, 2>>;

/// Pairs whose surfaces cross; only the first one, where `all` is false. @param but pairs that are not looked at
Pairs crossing_pairs(const model::Assembly& assembly, const model::State& state, const Pairs& but, bool all) {
  Pairs out;
  const int count = static_cast<int>(state.size());
  std::vector<model::Polyhedron> moved;
  std::vector<Eigen::AlignedBox3d> boxes(count);
  for (int b = 0; b < count; ++b) {
    moved.push_back(assembly.bodies[b].solid);
    for (Eigen::Vector3d& p : moved[b].points) {
      p = state[b].p + state[b].R * (p - assembly.bodies[b].position);
      boxes[b].extend(p);
    }
  }
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b) {
      if (!boxes[a].intersects(boxes[b])) continue;
      if (std::find(but.begin(), but.end(), std::array{a, b}) != but.end()) continue;
      if (!crossing(moved[a], moved[b], touching_mm)) continue;
      out.push_back({a, b});
      if (!all) return out;
    }
  return out;
}

/// Between two known states, closed.
model::State between_states(const model::Linkage& linkage, const BodiesWay& way, double turn) {
  std::size_t k = 1;
  while (k + 1 < way.turns.size() && way.turns[k] < turn) ++k;
  if (k >= way.turns.size()) return way.states.front();
  const double share = (turn - way.turns[k - 1]) / (way.turns[k] - way.turns[k - 1]);
  model::State out = way.states[k - 1];
  for (std::size_t b = 0; b < out.size(); ++b) {
    const model::Pose& to = way.states[k][b];
    out[b].p += share * (to.p - out[b].p);
    out[b].R = Eigen::Quaterniond(out[b].R).slerp(share, Eigen::Quaterniond(to.R)).toRotationMatrix();
  }
  return solve_closure(linkage, out, {}).state;
}

}  // namespace

BodiesWay way_at_rest(const model::Linkage& linkage, int hinge) {
  return {hinge, linkage.bodies[linkage.hinges[hinge].lower].sense, {rest_state(linkage)}, {0}};
}

BodiesWay way_of(const model::Linkage& linkage, int hinge, const std::optional<model::Pull>& pull,
                 const std::function<bool()>& stop) {
  BodiesWay way = way_at_rest(linkage, hinge);
  way.followed = true;
  way.pulled = pull.has_value();
  if (pull) {
    model::DeploymentOptions options;
    options.stop = stop;
    const model::Deployment found = deploy(linkage, *pull, options);
    const double end = 2 * mean_half_turn(linkage, found.states.back());
    way.states = found.states;
    way.turns.clear();
    for (const double share : found.shares) way.turns.push_back(share / found.shares.back() * end);
    return way;
  }
  model::AssemblyMotionOptions options;
  options.stop = stop;
  const model::FirstMotion first = first_motion(linkage);
  for (const int side : {0, 1}) {
    const model::AssemblyMotion found =
        follow_turn(linkage, first, hinge, side == 0 ? -farthest : farthest, options);
    way.opens[side] = found.broken;
    way.states.insert(way.states.end(), found.states.begin() + 1, found.states.end());
    way.turns.insert(way.turns.end(), found.turns.begin() + 1, found.turns.end());
    if (side == 1) break;
    std::reverse(way.states.begin(), way.states.end());
    std::reverse(way.turns.begin(), way.turns.end());
    way.rest = static_cast<int>(way.turns.size()) - 1;
  }
  return way;
}

std::optional<Meeting> first_meeting(const model::Assembly& assembly, const BodiesWay& way, int direction,
                                     const std::function<bool()>& stop) {
  const int count = static_cast<int>(way.states.size());
  const Pairs at_rest = crossing_pairs(assembly, way.states[way.rest], {}, true);
  for (int k = way.rest + direction; k >= 0 && k < count && !(stop && stop()); k += direction)
    if (const Pairs met = crossing_pairs(assembly, way.states[k], at_rest, false); !met.empty())
      return Meeting{way.turns[k], met.front()};
  return std::nullopt;
}

model::State state_at(const model::Linkage& linkage, const BodiesWay& way, double turn) {
  const double at = std::clamp(turn, way.turns.front(), way.turns.back());
  if (way.pulled) return between_states(linkage, way, at);
  const auto farther = [at](double a, double b) { return std::abs(a - at) < std::abs(b - at); };
  const auto nearest = std::min_element(way.turns.begin(), way.turns.end(), farther);
  const model::State& known = way.states[nearest - way.turns.begin()];
  if (*nearest == at) return known;
  return solve_closure(linkage, known, {model::HingeTurn{way.hinge, at}}).state;
}

double nearest_turn(const model::Linkage& linkage, const BodiesWay& way, double from, int body,
                    const Eigen::Vector3d& at, const Eigen::Vector3d& to) {
  const Eigen::Vector3d arm = at - linkage.rest_position(body);
  const auto place = [&](std::size_t k) {
    return Eigen::Vector3d(way.states[k][body].p + way.states[k][body].R * arm);
  };
  double best = from, least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < way.turns.size(); ++k) {
    const double a = way.turns[k], b = way.turns[k + 1];
    if (b < from - turn_window || a > from + turn_window) continue;
    const Eigen::Vector3d start = place(k), path = place(k + 1) - start;
    const double size = path.squaredNorm();
    const double share = size > 0 ? std::clamp((to - start).dot(path) / size, 0.0, 1.0) : 0;
    const double off = (start + share * path - to).squaredNorm();
    if (!(off < least)) continue;
    least = off;
    best = a + share * (b - a);
  }
  return best;
}

}  // namespace kinetix::app::studio
