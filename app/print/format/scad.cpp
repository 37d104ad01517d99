#include <fmt/format.h>

#include <Eigen/Geometry>

#include "app/print/format/parts.hpp"
#include "app/print/format/print_format.hpp"
#include "model/base/angle.hpp"

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
  return scad_list(as_filed(solid).points, [](const Eigen::Vector3d& p) {
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

}  // namespace kinetix::app
