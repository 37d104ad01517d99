#include "app/studio/play/bodies_way.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "model/assembly/crossing.hpp"
#include "model/base/angle.hpp"
#include "model/closure/closure_solver.hpp"

namespace kinetix::app::studio {
namespace {

constexpr double farthest = 178 * radians_per_degree;  // rad: beyond, half a turn either way looks alike
// mm: faces that slide on each other are off by less in files of floats
constexpr double touching_mm = 0.01;
constexpr double turn_window = 0.6;  // rad: a hand does not throw it through a fold; twice that of theta

/// Of the known states, by rising turn.
struct KnownState {
  double turn;  ///< rad
  const model::State* state;
};

std::vector<KnownState> known_states(const BodiesWay& way) {
  std::vector<KnownState> out;
  for (std::size_t k = way.back.states.size(); k-- > 1;)
    out.push_back({way.back.turns[k], &way.back.states[k]});
  for (std::size_t k = 0; k < way.forth.states.size(); ++k)
    out.push_back({way.forth.turns[k], &way.forth.states[k]});
  return out;
}

model::Polyhedron moved_solid(const model::AssemblyBody& body, const model::Pose& pose) {
  model::Polyhedron out = body.solid;
  for (Eigen::Vector3d& p : out.points) p = pose.p + pose.R * (p - body.position);
  return out;
}

double reach_of(const model::AssemblyBody& body) {
  double reach = 0;
  for (const Eigen::Vector3d& p : body.solid.points) reach = std::max(reach, (p - body.position).norm());
  return reach;
}

using Pairs = std::vector<std::array<int, 2>>;

/// Pairs whose surfaces cross; only the first one, where `all` is false. @param but pairs that are not looked at
Pairs crossing_pairs(const model::Assembly& assembly, const std::vector<double>& reach,
                     const model::State& state, const Pairs& but, bool all) {
  Pairs out;
  const int count = static_cast<int>(state.size());
  std::vector<model::Polyhedron> moved;
  for (int b = 0; b < count; ++b) moved.push_back(moved_solid(assembly.bodies[b], state[b]));
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b) {
      if ((state[a].p - state[b].p).norm() > reach[a] + reach[b]) continue;
      if (std::find(but.begin(), but.end(), std::array{a, b}) != but.end()) continue;
      if (!crossing(moved[a], moved[b], touching_mm)) continue;
      out.push_back({a, b});
      if (!all) return out;
    }
  return out;
}

/// Between two known states, closed.
model::State between_states(const model::Linkage& linkage, const model::AssemblyMotion& side, double turn) {
  std::size_t k = 1;
  while (k + 1 < side.turns.size() && std::abs(side.turns[k]) < std::abs(turn)) ++k;
  if (k >= side.turns.size()) return side.states.front();
  const double share = (turn - side.turns[k - 1]) / (side.turns[k] - side.turns[k - 1]);
  model::State out = side.states[k - 1];
  for (std::size_t b = 0; b < out.size(); ++b) {
    const model::Pose& to = side.states[k][b];
    out[b].p += share * (to.p - out[b].p);
    out[b].R = Eigen::Quaterniond(out[b].R).slerp(share, Eigen::Quaterniond(to.R)).toRotationMatrix();
  }
  return solve_closure(linkage, out, {}).state;
}

}  // namespace

BodiesWay way_at_rest(const model::Linkage& linkage, int hinge) {
  const model::AssemblyMotion rest{{rest_state(linkage)}, {0}};
  return {hinge, linkage.bodies[linkage.hinges[hinge].lower].sense, rest, rest};
}

BodiesWay way_of(const model::Linkage& linkage, int hinge, const std::optional<model::Pull>& pull,
                 const std::function<bool()>& stop) {
  BodiesWay way = way_at_rest(linkage, hinge);
  way.followed = true;
  way.pulled = pull.has_value();
  if (!pull) {
    model::AssemblyMotionOptions options;
    options.stop = stop;
    const model::FirstMotion first = first_motion(linkage);
    way.forth = follow_turn(linkage, first, hinge, farthest, options);
    way.back = follow_turn(linkage, first, hinge, -farthest, options);
    return way;
  }
  model::DeploymentOptions options;
  options.stop = stop;
  const model::Deployment found = deploy(linkage, *pull, options);
  const double end = 2 * mean_half_turn(linkage, found.states.back());
  way.forth.states = found.states;
  way.forth.turns.clear();
  for (const double share : found.shares) way.forth.turns.push_back(share / found.shares.back() * end);
  return way;
}

std::optional<Meeting> first_meeting(const model::Assembly& assembly, const model::AssemblyMotion& side,
                                     const std::function<bool()>& stop) {
  std::vector<double> reach;
  for (const model::AssemblyBody& body : assembly.bodies) reach.push_back(reach_of(body));
  const Pairs at_rest = crossing_pairs(assembly, reach, side.states.front(), {}, true);
  for (std::size_t k = 1; k < side.states.size() && !(stop && stop()); ++k)
    if (const Pairs met = crossing_pairs(assembly, reach, side.states[k], at_rest, false); !met.empty())
      return Meeting{side.turns[k], met.front()};
  return std::nullopt;
}

model::State state_at(const model::Linkage& linkage, const BodiesWay& way, double turn) {
  const double at = std::clamp(turn, way.least_turn(), way.most_turn());
  const model::AssemblyMotion& side = at < 0 ? way.back : way.forth;
  if (way.pulled) return between_states(linkage, side, at);
  const auto farther = [at](double a, double b) { return std::abs(a - at) < std::abs(b - at); };
  const auto nearest = std::min_element(side.turns.begin(), side.turns.end(), farther);
  const model::State& known = side.states[nearest - side.turns.begin()];
  if (*nearest == at) return known;
  return solve_closure(linkage, known, {model::HingeTurn{way.hinge, at}}).state;
}

double nearest_turn(const model::Linkage& linkage, const BodiesWay& way, double from, int body,
                    const Eigen::Vector3d& at, const Eigen::Vector3d& to) {
  const Eigen::Vector3d arm = at - linkage.rest_position(body);
  const auto place = [&](const KnownState& k) {
    return Eigen::Vector3d((*k.state)[body].p + (*k.state)[body].R * arm);
  };
  const std::vector<KnownState> known = known_states(way);
  double best = from, least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < known.size(); ++k) {
    const KnownState &a = known[k], &b = known[k + 1];
    if (b.turn < from - turn_window || a.turn > from + turn_window) continue;
    const Eigen::Vector3d start = place(a), path = place(b) - start;
    const double size = path.squaredNorm();
    const double share = size > 0 ? std::clamp((to - start).dot(path) / size, 0.0, 1.0) : 0;
    const double off = (start + share * path - to).squaredNorm();
    if (!(off < least)) continue;
    least = off;
    best = a.turn + share * (b.turn - a.turn);
  }
  return best;
}

}  // namespace kinetix::app::studio
