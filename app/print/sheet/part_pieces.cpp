#include "app/print/sheet/part_pieces.hpp"

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

#include <algorithm>

namespace kinetix::app {
namespace {

using Eigen::Vector3d;

constexpr double touching_mm = 1e-9;  // mm: below, two witnesses have no direction

btVector3 to_bullet(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Vector3d from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

btTransform to_bullet(const model::Pose& pose) {
  const Eigen::Matrix3d& R = pose.R;
  const btMatrix3x3 turn(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2));
  return btTransform(turn, to_bullet(pose.p));
}

std::shared_ptr<btConvexHullShape> hull_of(const Eigen::Matrix3Xd& points) {
  auto hull = std::make_shared<btConvexHullShape>();
  for (const auto& p : points.colwise()) hull->addPoint(to_bullet(p), false);
  hull->setMargin(0);
  hull->recalcLocalAabb();
  return hull;
}

PieceEnd end_of(int body, Eigen::Matrix3Xd points) {
  PieceEnd end{body, std::move(points)};
  end.center = end.points.rowwise().mean();
  end.radius = (end.points.colwise() - end.center).colwise().norm().maxCoeff();
  return end;
}

Eigen::Matrix3Xd matrix_of(const std::vector<Vector3d>& points) {
  Eigen::Matrix3Xd out(3, points.size());
  for (std::size_t k = 0; k < points.size(); ++k) out.col(k) = points[k];
  return out;
}

/// Both ends of a block at a hinge, each relative to its own body.
std::vector<PieceEnd> soft_ends(const PrintSheet& sheet, int h) {
  const model::RestHinge& hinge = sheet.linkage.hinges[h];
  const Eigen::Matrix3Xd points = matrix_of(sheet.soft[h].points);
  const auto half = points.cols() / 2;
  const Vector3d between =
      sheet.linkage.rest_position(hinge.lower) - sheet.linkage.rest_position(hinge.upper);
  return {end_of(hinge.lower, points.leftCols(half)),
          end_of(hinge.upper, points.rightCols(points.cols() - half).colwise() + between)};
}

/// In space, with a pose of its own: of several ends the hull of where they are.
struct Placed {
  explicit Placed(const PlacedPiece& at) {
    if (at.piece.hull) {
      hull = at.piece.hull;
      pose = to_bullet(*at.poses.front());
      return;
    }
    std::vector<Vector3d> all;
    for (std::size_t k = 0; k < at.piece.ends.size(); ++k)
      for (const auto& p : at.piece.ends[k].points.colwise())
        all.emplace_back(at.poses[k]->R * p + at.poses[k]->p);
    hull = hull_of(matrix_of(all));
    pose.setIdentity();
  }
  std::shared_ptr<btConvexHullShape> hull;
  btTransform pose;
};

}  // namespace

MovingParts::MovingParts(const PrintSheet& sheet)
    : bodies(static_cast<int>(sheet.bodies.size())), pieces_of(sheet.bodies.size() + sheet.soft.size()) {
  const auto add = [&](PartPiece piece) {
    pieces_of[piece.part].push_back(static_cast<int>(pieces.size()));
    pieces.push_back(std::move(piece));
  };
  for (int b = 0; b < bodies; ++b) {
    std::vector<Vector3d> all{Vector3d::Zero()};
    if (!sheet.bodies[b].arms.empty())
      for (const model::ConvexPiece& piece : convex_pieces(sheet.bodies[b])) {
        if (piece.is_rod) continue;
        add({b, {end_of(b, matrix_of(piece.corners))}});
        pieces.back().hull = hull_of(pieces.back().ends.front().points);
        all.insert(all.end(), piece.corners.begin(), piece.corners.end());
      }
    whole.push_back(end_of(b, matrix_of(all)));
  }
  for (int h = 0; h < static_cast<int>(sheet.soft.size()); ++h)
    if (!sheet.soft[h].points.empty()) add({bodies + h, soft_ends(sheet, h)});
}

Vector3d PlacedPiece::center() const {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 0; k < poses.size(); ++k) sum += poses[k]->R * piece.ends[k].center + poses[k]->p;
  return sum / static_cast<double>(poses.size());
}

PieceDistance piece_distance(const PlacedPiece& a, const PlacedPiece& b) {
  const Placed one(a), other(b);
  btGjkEpaSolver2::sResults result;
  const btVector3 guess = to_bullet(Vector3d(b.center() - a.center()));
  const bool apart =
      btGjkEpaSolver2::Distance(one.hull.get(), one.pose, other.hull.get(), other.pose, guess, result);
  if (!apart && !btGjkEpaSolver2::Penetration(one.hull.get(), one.pose, other.hull.get(), other.pose, guess,
                                              result, false))
    result.distance = 0;  // they touch
  PieceDistance out{result.distance, 0.5 * from_bullet(result.witnesses[0] + result.witnesses[1])};
  const Vector3d between = from_bullet(result.witnesses[1] - result.witnesses[0]);
  if (between.norm() > touching_mm) out.normal = (result.distance < 0 ? -1 : 1) * between.normalized();
  return out;
}

}  // namespace kinetix::app
