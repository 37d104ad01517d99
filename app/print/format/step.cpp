#include "app/cad/step.hpp"

#include <cmath>
#include <map>

#include "app/print/format/print_format.hpp"

namespace kinetix::app {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using model::ArmSolid;

constexpr double same_mm = 1e-6;  // mm: bodies whose corners differ by less have one shape

// Red, green and blue of the screen from 0 to 1, as in the 3MF files.
constexpr std::array<double, 3> hard_colour = {0.847, 0.847, 0.824};
constexpr std::array<double, 3> soft_colour = {0.180, 0.435, 0.718};

// Faces of eight corners, numbered by low and high in thickness, then width, then height.
const std::vector<std::vector<int>> box_faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                                 {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

cad::Faceted plate(const ArmSolid& arm) {
  std::vector<Vector3d> points = arm.start_corners();
  const double half = arm.size.thickness_mm / 2, high = arm.size.height_mm / 2;
  for (const double s : {-high, high})
    for (const double n : {-half, half}) points.push_back(arm.point({-arm.end.wall_end, n}, s));
  return {points, box_faces};
}

cad::Circle circle_of(const ArmSolid& arm, double radius, double s) {
  return {arm.point({0, arm.end.axis_across}, s), arm.axis, arm.towards_axis, radius};
}

/// Returns the point at which a line from an outside point touches a circle. @param turn 1: counter-clockwise, else -1
Vector2d touching(const Vector2d& from, const Vector2d& middle, double radius, double turn) {
  const Vector2d u = (from - middle).normalized();
  const double angle = turn * std::acos(radius / (from - middle).norm());
  return middle + radius * Vector2d(std::cos(angle) * u.x() - std::sin(angle) * u.y(),
                                    std::sin(angle) * u.x() + std::cos(angle) * u.y());
}

/// Returns a knuckle's outline: tangents from the wall's corners to the knuckle's circle.
cad::Contour knuckle_contour(const ArmSolid& arm, double s) {
  const model::HingeEnd& end = arm.end;
  const Vector2d middle(0, end.knuckle_across), low = end.section.front(), high = end.section.back(),
                                                first = touching(low, middle, end.knuckle_radius, 1),
                                                last = touching(high, middle, end.knuckle_radius, -1),
                                                outermost = middle + Vector2d(end.knuckle_radius, 0);
  const auto at = [&](const Vector2d& p) { return arm.point(p, s); };
  return {at(low), {{at(first), {}}, {at(last), at(outermost)}, {at(high), {}}, {at(low), {}}}};
}

cad::Contour section_contour(const ArmSolid& arm, double s) {
  if (arm.end.knuckle_radius > 0) return knuckle_contour(arm, s);
  cad::Contour contour{arm.point(arm.end.section.front(), s), {}};
  for (std::size_t i = 1; i <= arm.end.section.size(); ++i)
    contour.edges.push_back({arm.point(arm.end.section[i % arm.end.section.size()], s), {}});
  return contour;
}

/// Returns a cone that begins at a rim about the axis. @param up 1: upwards, else -1   @param end_radius mm
cad::Frustum cone_of(const ArmSolid& arm, double s, double up, double end_radius, double along) {
  cad::Circle rim = circle_of(arm, arm.end.rim_radius, s);
  rim.axis *= up;
  return {rim, end_radius, along};
}

/// Returns a lug. The cone of a sink continues within the bore, to half its radius: no face of it ends on the bore's.
cad::Prism lug(const ArmSolid& arm, const model::HingeEnd::Lug& at) {
  const model::HingeEnd& end = arm.end;
  cad::Prism prism{section_contour(arm, at.from), {}, (at.to - at.from) * arm.axis};
  if (end.bore_radius > 0) prism.hole = circle_of(arm, end.bore_radius, at.from);
  if (end.bore_radius > 0 && end.rim_radius > 0) {
    const double inner = end.bore_radius / 2,
                 along = end.cone * (end.rim_radius - inner) / (end.rim_radius - end.bore_radius);
    prism.sinks = {cone_of(arm, at.from, 1, inner, along), cone_of(arm, at.to, -1, inner, along)};
  }
  return prism;
}

std::vector<cad::Piece> rod(const ArmSolid& arm) {
  const model::HingeEnd& end = arm.end;
  const double low = end.lugs.front().to, high = end.lugs.back().from, straight = high - low - 2 * end.cone;
  std::vector<cad::Piece> pieces = {
      cad::Prism{circle_of(arm, end.rod_radius, low + end.cone), {}, straight * arm.axis}};
  if (end.rim_radius > 0) {
    pieces.push_back(cone_of(arm, low, 1, end.rod_radius, end.cone));
    pieces.push_back(cone_of(arm, high, -1, end.rod_radius, end.cone));
  }
  return pieces;
}

std::vector<cad::Piece> pieces_of(const model::BodySolid& body) {
  std::vector<cad::Piece> pieces = {cad::Faceted{body.junction.corners, body.junction.faces}};
  for (const ArmSolid& arm : body.arms) {
    pieces.push_back(plate(arm));
    for (const model::HingeEnd::Lug& at : arm.end.lugs) pieces.push_back(lug(arm, at));
    if (arm.end.rod_radius > 0)
      for (cad::Piece& piece : rod(arm)) pieces.push_back(std::move(piece));
  }
  return pieces;
}

/// Returns a loose rod, relative to the lower body.
cad::Prism rod_of(const PrintSheet& sheet, int hinge) {
  Vector3d at = Vector3d::Zero();
  const std::vector<Vector3d>& corners = sheet.rods[hinge].points;
  for (const Vector3d& corner : corners) at += corner / static_cast<double>(corners.size());
  const Vector3d axis = sheet.linkage.hinges[hinge].axis;
  const model::MadeHinge& made = sheet.hinges[hinge].made;
  return {cad::Circle{at - made.height_mm / 2 * axis, axis, axis.unitOrthogonal(), made.diameter_mm / 2},
          {},
          made.height_mm * axis};
}

/// Returns the solid of a soft part. At rest it has flat faces. A stretched one is given by its triangles.
cad::Faceted block_of(const model::Polyhedron& block, bool stretched) {
  if (!stretched) return {block.points, box_faces};
  cad::Faceted solid{block.points, {}};
  for (const auto& t : block.triangles) solid.faces.push_back({t.begin(), t.end()});
  return solid;
}

Eigen::Isometry3d place_of(const model::Pose& pose) {
  Eigen::Isometry3d where = Eigen::Isometry3d::Identity();
  where.linear() = pose.R;
  where.translation() = pose.p;
  return where;
}

/// Parts of the sheet for a CAD file. Bodies of one shape refer to the same shape.
class SheetParts {
 public:
  explicit SheetParts(const PrintJob& job) : job_(job) {
    const PrintSheet& sheet = job.sheet;
    product_.name = sheet.name;
    for (int b = 0; b < static_cast<int>(sheet.bodies.size()); ++b)
      if (!sheet.meshes[b].points.empty())
        add("body " + sheet.linkage.vertex_name(b), body_shape(b), place_of(job.state()[b]));
    for (int h = 0; h < static_cast<int>(sheet.rods.size()); ++h)
      if (!sheet.rods[h].points.empty())
        add("rod " + sheet.linkage.wall_name(h), shape("rod", hard_colour, {rod_of(sheet, h)}),
            place_of(job.state()[sheet.linkage.hinges[h].lower]));
    for (int h = 0; h < static_cast<int>(sheet.soft.size()); ++h)
      if (!sheet.soft[h].points.empty())
        add("hinge " + sheet.linkage.wall_name(h),
            shape("hinge", soft_colour, {block_of(placed_soft(sheet, job.state(), h), job.folded)}),
            Eigen::Isometry3d::Identity());
  }

  const cad::Product& product() const { return product_; }

 private:
  void add(const std::string& name, int shape, const Eigen::Isometry3d& where) {
    product_.parts.push_back({name, shape, where});
  }

  int shape(const std::string& name, const std::array<double, 3>& colour, std::vector<cad::Piece> pieces) {
    product_.shapes.push_back({name, colour, std::move(pieces)});
    return static_cast<int>(product_.shapes.size()) - 1;
  }

  int body_shape(int body) {
    std::vector<double> key;
    for (const Vector3d& p : job_.sheet.meshes[body].points)
      for (const double x : p) key.push_back(std::round(x / same_mm));
    const auto known = bodies_.find(key);
    if (known != bodies_.end()) return known->second;
    const std::string name = "type " + std::to_string(bodies_.size() + 1);
    return bodies_[key] = shape(name, hard_colour, pieces_of(job_.sheet.bodies[body]));
  }

  const PrintJob& job_;
  cad::Product product_;
  std::map<std::vector<double>, int> bodies_;
};

std::vector<NamedContent> write_step(const PrintJob& job) {
  return {{job.sheet.name + ".step", cad::step_text(SheetParts(job).product())}};
}

}  // namespace

// Entry of the format step: name, meaning and writer.
const PrintFormat step_format = {.name = "step",
                                 .meaning = "CAD, with true cylinders",
                                 .write = write_step,
                                 .load = cad::load,
                                 .lies_on_bed = true};

}  // namespace kinetix::app
