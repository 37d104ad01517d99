#include "model/solids/body_solid.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

Points prism(const ArmSolid& arm, const std::vector<Vector2d>& section, double from, double to) {
  Points points;
  for (const double s : {from, to})
    for (const Vector2d& p : section) points.push_back(arm.point(p, s));
  return points;
}

Points plate(const ArmSolid& arm) {
  Points points = arm.start_corners();
  const double half = arm.size.thickness_mm / 2, high = arm.size.height_mm / 2, end = arm.end.wall_end;
  const Points tip = prism(arm, {{-end, -half}, {-end, half}}, -high, high);
  points.insert(points.end(), tip.begin(), tip.end());
  return points;
}

/// Returns the cone from a lug's rim to the rod.
Points cone(const ArmSolid& arm, double from, double to) {
  Points points;
  for (const Vector2d& p : arm.end.rim) points.push_back(arm.point(p, from));
  for (const Vector2d& p : arm.end.rod) points.push_back(arm.point(p, to));
  return points;
}

}  // namespace

std::vector<ConvexPiece> convex_pieces(const BodySolid& body) {
  std::vector<ConvexPiece> pieces{{body.junction.corners}};
  for (const ArmSolid& arm : body.arms) {
    const HingeEnd& end = arm.end;
    pieces.push_back({plate(arm), arm.hinge});
    for (const HingeEnd::Lug& lug : end.lugs)
      pieces.push_back({prism(arm, end.section, lug.from, lug.to), arm.hinge});
    if (end.rod.empty()) continue;
    const double low = end.lugs.front().to, high = end.lugs.back().from;
    pieces.push_back({prism(arm, end.rod, low + end.cone, high - end.cone), arm.hinge, true});
    if (end.rim.empty()) continue;
    pieces.push_back({cone(arm, low, low + end.cone), arm.hinge, true});
    pieces.push_back({cone(arm, high, high - end.cone), arm.hinge, true});
  }
  return pieces;
}

}  // namespace kinetix::model
