#include "app/studio/play/shape.hpp"

#include <boost/math/tools/minima.hpp>

#include "app/files/bodies_section.hpp"
#include "app/pipeline/drive_loads.hpp"
#include "app/pipeline/physics.hpp"
#include "model/assembly/assembly_motion.hpp"
#include "model/assembly/shells.hpp"
#include "model/closure/drive_theta.hpp"

namespace kinetix::app::studio {
namespace {

constexpr double farthest = 178 * radians_per_degree;  // rad: near half a turn both directions look the same
// mm: sliding faces in files of floats may overlap by less
constexpr double touching_mm = 0.01;
constexpr double turn_window = 0.6;  // rad: limits a drag, which must not jump through a fold; twice theta's

using Pairs = std::vector<std::array<int, 2>>;

/// Finds pairs of bodies whose surfaces cross; only the first pair if `all` is false. @param but pairs to
/// skip
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

/// Interpolates between two known states and closes the hinges.
model::State between_states(const model::Linkage& linkage, const BodiesMotion& motion, double turn) {
  std::size_t k = 1;
  while (k + 1 < motion.turns.size() && motion.turns[k] < turn) ++k;
  if (k >= motion.turns.size()) return motion.states.front();
  const double share = (turn - motion.turns[k - 1]) / (motion.turns[k] - motion.turns[k - 1]);
  model::State out = motion.states[k - 1];
  for (std::size_t b = 0; b < out.size(); ++b) {
    const model::Pose& to = motion.states[k][b];
    out[b].p += share * (to.p - out[b].p);
    out[b].R = Eigen::Quaterniond(out[b].R).slerp(share, Eigen::Quaterniond(to.R)).toRotationMatrix();
  }
  return solve_closure(linkage, out, {}).state;
}

constexpr double largest_theta = 85 * radians_per_degree;  // rad: sheets with thick walls do not fold further
constexpr double theta_window = 0.3;  // rad: limits a drag, which must not jump through a fold
constexpr int theta_bits = 26;        // a minimum in doubles has no more significant bits

Eigen::Vector3d carried(const Moving& moving, double theta, int body, const Eigen::Vector3d& at) {
  const model::State state = moving.exact.at(theta);
  return state[body].p + state[body].R * (at - moving.linkage.rest_position(body));
}

/// Returns whether two bodies or hinges are equal except for stiffness.
bool is_same(const model::AssemblyBody& a, const model::AssemblyBody& b) {
  return a.position == b.position && a.solid.points == b.solid.points &&
         a.solid.triangles == b.solid.triangles;
}
bool is_same(const model::AssemblyHinge& a, const model::AssemblyHinge& b) {
  return a.lower == b.lower && a.upper == b.upper && a.point == b.point && a.axis == b.axis &&
         a.ball == b.ball;
}

Design turned_as_shown(Design design, const Moving& moving, double theta) {
  if (body_pull_of(design))
    throw InvalidInput(
        "at_fold: bodies of this design are pulled. Save it without at_fold, or turn one hinge");
  design.drive =
      model::HingeTurn{moving.motion->hinge, model::turn_at_theta(moving.motion->sense, theta) + 0.0};
  return design;
}

/// @pre the design has a drive
void end_drive_at(Design& design, double drive_theta) {
  design.drive = limited_to(drive_to(design, drive_theta), *design.drive);
}

}  // namespace

BodiesMotion motion_at_rest(const model::Linkage& linkage, int hinge) {
  return {hinge, linkage.bodies[linkage.hinges[hinge].lower].sense, {rest_state(linkage)}, {0}};
}

BodiesMotion motion_of(const model::Linkage& linkage, int hinge, const std::optional<model::Pull>& pull,
                       const std::function<bool()>& stop) {
  BodiesMotion motion = motion_at_rest(linkage, hinge);
  motion.followed = true;
  motion.pulled = pull.has_value();
  if (pull) {
    model::DeploymentOptions options;
    options.stop = stop;
    const model::Deployment found = deploy(linkage, *pull, options);
    const double end = 2 * mean_half_turn(linkage, found.states.back());
    motion.states = found.states;
    motion.turns.clear();
    for (const double share : found.shares) motion.turns.push_back(share / found.shares.back() * end);
    return motion;
  }
  model::AssemblyMotionOptions options;
  options.stop = stop;
  const model::FirstMotion first = first_motion(linkage);
  for (const int side : {0, 1}) {
    const model::AssemblyMotion found =
        follow_turn(linkage, first, hinge, side == 0 ? -farthest : farthest, options);
    motion.opens[side] = found.broken;
    motion.states.insert(motion.states.end(), found.states.begin() + 1, found.states.end());
    motion.turns.insert(motion.turns.end(), found.turns.begin() + 1, found.turns.end());
    if (side == 1) break;
    std::reverse(motion.states.begin(), motion.states.end());
    std::reverse(motion.turns.begin(), motion.turns.end());
    motion.rest = static_cast<int>(motion.turns.size()) - 1;
  }
  return motion;
}

std::optional<Collision> first_collision(const model::Assembly& assembly, const BodiesMotion& motion,
                                         int direction, const std::function<bool()>& stop) {
  const int count = static_cast<int>(motion.states.size());
  const Pairs at_rest = crossing_pairs(assembly, motion.states[motion.rest], {}, true);
  for (int k = motion.rest + direction; k >= 0 && k < count && !(stop && stop()); k += direction)
    if (const Pairs met = crossing_pairs(assembly, motion.states[k], at_rest, false); !met.empty())
      return Collision{motion.turns[k], met.front()};
  return std::nullopt;
}

model::State state_at(const model::Linkage& linkage, const BodiesMotion& motion, double turn) {
  const double at = std::clamp(turn, motion.turns.front(), motion.turns.back());
  if (motion.pulled) return between_states(linkage, motion, at);
  const auto farther = [at](double a, double b) { return std::abs(a - at) < std::abs(b - at); };
  const auto nearest = std::min_element(motion.turns.begin(), motion.turns.end(), farther);
  const model::State& known = motion.states[nearest - motion.turns.begin()];
  if (*nearest == at) return known;
  return solve_closure(linkage, known, {model::HingeTurn{motion.hinge, at}}).state;
}

double nearest_turn(const model::Linkage& linkage, const BodiesMotion& motion, double from, int body,
                    const Eigen::Vector3d& at, const Eigen::Vector3d& to) {
  const Eigen::Vector3d arm = at - linkage.rest_position(body);
  const auto place = [&](std::size_t k) {
    return Eigen::Vector3d(motion.states[k][body].p + motion.states[k][body].R * arm);
  };
  double best = from, least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < motion.turns.size(); ++k) {
    const double a = motion.turns[k], b = motion.turns[k + 1];
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

Moving::Moving(const Design& design) : linkage(design.structure), exact(exact_motion(design.structure)) {
  if (design.structure.assembly()) {
    bodies = std::make_shared<const Design>(design);
    const model::HingeTurn* turn = turn_of(design);
    const int hinge = turn && turn->hinge >= 0 ? turn->hinge : std::max(0, first_motion(linkage).fastest);
    take(std::make_shared<BodiesMotion>(motion_at_rest(linkage, hinge)));
    return;
  }
  if (!exact) {
    nearest = nearest_design(design.structure);
    return;
  }
  const model::ContactRange range = theta_range(linkage, exact);
  min_theta = range.negative.touches ? range.negative.theta : -largest_theta;
  max_theta = range.positive.touches ? range.positive.theta : largest_theta;
}

void Moving::take(std::shared_ptr<const BodiesMotion> found) {
  motion = std::move(found);
  const auto [low, high] = std::minmax({model::theta_at_turn(motion->sense, motion->turns.front()),
                                        model::theta_at_turn(motion->sense, motion->turns.back())});
  min_theta = low;
  max_theta = high;
  exact = {[of = linkage, motion = motion](double theta) {
             return state_at(of, *motion, model::turn_at_theta(motion->sense, theta));
           },
           "none", ""};
}

void Moving::keep(const Moving& before) {
  if (!have_same_shape(bodies.get(), before.bodies.get())) return;
  parts = before.parts;
  pressing = before.pressing;
  if (motion->hinge == before.motion->hinge && !body_pull_of(*bodies) == !body_pull_of(*before.bodies))
    take(before.motion);
}

bool have_same_shape(const Design* a, const Design* b) {
  if (a == b || !a || !b) return a && b;
  const model::Assembly &p = *a->structure.assembly(), &q = *b->structure.assembly();
  const auto same = [](const auto& x, const auto& y) { return is_same(x, y); };
  return std::equal(p.bodies.begin(), p.bodies.end(), q.bodies.begin(), q.bodies.end(), same) &&
         std::equal(p.hinges.begin(), p.hinges.end(), q.hinges.begin(), q.hinges.end(), same);
}

double requested_theta(const Design& design, const Moving& moving) {
  if (!moving.bodies) return design.theta;
  const model::HingeTurn* turn = turn_of(design);
  return turn ? model::theta_at_turn(moving.motion->sense, turn->angle) : 0;
}

double Moving::within(double theta) const { return bodies ? std::clamp(theta, min_theta, max_theta) : theta; }

double Moving::theta_of(const model::State& state) const {
  if (!bodies) return model::mean_theta(linkage, state);
  return model::theta_at_turn(motion->sense, hinge_turn(linkage, state, motion->hinge));
}

model::LinkageDrive Moving::turned(double theta) const {
  if (motion->pulled)
    throw InvalidInput("theta: bodies of this design are pulled. Drag them in the simulation");
  return model::turned_hinge(motion->hinge, motion->sense,
                             model::turn_at_theta(motion->sense, within(theta)));
}

double nearest_theta(const Moving& moving, double from, int body, const Eigen::Vector3d& at,
                     const Eigen::Vector3d& to) {
  if (moving.bodies) {
    const int sense = moving.motion->sense;
    const double turn = model::turn_at_theta(sense, from);
    return model::theta_at_turn(sense, nearest_turn(moving.linkage, *moving.motion, turn, body, at, to));
  }
  const auto miss = [&](double theta) { return (carried(moving, theta, body, at) - to).squaredNorm(); };
  const double low = std::max(from - theta_window, moving.min_theta);
  const double high = std::min(from + theta_window, moving.max_theta);
  if (!(low < high)) return from;
  const auto [theta, least] = boost::math::tools::brent_find_minima(miss, low, high, theta_bits);
  return least < miss(from) ? theta : from;
}

model::LinkageDrive drive_to(const Design& design, double theta) {
  return design.drive ? drive_of(design).to(theta) : drive_to(design.structure, theta);
}

Design design_at_shown_fold(Design design, const Moving& moving, double sheet_theta, double drive_theta) {
  if (moving.bodies) return turned_as_shown(std::move(design), moving, sheet_theta);
  if (sheet_theta == 0) return design;
  if (moving.exact)
    design.drive.reset();
  else if (design.drive)
    end_drive_at(design, drive_theta);
  design.theta = sheet_theta;
  return design;
}

Design design_for_saving(Design design, const Moving& moving, double sheet_theta, double drive_theta) {
  if (moving.bodies) return turned_as_shown(std::move(design), moving, sheet_theta);
  if (design.drive && sheet_theta != 0) end_drive_at(design, drive_theta);
  // A design without exact motion is opened by its drive, whose theta can differ from the sheet's.
  design.theta = moving.exact ? sheet_theta : drive_theta;
  return design;
}

std::unique_ptr<sim::LiveSheet> live_sheet(const Design& design, const Moving& moving, bool springs) {
  const model::Linkage& linkage = moving.linkage;
  Design as = design;
  as.hinge.model = springs ? HingeSection::Model::elastic : HingeSection::Model::rotary;
  sim::PhysicsOptions options = physics_of(as, all_vertical(linkage));
  options.planar = !moving.bodies && all_vertical(linkage);
  options.step_s = live_step_s;
  const double k_point = springs ? elasticity_of(as).k_point : 1;
  return std::make_unique<sim::LiveSheet>(linkage, options, k_point, moving.parts);
}

}  // namespace kinetix::app::studio
