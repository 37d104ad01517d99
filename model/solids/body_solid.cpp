#include "model/solids/body_solid.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <utility>

#include "model/base/invalid_input.hpp"

namespace kinetix::model {
namespace {

using Eigen::Vector3d;

constexpr double rounding_mm = 1e-9;  // mm: rounding of corners that are meant to be one
// In mm: sections this near to each other's corners would be one face of the junction
constexpr double touching_mm = 1e-6;
// Ratio to a wall's thickness: distance of sections without shared corners
constexpr double free_share = 0.05;
constexpr double min_plate = 0.1;  // ratio to a wall's thickness: shorter plates are rejected
constexpr int rounds = 60;         // most iterations that place sections: each halves the remaining motion

ArmSolid arm_of(const Linkage& linkage, const Plate& plate, const HingePrint& print) {
  const RestHinge& hinge = linkage.hinges[plate.hinge];
  const double L = linkage.size.edge_mm;
  ArmSolid arm;
  arm.hinge = plate.hinge;
  arm.fork = linkage.bodies[plate.body].sense > 0;
  arm.size = linkage.size;
  arm.edge = plate.edge;
  arm.up = plate.up;
  arm.axis = hinge.axis.dot(plate.up) < 0 ? -hinge.axis : hinge.axis;
  arm.towards_axis = (plate.edge - plate.edge.dot(arm.axis) * arm.axis).normalized();
  arm.normal = arm.axis.cross(arm.towards_axis);
  const Vector3d p = L * (plate.body == hinge.lower ? hinge.lower_arm : hinge.upper_arm);
  const Vector3d halfway = p - p.dot(plate.up) / arm.axis.dot(plate.up) * arm.axis;
  arm.origin = halfway.dot(plate.edge) * plate.edge;
  HingePrint seen = print;
  if ((plate.body == hinge.upper) != (hinge.axis.dot(plate.up) < 0)) seen.turn = -seen.turn;
  arm.end = hinge_end(seen, linkage.size, halfway.dot(arm.normal), arm.fork);
  return arm;
}

/// Returns the extent of the other sections, and of the post's foot, along an arm's edge.
double reached(const BodySolid& body, std::size_t along, double free) {
  const std::vector<ArmSolid>& arms = body.arms;
  double most = arms[along].size.thickness_mm / 2;
  if (body.post)
    for (const Vector3d& corner : body.post->corners(0))
      most = std::max(most, arms[along].edge.dot(corner) + free);
  for (std::size_t k = 0; k < arms.size(); ++k)
    if (k != along)
      for (const Vector3d& corner : arms[k].start_corners())
        most = std::max(most, arms[along].edge.dot(corner) + free);
  return most;
}

void move_starts(BodySolid& body, double free) {
  std::vector<ArmSolid>& arms = body.arms;
  bool has_moved = true;
  for (int round = 0; round < rounds && has_moved; ++round) {
    has_moved = false;
    for (std::size_t k = 0; k < arms.size(); ++k) {
      const double before = std::exchange(arms[k].start, reached(body, k, free));
      has_moved |= arms[k].start != before;
    }
  }
}

/// Returns true if a corner of another section is in the plane of an arm's section, but not one of its corners.
bool is_touched(const ArmSolid& arm, const ArmSolid& other) {
  const std::vector<Vector3d> own = arm.start_corners(), others = other.start_corners();
  return std::any_of(others.begin(), others.end(), [&](const Vector3d& corner) {
    const bool is_shared = std::any_of(own.begin(), own.end(),
                                       [&](const Vector3d& p) { return (p - corner).norm() <= rounding_mm; });
    return !is_shared && arm.edge.dot(corner) >= arm.start - touching_mm;
  });
}

bool any_touched(const std::vector<ArmSolid>& arms) {
  for (const ArmSolid& arm : arms)
    for (const ArmSolid& other : arms)
      if (&arm != &other && is_touched(arm, other)) return true;
  return false;
}

/// Moves the sections out until each is the outermost along its edge. They are as near as possible if they share
/// corners, as for upright walls at equal angles, otherwise slightly apart. They are apart from the foot of a post.
void find_starts(BodySolid& body) {
  const double free = free_share * body.arms.front().size.thickness_mm;
  if (!body.post) move_starts(body, 0);
  if (body.post || any_touched(body.arms)) move_starts(body, free);
}

/// Returns the position of the plate's end at the hinge nearest to the vertex, along the edge, mm.
double nearest_end(const ArmSolid& arm) {
  const double half = arm.size.height_mm / 2;
  return std::min(arm.edge.dot(arm.point({-arm.end.wall_end, 0}, -half)),
                  arm.edge.dot(arm.point({-arm.end.wall_end, 0}, half)));
}

void check_room(const Linkage& linkage, int body, const ArmSolid& arm) {
  const double room = nearest_end(arm) - arm.start, least = min_plate * arm.size.thickness_mm;
  if (room >= least) return;
  std::ostringstream message;
  message
      << "the hinge of wall " << linkage.wall_name(arm.hinge) << " overlaps the junction at vertex "
      << linkage.vertex_name(body) << ": its plate would have to be " << std::setprecision(3) << least - room
      << " mm longer (move the hinge towards the middle of its wall, or use larger cells or smaller hinges)";
  throw InvalidInput(message.str());
}

ConvexHull junction_of(const BodySolid& body) {
  const std::vector<ArmSolid>& arms = body.arms;
  std::vector<Vector3d> points;
  if (body.post)
    for (const Vector3d& corner : body.post->corners(0)) points.push_back(corner);
  for (const ArmSolid& arm : arms)
    for (const Vector3d& corner : arm.start_corners()) points.push_back(corner);
  if (arms.size() == 1)  // a dead end
    for (const Vector3d& corner : arms.front().start_corners())
      points.push_back(corner -
                       (arms.front().start + arms.front().size.thickness_mm / 2) * arms.front().edge);
  return convex_hull(points);
}

}  // namespace

Vector3d ArmSolid::point(const Eigen::Vector2d& at, double s) const {
  return origin + at.x() * towards_axis + at.y() * normal + s * axis;
}

std::vector<Vector3d> ArmSolid::start_corners() const {
  const double half = size.thickness_mm / 2, high = size.height_mm / 2;
  std::vector<Vector3d> out;
  out.reserve(4);
  for (const double w : {-high, high})
    for (const double n : {-half, half}) out.push_back(start * edge + n * normal + w * up);
  return out;
}

Polyhedron soft_solid(const Linkage& linkage, int hinge, const HingePrint& print) {
  const ArmSolid lower = arm_of(linkage, linkage.plates[2 * hinge], print);
  const double across = print.made.thickness_mm / 2, high = print.made.height_mm / 2,
               gap = print.made.gap_mm / 2;
  Polyhedron block;
  for (const double m : {-gap, gap})
    for (const double s : {-high, high})
      for (const double n : {-across, across})
        block.add_point(lower.point({m, lower.end.axis_across + n}, s));
  for (const std::vector<int>& face :
       {std::vector{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    block.add_face(face);
  return block;
}

Polyhedron rod_solid(const Linkage& linkage, int hinge, const HingePrint& print) {
  const ArmSolid lower = arm_of(linkage, linkage.plates[2 * hinge], print);
  const double high = print.made.height_mm / 2;
  Polyhedron rod;
  std::vector<int> below, above;
  for (const Eigen::Vector2d& p : rod_section(print)) {
    const Eigen::Vector2d at = p + Eigen::Vector2d(0, lower.end.axis_across);
    below.push_back(rod.add_point(lower.point(at, -high)));
    above.push_back(rod.add_point(lower.point(at, high)));
  }
  const std::size_t n = below.size();
  for (std::size_t k = 0; k < n; ++k)
    rod.add_face({below[k], below[(k + 1) % n], above[(k + 1) % n], above[k]});
  rod.add_face(above);
  rod.add_face({below.rbegin(), below.rend()});
  return rod;
}

namespace {

using Eigen::Vector2d;
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

/// Adds the pieces of a half wall with its end at the hinge.
void add_arm_pieces(const ArmSolid& arm, std::vector<ConvexPiece>& pieces) {
  const HingeEnd& end = arm.end;
  pieces.push_back({plate(arm), arm.hinge});
  for (const HingeEnd::Lug& lug : end.lugs)
    pieces.push_back({prism(arm, end.section, lug.from, lug.to), arm.hinge});
  if (end.rod.empty()) return;
  const double low = end.lugs.front().to, high = end.lugs.back().from;
  pieces.push_back({prism(arm, end.rod, low + end.cone, high - end.cone), arm.hinge, true});
  if (end.rim.empty()) return;
  pieces.push_back({cone(arm, low, low + end.cone), arm.hinge, true});
  pieces.push_back({cone(arm, high, high - end.cone), arm.hinge, true});
}

/// Returns the corners of a box within a post. @param low, high along and across
Points post_box(const Post& post, const Vector2d& low, const Vector2d& high, double from, double to) {
  Points points;
  for (const double up : {from, to})
    for (const double along : {low.x(), high.x()})
      for (const double across : {low.y(), high.y()}) points.push_back(post.point(along, across, up));
  return points;
}

void add_post_pieces(const Post& post, std::vector<ConvexPiece>& pieces) {
  const double half = post.half_mm, hole = post.hole_mm / 2;
  const auto add = [&](double low, double high, double from, double to) {
    pieces.push_back({post_box(post, {-half, low}, {half, high}, from, to)});
  };
  if (post.hole_mm == 0) return add(-half, half, 0, post.height_mm);
  add(-half, half, 0, post.hole_from_mm);
  add(-half, -hole, post.hole_from_mm, post.hole_to_mm);
  add(hole, half, post.hole_from_mm, post.hole_to_mm);
  add(-half, half, post.ridge_mm(), post.height_mm);
  for (const double side : {-1.0, 1.0}) {  // beside the gable
    Points points;
    for (const double along : {-half, half})
      for (const Vector2d& at : {Vector2d(hole, post.hole_to_mm), Vector2d(half, post.hole_to_mm),
                                 Vector2d(half, post.ridge_mm()), Vector2d(0, post.ridge_mm())})
        points.push_back(post.point(along, side * at.x(), at.y()));
    pieces.push_back({points});
  }
}

/// Returns the height of the highest point of a body's arms above its origin, mm.
double highest_mm(const BodySolid& body) {
  std::vector<ConvexPiece> pieces;
  for (const ArmSolid& arm : body.arms) add_arm_pieces(arm, pieces);
  double most = -INFINITY;
  for (const ConvexPiece& piece : pieces)
    for (const Vector3d& corner : piece.corners) most = std::max(most, corner.z());
  return most;
}

}  // namespace

std::vector<ConvexPiece> convex_pieces(const BodySolid& body) {
  std::vector<ConvexPiece> pieces{{body.junction.corners}};
  for (const ArmSolid& arm : body.arms) add_arm_pieces(arm, pieces);
  if (body.post) add_post_pieces(*body.post, pieces);
  return pieces;
}

Vector3d Post::point(double along, double across, double up) const {
  return {along * std::cos(angle) - across * std::sin(angle),
          along * std::sin(angle) + across * std::cos(angle), base_mm + up};
}

std::array<Vector3d, 4> Post::corners(double up) const {
  return {point(-half_mm, -half_mm, up), point(half_mm, -half_mm, up), point(half_mm, half_mm, up),
          point(-half_mm, half_mm, up)};
}

std::vector<BodySolid> body_solids(const Linkage& linkage, const HingePrints& hinges, const Posts& posts) {
  std::vector<BodySolid> bodies(linkage.bodies.size());
  for (const auto& [body, post] : posts) bodies[body].post = post;
  for (const Plate& plate : linkage.plates)
    bodies[plate.body].arms.push_back(arm_of(linkage, plate, hinges(plate.hinge)));
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies[b].arms.empty()) continue;
    find_starts(bodies[b]);
    for (const ArmSolid& arm : bodies[b].arms) check_room(linkage, static_cast<int>(b), arm);
    if (bodies[b].post) bodies[b].post->base_mm = highest_mm(bodies[b]) + bodies[b].post->foot_mm;
    bodies[b].junction = junction_of(bodies[b]);
  }
  return bodies;
}

}  // namespace kinetix::model
