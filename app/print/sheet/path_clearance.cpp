#include "app/print/sheet/path_clearance.hpp"

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

#include <cmath>
#include <map>
#include <memory>

#include "model/base/parallel_runs.hpp"
#include "model/contact/near_pairs.hpp"

namespace kinetix::app {
namespace {

using Eigen::Vector3d;

constexpr double polygon_mm = 0.01;  // mm: by which polygons differ from their circles
constexpr double nothing_mm = 1e3;   // mm: where there are no two bodies
constexpr double first_rad = 2e-3;   // rad: 0.1 degrees, as messages say it

btVector3 to_bullet(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Vector3d from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

btTransform to_bullet(const model::Pose& pose) {
  const Eigen::Matrix3d& R = pose.R;
  const btMatrix3x3 turn(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2));
  return btTransform(turn, to_bullet(pose.p));
}

/// A convex piece with its support function.
struct Shape {
  int part;
  std::unique_ptr<btConvexHullShape> hull;
  Vector3d center;    // mm, in the part
  double radius = 0;  // mm, about the center
};

Shape shape_of(int part, const std::vector<Vector3d>& corners) {
  Shape shape{part, std::make_unique<btConvexHullShape>(), Vector3d::Zero()};
  for (const Vector3d& p : corners) {
    shape.hull->addPoint(to_bullet(p), false);
    shape.center += p / static_cast<double>(corners.size());
  }
  shape.hull->setMargin(0);
  shape.hull->recalcLocalAabb();
  for (const Vector3d& p : corners) shape.radius = std::max(shape.radius, (p - shape.center).norm());
  return shape;
}

double clearance_of(const model::HingePrint& hinge) {
  return hinge.made.kind == model::HingeKind::pin ? hinge.made.clearance_mm : 0;
}

PathClearance nothing_near() {
  PathClearance none;
  none.in_hinges.mm = none.elsewhere.mm = none.nearest.mm = none.flat_mm = nothing_mm;
  return none;
}

void take_less(const LeastDistance& other, LeastDistance& known) {
  if (other.spare_mm() < known.spare_mm()) known = other;
}

void take_nearer(const LeastDistance& other, LeastDistance& known) {
  if (other.mm < known.mm) known = other;
}

class Distances {
 public:
  explicit Distances(const PrintSheet& sheet)
      : sheet_(sheet), bodies_(static_cast<int>(sheet.bodies.size())), asked_(bodies_, nothing_mm) {
    for (int b = 0; b < bodies_; ++b) {
      if (sheet.bodies[b].arms.empty()) continue;
      for (const model::ConvexPiece& piece : convex_pieces(sheet.bodies[b]))
        if (!piece.is_rod) rigid_.push_back(shape_of(b, piece.corners));
    }
    for (int h = 0; h < hinges(); ++h) {
      const model::RestHinge& hinge = sheet.linkage.hinges[h];
      const double clearance = clearance_of(sheet.hinges[h]);
      hinged_[std::minmax(hinge.lower, hinge.upper)] = clearance;
      if (clearance > 0)
        for (const int b : {hinge.lower, hinge.upper}) asked_[b] = std::min(asked_[b], clearance);
    }
  }

  /// In one state.
  PathClearance measured(double theta, const model::State& state) const {
    PathClearance least = nothing_near();
    const std::vector<Shape> soft = soft_shapes(state);
    std::vector<const Shape*> all;
    for (const std::vector<Shape>* shapes : {&rigid_, &soft})
      for (const Shape& shape : *shapes) all.push_back(&shape);
    Eigen::Matrix3Xd centers(3, all.size());
    double reach = 0;  // mm
    for (std::size_t k = 0; k < all.size(); ++k) {
      const model::Pose pose = pose_of(*all[k], state);
      centers.col(k) = pose.R * all[k]->center + pose.p;
      reach = std::max(reach, 2 * all[k]->radius + 1);
    }
    model::NearPairs near;
    for (const auto& [a, b] : near.find(centers, reach)) {
      const Shape &one = *all[a], &other = *all[b];
      if (one.part == other.part || is_own(one.part, other.part) || is_own(other.part, one.part)) continue;
      const auto hinge = hinged_.find(std::minmax(one.part, other.part));
      LeastDistance& known = hinge == hinged_.end() ? least.elsewhere : least.in_hinges;
      const double asked = hinge == hinged_.end() ? asked_elsewhere(one.part, other.part) : hinge->second;
      LeastDistance found{(centers.col(a) - centers.col(b)).norm() - one.radius - other.radius,
                          one.part,
                          other.part,
                          theta,
                          Vector3d::Zero(),
                          asked};
      if (!(found.spare_mm() < known.spare_mm() || found.mm < least.nearest.mm)) continue;
      found = compared(one, other, state, found);
      take_less(found, known);
      take_nearer(found, least.nearest);
    }
    for (int h = 0; h < hinges(); ++h) compare_bore(h, theta, state, least);
    least.flat_mm = least.nearest.mm;
    return least;
  }

 private:
  int hinges() const { return static_cast<int>(sheet_.hinges.size()); }

  /// Where their corners are in a state.
  std::vector<Shape> soft_shapes(const model::State& state) const {
    std::vector<Shape> out;
    for (int h = 0; h < static_cast<int>(sheet_.soft.size()); ++h)
      if (!sheet_.soft[h].points.empty())
        out.push_back(shape_of(bodies_ + h, placed_soft(sheet_, state, h).points));
    return out;
  }

  model::Pose pose_of(const Shape& shape, const model::State& state) const {
    return shape.part < bodies_ ? state[shape.part] : model::Pose{};
  }

  /// Whether a body is one of the two that a soft part joins.
  bool is_own(int soft, int body) const {
    if (soft < bodies_) return false;
    const model::RestHinge& hinge = sheet_.linkage.hinges[soft - bodies_];
    return hinge.lower == body || hinge.upper == body;
  }

  double asked_elsewhere(int a, int b) const {
    if (a >= bodies_ || b >= bodies_) return 0;
    const double least = std::min(asked_[a], asked_[b]);
    return least < nothing_mm ? least : 0;
  }

  LeastDistance compared(const Shape& a, const Shape& b, const model::State& state,
                         LeastDistance found) const {
    btGjkEpaSolver2::sResults result;
    const btTransform at_a = to_bullet(pose_of(a, state)), at_b = to_bullet(pose_of(b, state));
    const btVector3 guess = at_b * to_bullet(b.center) - at_a * to_bullet(a.center);
    const bool known_apart = btGjkEpaSolver2::Distance(a.hull.get(), at_a, b.hull.get(), at_b, guess, result);
    if (!known_apart &&
        !btGjkEpaSolver2::Penetration(a.hull.get(), at_a, b.hull.get(), at_b, guess, result, false))
      result.distance = 0;  // they touch
    found.mm = result.distance;
    found.place = 0.5 * from_bullet(result.witnesses[0] + result.witnesses[1]);
    return found;
  }

  /// Two cylinders whose axes differ by as much as the bodies disagree about the hinge, at both ends of the eye.
  void compare_bore(int h, double theta, const model::State& state, PathClearance& least) const {
    if (sheet_.hinges[h].made.kind != model::HingeKind::pin) return;
    const model::RestHinge& hinge = sheet_.linkage.hinges[h];
    const model::Pose &lower = state[hinge.lower], &upper = state[hinge.upper];
    const double edge = sheet_.linkage.size.edge_mm, clearance = sheet_.hinges[h].made.clearance_mm;
    const Vector3d axis = lower.R * hinge.axis, place = lower.p + edge * lower.R * hinge.lower_arm,
                   apart = upper.p + edge * upper.R * hinge.upper_arm - place;
    for (const double s : {-0.5, 0.5}) {
      const double high = s * sheet_.hinges[h].made.height_mm;
      const Vector3d gap = apart + high * (upper.R * hinge.axis - axis);
      const LeastDistance found{clearance - (gap - gap.dot(axis) * axis).norm(),
                                hinge.lower,
                                hinge.upper,
                                theta,
                                place + high * axis,
                                clearance};
      take_less(found, least.in_hinges);
      take_nearer(found, least.nearest);
    }
  }

  const PrintSheet& sheet_;
  const int bodies_;
  std::vector<Shape> rigid_;
  std::vector<double> asked_;                     // of each body, the least of its pins, mm
  std::map<std::pair<int, int>, double> hinged_;  // clearance, mm; of blocks and films 0
};

/// Where parts first come too near. @param by_state of the path, some of them
LeastDistance first_of(const PrintSheet& sheet, const Distances& distances,
                       const std::vector<PathClearance>& by_state) {
  std::size_t k = 0;
  while (is_kept(by_state[k])) ++k;
  LeastDistance first = by_state[k].least();
  if (k == 0 || !sheet.motion) return first;
  double kept = sheet.thetas[k - 1];
  while (std::abs(first.theta - kept) > first_rad) {
    const double middle = (first.theta + kept) / 2;
    const PathClearance there = distances.measured(middle, sheet.motion(middle));
    if (is_kept(there))
      kept = middle;
    else
      first = there.least();
  }
  return first;
}

}  // namespace

double LeastDistance::spare_mm() const { return mm - (asked_mm > 0 ? asked_mm - polygon_mm : 0); }

PathClearance path_clearance(const PrintSheet& sheet) {
  const Distances distances(sheet);
  std::vector<PathClearance> by_state(sheet.path.size());
  model::run_in_parallel(static_cast<int>(sheet.path.size()), 0,
                         [&](int k) { by_state[k] = distances.measured(sheet.thetas[k], sheet.path[k]); });
  PathClearance all = nothing_near();
  all.flat_mm = by_state.front().flat_mm;
  for (const PathClearance& state : by_state) {
    take_less(state.in_hinges, all.in_hinges);
    take_less(state.elsewhere, all.elsewhere);
    take_nearer(state.nearest, all.nearest);
  }
  if (!is_kept(all)) all.first_too_near = first_of(sheet, distances, by_state);
  return all;
}

bool is_kept(const PathClearance& clearance) { return clearance.least().spare_mm() >= 0; }

std::string part_name(const PrintSheet& sheet, int part) {
  const int bodies = static_cast<int>(sheet.bodies.size());
  return part < bodies ? sheet.linkage.vertex_name(part)
                       : "soft part of " + sheet.linkage.wall_name(part - bodies);
}

}  // namespace kinetix::app
