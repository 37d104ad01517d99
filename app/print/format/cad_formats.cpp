#include <fmt/format.h>

#include "app/cad/cad_formats.hpp"
#include "app/print/format/print_format.hpp"
#include "model/base/geometry.hpp"

namespace kinetix::app {
namespace {

// Head of the file, for OpenSCAD's `use`, which imports modules and functions only.
constexpr const char* scad_head = R"(// {name}, designed by kinetix: {bodies} bodies, {hinges} hinges; mm.
//   use <{name}.scad>
//   sheet();            // all of it where it was asked for: {shown} of the way from flat (0) to the fold (1)
//   sheet(0.5);         // half way
//   body(3, 0.5);       // one body there, by its number in result.json, 0 to {last}
//   soft(7, 0.5);       // the block or film of a hinge, where it has one; it stretches with its walls
//   body_shape(3);      // the body by itself: its vertex in the origin
//   p = pose(3, 0.5);   // where it is: [x, y, z, quaternion w, x, y, z]
// theta_deg(part) is the fold angle there.

function bodies() = {bodies};
function hinges() = {hinges};
function theta_deg(part = {shown}) = _between(_thetas, part);
function pose(b, part = {shown}) = _unit(_between([for (state = _poses) state[b]], part));
module body_shape(b) polyhedron(_points[b], _faces[b]);
module body(b, part = {shown}) polyhedron([for (p = _points[b]) _carried(pose(b, part), p)], _faces[b]);
module soft(h, part = {shown}) {{
  ends = [pose(_joins[h][0], part), pose(_joins[h][1], part)];
  half = len(_soft_points[h]) / 2;
  if (half > 0)
    polyhedron([for (k = [0 : 2 * half - 1]) _carried(ends[k < half ? 0 : 1], _soft_points[h][k])], _soft_faces[h]);
}}
module sheet(part = {shown}) {{
  for (b = [0 : bodies() - 1]) color([0.85, 0.85, 0.82]) body(b, part);
  for (h = [0 : hinges() - 1]) color([0.18, 0.44, 0.72]) soft(h, part);
}}

function _place(list, part) = min(max(part, 0), 1) * (len(list) - 1);
function _between(list, part) = let (s = _place(list, part), k = floor(s), next = min(k + 1, len(list) - 1))
  list[k] + (s - k) * (list[next] - list[k]);
function _unit(p) = let (q = [p[3], p[4], p[5], p[6]] / norm([p[3], p[4], p[5], p[6]]))
  [p[0], p[1], p[2], q[0], q[1], q[2], q[3]];
function _carried(p, v) = let (axis = [p[4], p[5], p[6]], twice = 2 * cross(axis, v))
  [p[0], p[1], p[2]] + v + p[3] * twice + cross(axis, twice);

)";

template <class Item, class Text>
std::string scad_list(const std::vector<Item>& items, Text text, const char* between = ",") {
  std::string out = "[";
  for (std::size_t k = 0; k < items.size(); ++k) out += (k ? between : "") + text(items[k]);
  return out + "]";
}

/// Formats points, rounded to floats as in all files.
std::string scad_points(const model::Polyhedron& solid) {
  return scad_list(rounded_for_file(solid).points, [](const Eigen::Vector3d& p) {
    return fmt::format("[{},{},{}]", static_cast<float>(p.x()), static_cast<float>(p.y()),
                       static_cast<float>(p.z()));
  });
}

/// Formats faces: OpenSCAD needs corners clockwise from outside.
std::string scad_faces(const model::Polyhedron& solid) {
  return scad_list(solid.triangles,
                   [](const std::array<int, 3>& t) { return fmt::format("[{},{},{}]", t[2], t[1], t[0]); });
}

using Table = std::vector<std::array<double, 7>>;

/// Returns the poses of a state. Each quaternion has the sign that is nearer to the state before.
Table scad_poses(const model::State& state, const Table& before) {
  Table out;
  for (std::size_t b = 0; b < state.size(); ++b) {
    Eigen::Vector4d q = Eigen::Quaterniond(state[b].R).coeffs();  // x y z w
    if (!before.empty() && q.dot(Eigen::Vector4d(before[b][4], before[b][5], before[b][6], before[b][3])) < 0)
      q = -q;
    const Eigen::Vector3d& p = state[b].p;
    out.push_back({p.x(), p.y(), p.z(), q[3], q[0], q[1], q[2]});
  }
  return out;
}

std::string poses_text(const std::vector<model::State>& path) {
  std::vector<Table> tables;
  for (const model::State& state : path)
    tables.push_back(scad_poses(state, tables.empty() ? Table{} : tables.back()));
  return scad_list(
      tables,
      [](const Table& table) {
        return scad_list(
            table, [](const std::array<double, 7>& p) { return fmt::format("[{:.9g}]", fmt::join(p, ",")); });
      },
      ",\n");
}

/// Returns a soft part whose first half of points is relative to the lower body's rest position, the second to the
/// upper's.
model::Polyhedron by_its_ends(const PrintSheet& sheet, int hinge) {
  const model::RestHinge& rest = sheet.linkage.hinges[hinge];
  model::Polyhedron out = sheet.soft[hinge];
  for (std::size_t k = out.points.size() / 2; k < out.points.size(); ++k)
    out.points[k] += sheet.linkage.rest_position(rest.lower) - sheet.linkage.rest_position(rest.upper);
  return out;
}

std::string scad(const PrintJob& job) {
  const PrintSheet& sheet = job.sheet;
  std::vector<model::Polyhedron> bodies, soft(sheet.linkage.hinges.size());
  for (int b = 0; b < static_cast<int>(sheet.meshes.size()); ++b) bodies.push_back(sheet.with_rods(b));
  for (int h = 0; h < static_cast<int>(sheet.soft.size()); ++h)
    if (!sheet.soft[h].points.empty()) soft[h] = by_its_ends(sheet, h);
  using fmt::arg;
  return fmt::format(fmt::runtime(scad_head), arg("name", sheet.name), arg("bodies", bodies.size()),
                     arg("hinges", sheet.linkage.hinges.size()), arg("last", bodies.size() - 1),
                     arg("shown", job.folded ? 1 : 0)) +
         "_thetas = " +
         scad_list(sheet.thetas, [](double theta) { return fmt::format("{:.9g}", to_degrees(theta)); }) +
         ";\n_points = " + scad_list(bodies, scad_points, ",\n") +
         ";\n_faces = " + scad_list(bodies, scad_faces, ",\n") + ";\n_joins = " +
         scad_list(sheet.linkage.hinges,
                   [](const model::RestHinge& h) { return fmt::format("[{},{}]", h.lower, h.upper); }) +
         ";\n_soft_points = " + scad_list(soft, scad_points, ",\n") +
         ";\n_soft_faces = " + scad_list(soft, scad_faces, ",\n") + ";\n_poses = " + poses_text(sheet.path) +
         ";\n";
}

std::vector<NamedContent> write_scad(const PrintJob& job) { return {{job.sheet.name + ".scad", scad(job)}}; }

}  // namespace

// Entry of the format scad: name, meaning and writer.
const PrintFormat scad_format = {"scad", "modules of OpenSCAD for its parts", write_scad};

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
  const model::ManufacturedHinge& made = sheet.hinges[hinge].made;
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
