#include "app/print/path_clearance.hpp"

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

#include <cmath>
#include <map>
#include <memory>

#include "model/contact/near_pairs.hpp"
#include "optim/solvers/parallel_runs.hpp"

namespace kinetix::app {
namespace {

using Eigen::Vector3d;

constexpr double polygon_mm = 0.01;  // mm: by which polygons differ from their circles
constexpr double nothing_mm = 1e3;   // mm: where there are no two bodies

btVector3 to_bullet(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Vector3d from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

btTransform to_bullet(const model::Pose& pose) {
  const Eigen::Matrix3d& R = pose.R;
  const btMatrix3x3 turn(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2));
  return btTransform(turn, to_bullet(pose.p));
}

/// A convex piece with its support function.
struct Shape {
  int body, hinge;
  std::unique_ptr<btConvexHullShape> hull;
  Vector3d center;    // mm, in the body
  double radius = 0;  // mm, about the center
};

class Distances {
 public:
  explicit Distances(const PrintSheet& sheet) : sheet_(sheet) {
    for (int b = 0; b < static_cast<int>(sheet.bodies.size()); ++b) {
      if (sheet.bodies[b].arms.empty()) continue;
      for (const model::ConvexPiece& piece : convex_pieces(sheet.bodies[b]))
        if (!piece.is_rod) add(b, piece);
    }
    for (const model::RestHinge& hinge : sheet.linkage.hinges)
      hinged_[std::minmax(hinge.lower, hinge.upper)] = true;
  }

  /// In one state.
  void measure(double theta, const model::State& state, PathClearance& least) const {
    Eigen::Matrix3Xd centers(3, shapes_.size());
    for (std::size_t k = 0; k < shapes_.size(); ++k)
      centers.col(k) = state[shapes_[k].body].R * shapes_[k].center + state[shapes_[k].body].p;
    model::NearPairs near;
    for (const auto& [a, b] : near.find(centers, reach_)) {
      if (shapes_[a].body == shapes_[b].body) continue;
      LeastDistance& known = is_hinged(a, b) ? least.in_hinges : least.elsewhere;
      const double at_least =
          (centers.col(a) - centers.col(b)).norm() - shapes_[a].radius - shapes_[b].radius;
      if (at_least < known.mm) compare(shapes_[a], shapes_[b], theta, state, known);
    }
    for (int h = 0; h < static_cast<int>(sheet_.hinges.size()); ++h)
      compare_bore(h, theta, state, least.in_hinges);
  }

 private:
  void add(int body, const model::ConvexPiece& piece) {
    Shape shape{body, piece.hinge, std::make_unique<btConvexHullShape>(), Vector3d::Zero()};
    for (const Vector3d& p : piece.corners) {
      shape.hull->addPoint(to_bullet(p), false);
      shape.center += p / static_cast<double>(piece.corners.size());
    }
    shape.hull->setMargin(0);
    shape.hull->recalcLocalAabb();
    for (const Vector3d& p : piece.corners) shape.radius = std::max(shape.radius, (p - shape.center).norm());
    reach_ = std::max(reach_, 2 * shape.radius + 1);
    shapes_.push_back(std::move(shape));
  }

  bool is_hinged(int a, int b) const {
    return hinged_.count(std::minmax(shapes_[a].body, shapes_[b].body)) > 0;
  }

  static void compare(const Shape& a, const Shape& b, double theta, const model::State& state,
                      LeastDistance& known) {
    btGjkEpaSolver2::sResults result;
    const btTransform at_a = to_bullet(state[a.body]), at_b = to_bullet(state[b.body]);
    const btVector3 guess = at_b * to_bullet(b.center) - at_a * to_bullet(a.center);
    const bool known_apart = btGjkEpaSolver2::Distance(a.hull.get(), at_a, b.hull.get(), at_b, guess, result);
    if (!known_apart &&
        !btGjkEpaSolver2::Penetration(a.hull.get(), at_a, b.hull.get(), at_b, guess, result, false))
      result.distance = 0;  // they touch
    if (!(result.distance < known.mm)) return;
    known = {result.distance, a.body, b.body, theta,
             0.5 * from_bullet(result.witnesses[0] + result.witnesses[1])};
  }

  /// Two cylinders whose axes differ by as much as the bodies disagree about the hinge, at both ends of the eye.
  void compare_bore(int h, double theta, const model::State& state, LeastDistance& known) const {
    if (sheet_.hinges[h].made.kind != model::HingeKind::pin) return;
    const model::RestHinge& hinge = sheet_.linkage.hinges[h];
    const model::Pose &lower = state[hinge.lower], &upper = state[hinge.upper];
    const double edge = sheet_.linkage.size.edge_mm;
    const Vector3d axis = lower.R * hinge.axis, place = lower.p + edge * lower.R * hinge.lower_arm,
                   apart = upper.p + edge * upper.R * hinge.upper_arm - place;
    for (const double s : {-0.5, 0.5}) {
      const double high = s * sheet_.hinges[h].made.height_mm;
      const Vector3d gap = apart + high * (upper.R * hinge.axis - axis);
      const double left = sheet_.hinges[h].made.clearance_mm - (gap - gap.dot(axis) * axis).norm();
      if (left < known.mm) known = {left, hinge.lower, hinge.upper, theta, place + high * axis};
    }
  }

  const PrintSheet& sheet_;
  std::vector<Shape> shapes_;
  std::map<std::pair<int, int>, bool> hinged_;
  double reach_ = 0;
};

double asked_of(const PrintSheet& sheet) {
  double asked = nothing_mm;
  for (const model::HingePrint& hinge : sheet.hinges)
    asked = std::min(asked, hinge.made.kind == model::HingeKind::pin ? hinge.made.clearance_mm : 0);
  return asked;
}

void take_less(const LeastDistance& other, LeastDistance& known) {
  if (other.mm < known.mm) known = other;
}

}  // namespace

PathClearance path_clearance(const PrintSheet& sheet) {
  PathClearance none{asked_of(sheet), {}, {}};
  none.in_hinges.mm = none.elsewhere.mm = nothing_mm;
  const Distances distances(sheet);
  std::vector<PathClearance> by_state(sheet.path.size(), none);
  optim::run_in_parallel(static_cast<int>(sheet.path.size()), 0,
                         [&](int k) { distances.measure(sheet.thetas[k], sheet.path[k], by_state[k]); });
  for (const PathClearance& state : by_state) {
    take_less(state.in_hinges, none.in_hinges);
    take_less(state.elsewhere, none.elsewhere);
  }
  return none;
}

bool is_kept(const PathClearance& clearance) {
  const double least = clearance.asked_mm > 0 ? clearance.asked_mm - polygon_mm : 0;
  return clearance.least().mm >= least;
}

}  // namespace kinetix::app
