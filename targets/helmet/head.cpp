#include "targets/helmet/head.hpp"

#include <cmath>

#include "model/contact/wall_contact.hpp"
#include "targets/curve/read_curve.hpp"
#include "targets/document/length_unit.hpp"
#include "targets/document/wording.hpp"
#include "targets/mesh/mesh_section.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;

/// Reach to either side, mm, over which directions along curves are taken. A shorter chord follows the noise of a
/// scan, a longer one cuts across the curvature of a head.
constexpr double direction_reach_mm = 15;
/// Distance, mm, by which coverage ends before the dome does: some triangles of it, so that sections there are whole.
constexpr double rim_mm = 5;

[[noreturn]] void refuse_open_crown() {
  throw InvalidHead("mesh", "has no surface at the crown: the top of the head is open to its rim");
}

double squared_distance(const SectionChain& chain, const Vector3d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& q : chain.points) least = std::min(least, (q - p).squaredNorm());
  return least;
}

/// Returns the points of a chain in line. A closed chain is cut open at the point farthest from p along it.
std::vector<Vector3d> opened(const SectionChain& chain, const Vector3d& p) {
  std::vector<Vector3d> points = chain.points;
  if (!chain.is_closed) return points;
  points.push_back(points.front());
  const SpaceCurve ring(points);
  const double across = std::fmod(ring.nearest(p) + ring.length() / 2, ring.length());
  const auto cut = std::lower_bound(ring.arcs().begin(), ring.arcs().end() - 1, across) - ring.arcs().begin();
  points.pop_back();
  std::rotate(points.begin(), points.begin() + cut % static_cast<std::ptrdiff_t>(points.size()),
              points.end());
  points.push_back(points.front());
  return points;
}

/// Returns the chain of a section that passes nearest to p, with arc length 0 there, towards `along` at p.
SpaceCurve curve_through(const Vector3d& p, const Vector3d& along, const TriangleMesh& mesh,
                         const Plane& plane) {
  const auto chains = section(mesh, plane);
  const auto nearest = std::min_element(chains.begin(), chains.end(), [&](const auto& a, const auto& b) {
    return squared_distance(a, p) < squared_distance(b, p);
  });
  if (nearest == chains.end()) refuse_open_crown();
  std::vector<Vector3d> points = opened(*nearest, p);
  const SpaceCurve one_way(points);
  if (one_way.direction(one_way.nearest(p), direction_reach_mm).dot(along) < 0)
    std::reverse(points.begin(), points.end());
  return SpaceCurve(points, -SpaceCurve(points).nearest(p));
}

void check_coverage(const Head& head) {
  const SpaceCurve across = cross_section(head, 0, direction_reach_mm);
  const std::array<std::pair<const char*, Vector3d>, 4> ways = {{{"back", head.profile.points().front()},
                                                                 {"front", head.profile.points().back()},
                                                                 {"left", across.points().front()},
                                                                 {"right", across.points().back()}}};
  for (const auto& [way, end] : ways) {
    const double depth = -end.z() - rim_mm;
    if (!(depth >= head.coverage_mm))
      throw InvalidHead("coverage_mm", "`coverage_mm: " + number_text(head.coverage_mm) +
                                           "` goes beyond the mesh: to the " + way +
                                           " the head can be followed down to " +
                                           number_text(std::max(0.0, std::floor(depth))) +
                                           " mm below the crown. Give `coverage_mm` of at most that");
  }
}

/// Returns the place of the dome above or below the crown. @throws InvalidHead if the dome is open there
Vector3d top_of(const TriangleMesh& dome, const Vector3d& core) {
  const auto rise =
      dome.triangles.empty() ? std::nullopt : TriangleTree(dome).farthest_hit(core, Vector3d::UnitZ());
  if (!rise) refuse_open_crown();
  return core + *rise * Vector3d::UnitZ();
}

}  // namespace

Head make_head(const TriangleMesh& mesh, const HeadPose& pose) {
  TriangleMesh turned = near_crown(head_mesh(mesh, pose.unit_mm), pose.up);
  if (is_face_scan(turned, pose.up))
    throw InvalidHead(
        "mesh",
        "the mesh shows one side of a head alone, as a scan of a face does. Give a mesh of the whole "
        "head, the direction of its top by `up`, or a goal of `kind: surface` with ribs");
  const Eigen::Isometry3d to_mesh = head_frame(turned, pose), to_head = to_mesh.inverse();
  for (Vector3d& p : turned.vertices) p = to_head * p;
  const Vector3d core(0, 0, -core_depth_mm);
  MeshSolid scan(turned);
  HeadDome dome = head_dome(scan, core);
  std::erase_if(dome.openings, [&](const DomeOpening& hole) { return hole.top_z < -pose.coverage_mm; });
  const Vector3d top = top_of(dome.mesh, core);
  const Plane sagittal(Vector3d::UnitX(), top);
  Head head{to_mesh,
            std::move(scan),
            MeshDistance(dome.mesh, core),
            curve_through(top, Vector3d::UnitY(), dome.mesh, sagittal),
            pose.coverage_mm,
            static_cast<double>(dome.closed) / static_cast<double>(dome.mesh.vertices.size()),
            dome.openings};
  check_coverage(head);
  return head;
}

SpaceCurve cross_section(const Head& head, double s, double reach) {
  const Vector3d p = head.profile.at(s);
  const Plane plane(head.profile.direction(s, reach), p);
  return curve_through(p, Vector3d::UnitX(), head.dome.mesh(), plane);
}

namespace {

void add_corners(const OrientedBox& box, const MeshSolid& solid, WallsInside& found) {
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d side(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const double distance = solid.distance(box.center + box.axes * side.cwiseProduct(box.half));
    if (!(distance < 0)) continue;
    ++found.corners;
    found.depth_mm = std::max(found.depth_mm, -distance);
  }
}

/// Whether each plate meets the solid. The plates of a body hang together at its vertex: where none of them
/// meets the skin, all lie on one side of it.
std::vector<bool> which_meet(const std::vector<model::HalfWall>& plates, const model::State& state,
                             const MeshSolid& solid) {
  std::vector<bool> meets(plates.size()), is_cut(state.size(), false), is_within(state.size(), false);
  for (std::size_t k = 0; k < plates.size(); ++k) {
    meets[k] = solid.tree().touches(placed(plates[k], state[plates[k].body]));
    if (meets[k]) is_cut[plates[k].body] = true;
  }
  for (std::size_t b = 0; b < state.size(); ++b) is_within[b] = !is_cut[b] && solid.contains(state[b].p);
  for (std::size_t k = 0; k < plates.size(); ++k) {
    const int body = plates[k].body;
    if (!meets[k])
      meets[k] = is_cut[body] ? solid.contains(placed(plates[k], state[body]).center) : is_within[body];
  }
  return meets;
}

}  // namespace

WallsInside walls_inside(const model::Linkage& structure, const model::State& state, const MeshSolid& solid) {
  WallsInside found;
  const std::vector<model::HalfWall> plates = half_walls(structure);
  const std::vector<bool> meets = which_meet(plates, state, solid);
  for (std::size_t k = 0; k < plates.size(); ++k) {
    if (!meets[k]) continue;
    const model::HalfWall& half = plates[k];
    const OrientedBox box = placed(half, state[half.body]);
    if (found.hinges.empty() || found.hinges.back() != half.hinge) found.hinges.push_back(half.hinge);
    add_corners(box, solid, found);
  }
  return found;
}

namespace {

// Range of the crown's coordinates, mm, as for points of curves.
const Bounds coordinate = from_to(-max_coordinate_mm, max_coordinate_mm, "mm");
const Bounds head_bounds = from_to(100, 300, "mm");  // of the length of a head: from a child's to a mascot's

// Words of the keys `up` and `front`: unit vectors in the mesh's axes.
const Word<Vector3d> axes[] = {
    {"x", Vector3d::UnitX()},   {"y", Vector3d::UnitY()},   {"z", Vector3d::UnitZ()},
    {"+x", Vector3d::UnitX()},  {"+y", Vector3d::UnitY()},  {"+z", Vector3d::UnitZ()},
    {"-x", -Vector3d::UnitX()}, {"-y", -Vector3d::UnitY()}, {"-z", -Vector3d::UnitZ()}};

/// Returns "+y" for the unit vector along y.
std::string axis_name(const Vector3d& axis) {
  Eigen::Index k = 0;
  axis.cwiseAbs().maxCoeff(&k);
  return std::string(axis[k] < 0 ? "-" : "+") + "xyz"[k];
}

Vector3d read_crown(const Node& crown) {
  const auto xyz = crown.list_of(3, "a point [x, y, z], in mm and in the mesh's axes");
  return {xyz[0].number(coordinate), xyz[1].number(coordinate), xyz[2].number(coordinate)};
}

/// Reads the pose of a mesh. Directions and units that the file leaves out follow from the mesh.
HeadPose read_pose(const Section& target, const FileMesh& file, std::vector<std::string>& notes) {
  HeadPose pose;
  if (target.optional("up"))
    target.read("up", pose.up, axes);
  else if (pose.up = likely_up(file.mesh); pose.up != Vector3d::UnitZ())
    notes.push_back("by its shape, the head points up along " + axis_name(pose.up) +
                    " of the mesh. Give `up` if this is wrong");
  const std::optional<double> unit = read_unit(target, "units");
  pose.unit_mm = unit.value_or(file.unit_mm.value_or(1));
  if (const auto length = target.optional("head_mm")) {
    if (unit) throw length->key_error("cannot be combined with `units`. Remove one of the two keys");
    pose.unit_mm = length->number(head_bounds) / head_length(file.mesh, pose.up);
  }
  target.read("front", pose.front, axes);
  if (const auto crown = target.optional("crown")) pose.crown = read_crown(*crown);
  target.read("coverage_mm", pose.coverage_mm);
  return pose;
}

}  // namespace

std::vector<Key> head_keys() {
  return {
      {"mesh", value::text(std::string("path of a mesh: ") + mesh_formats), needed, "a mesh of a head"},
      {"units", unit_type(), otherwise("the unit that the file names, or mm"),
       "unit of the mesh, or the mm in one unit of it"},
      {"head_mm", value::number(head_bounds), no_default,
       "length of the head from front to back, above nose and ears, for a mesh without a known unit. It "
       "replaces "
       "`units`"},
      {"up", value::choice(axes), otherwise("z, unless another axis fits a head better"),
       "axis of the mesh that points up"},
      {"front", value::choice(axes), otherwise("the direction in which the top of the head is longer"),
       "axis of the mesh that points to the face"},
      {"crown", value::list(value::number(coordinate), "`[x, y, z]`", 3, 3), otherwise("the highest point"),
       "point of the spine's middle, where the ribs meet, in mm and in the axes of the mesh"},
  };
}

Key coverage_key() {
  return {"coverage_mm", value::number(above(0, "mm")), by_default(HeadPose{}.coverage_mm),
          "height of the crown above the rim"};
}

Head read_head(const Section& target, const MeshReader& read) {
  const Node file = target.required("mesh", "the path of a mesh of a head");
  const FileMesh mesh = read_mesh_at(file, read);
  std::vector<std::string> notes;
  const HeadPose pose = read_pose(target, mesh, notes);
  try {
    Head head = make_head(mesh.mesh, pose);
    head.notes = std::move(notes);
    return head;
  } catch (const InvalidHead& e) {
    throw target.optional(e.key()).value_or(file).error(e.reason());
  }
}

}  // namespace kinetix::targets
