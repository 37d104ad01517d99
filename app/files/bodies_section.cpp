#include "app/files/bodies_section.hpp"

#include <fmt/format.h>
#include <cstdint>

#include "app/cad/cad_formats.hpp"
#include "app/files/cuts_section.hpp"
#include "app/files/file_header.hpp"
#include "app/files/process_section.hpp"
#include "app/models/model_file.hpp"
#include "model/assembly/assembly.hpp"
#include "model/assembly/shells.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;
using Eigen::Vector3d;

constexpr double unit_length = 1e-3;  // deviation of an axis's length from 1: rounding by a person
constexpr double square = 1e-2;       // limit of the cosine between an axis and the direction along the part
constexpr double default_reach = 0.18;  // cell edges, as for hinges of sheets
/// Kind of a joint as files name it.
enum class JointChoice { pin, block, film, ball };
constexpr targets::Word<JointChoice> joint_choices[] = {{"pin", JointChoice::pin},
                                                        {"block", JointChoice::block},
                                                        {"film", JointChoice::film},
                                                        {"ball", JointChoice::ball}};

// Degrees of a driven hinge: one angle cannot describe more than half a turn in either direction.
const targets::Bounds turn_bounds = targets::between(-180, 180, "degrees");
// Ratio of distances from the middle: almost to nothing, or a hundred times as far.
const targets::Bounds expand_bounds = targets::from_to(0.01, 100);
// Cell edges, rms distances from poses.
const targets::Bounds pull_bounds = targets::from_to(1e-9, 100, "cell edges");
// Range of a confidence, dimensionless.
const targets::Bounds share = targets::from_to(0, 1);

targets::ValueType vector_mm() { return value::list(value::number({.unit = "mm"}), "`[x, y, z]`", 3, 3); }
targets::ValueType direction() { return value::list(value::number(), "`[x, y, z]`", 3, 3); }

const targets::KeyTable& body_keys() {
  static const targets::KeyTable keys({
      {"name", value::text("its name, once in the file"), targets::needed,
       "name of the body in hinges and results"},
      {"file", value::text(std::string("path of a mesh: ") + targets::mesh_formats), targets::needed,
       "surface of the body at rest, mm, as one closed shell. The path is relative to this file"},
      {"position_mm", vector_mm(), targets::otherwise("the centre of its volume"),
       "reference point of the body in results"},
  });
  return keys;
}

const targets::KeyTable& k_keys() {
  const auto newtons = value::number(targets::above(0, "N/mm")),
             moments = value::number(targets::above(0, "N mm/rad"));
  static const targets::KeyTable keys({
      {"axial", newtons, targets::needed, "stiffness from body to body, across the hinge's axis"},
      {"shear", newtons, targets::needed, "stiffness across that direction and the axis"},
      {"along", newtons, targets::needed, "stiffness along the axis"},
      {"turn", moments, targets::needed, "rotation stiffness about the axis"},
      {"rock", moments, targets::otherwise("axial times `reach_mm` squared"),
       "stiffness about the direction across body to body and the axis"},
      {"twist", moments, targets::otherwise("shear times `reach_mm` squared"),
       "stiffness about the direction from body to body"},
  });
  return keys;
}

const targets::KeyTable& joint_keys() {
  static const targets::KeyTable keys({
      {"name", value::text("its name, once in the file"), targets::needed,
       "name of the hinge in the drive and results"},
      {"bodies", value::list(value::text("name of a body"), "`[name, name]`", 2, 2), targets::needed,
       "the two bodies that it joins"},
      {"kind", value::choice(joint_choices), targets::by_default("block"),
       "`block`: a soft part. `film`: a living hinge or a bridge. `pin`: a revolute joint. `ball`: a "
       "spherical "
       "joint"},
      {"point_mm", vector_mm(), targets::needed, "point on the axis, at rest"},
      {"axis", direction(), targets::needed, "direction of the axis, of length 1, at rest"},
      {"along", direction(), targets::otherwise("square to the axis, from body to body"),
       "direction in which the soft part reaches from its first body to the second, of length 1"},
      {"reach_mm", value::number(targets::above(0, "mm")), targets::otherwise("0.18 of `cell_mm`"),
       "half the distance of the two points on the axis at which the hinge joins its bodies"},
      {"k", value::map(k_keys()), {}, "stiffness of a soft hinge"},
      {"diameter_mm", value::number(targets::above(0, "mm")), {}, "diameter of a pin's rod"},
      {"clearance_mm", value::number(targets::at_least(0, "mm")), targets::by_default(0.0),
       "clearance between rod and bore of a pin, per side"},
      {"confidence", value::number(share), targets::by_default(1),
       "reliability of the axis: 1 minus the stiffness about it over that about the next axis"},
      {"file",
       value::text(std::string("path of a mesh: ") + targets::mesh_formats),
       {},
       "the surface of its soft part at rest"},
  });
  return keys;
}

const targets::KeyTable& bodies_structure_keys() {
  static const targets::KeyTable keys({
      {"cell_mm", value::number(targets::above(0, "mm")),
       targets::otherwise("the median distance of two bodies that share a hinge"),
       "unit length of gaps and distances"},
      {"bodies", value::list(value::map(body_keys()), "a list of bodies", 2), targets::needed,
       "rigid bodies of any shape"},
      {"hinges", value::list(value::map(joint_keys()), "a list of hinges", 1), targets::needed,
       "hinges between the bodies"},
  });
  return keys;
}

const targets::KeyTable& turn_keys() {
  static const targets::KeyTable keys({
      {"hinge", value::text("name of a hinge"),
       targets::otherwise("the one that turns most in the first motion"), "the hinge that is turned"},
      {"angle_deg",
       value::angle(turn_bounds),
       {},
       "rotation of the second body relative to the first, about the axis"},
      {"poses",
       value::list(value::list(value::number(), "`[x, y, z, qw, qx, qy, qz]`", 7, 7), "a list of poses", 2),
       {},
       "poses to which bodies are pulled, instead of a turned hinge: one per body in their order, in mm and "
       "the quaternion of the rotation from rest"},
      {"expand",
       value::number(expand_bounds),
       {},
       "alternative to poses: pulls bodies to this multiple of their distance from the middle, as far as "
       "hinges allow"},
  });
  return keys;
}

const targets::KeyTable& tolerance_keys() {
  static const targets::KeyTable keys({
      {"pull", value::number(pull_bounds), targets::by_default(0.05),
       "largest distance of bodies from `drive.poses` in the end, rms over points half a cell edge from "
       "their "
       "positions, cell edges"},
  });
  return keys;
}

Vector3d read_vector(const targets::Node& node, const char* what) {
  const auto entries = node.list_of(3, what);
  return {entries[0].number(), entries[1].number(), entries[2].number()};
}

Vector3d read_direction(const targets::Node& node) {
  const Vector3d v = read_vector(node, "a direction [x, y, z] of length 1");
  if (!(std::abs(v.norm() - 1) <= unit_length))
    throw node.error(fmt::format("the vector has length {:.4g}. Give a direction of length 1", v.norm()));
  return v.normalized();
}

model::Polyhedron read_shell(const targets::Node& node) {
  const std::string file = node.text("path of a mesh");
  const targets::FileMesh read = read_mesh_at(node, read_mesh_file);
  model::Polyhedron solid{read.mesh.vertices, read.mesh.triangles};
  for (Vector3d& p : solid.points) p *= read.unit_mm.value_or(1);
  const std::string defect = model::shell_defect(solid);
  if (!defect.empty()) throw node.error("`" + file + "` " + defect);
  return solid;
}

class BodiesReader {
 public:
  explicit BodiesReader(targets::Section structure) : structure_(std::move(structure)) {}

  model::Assembly read() {
    for (const targets::Node& node :
         structure_.required("bodies", "a list of bodies").list("a list of bodies"))
      add_body(node);
    for (const targets::Node& node :
         structure_.required("hinges", "a list of hinges").list("a list of hinges"))
      add_hinge(node);
    out_.edge_mm = hinge_distance(out_);
    structure_.read("cell_mm", out_.edge_mm);
    for (model::AssemblyHinge& h : out_.hinges)
      if (h.reach_mm == 0) h.reach_mm = default_reach * out_.edge_mm;
    return std::move(out_);
  }

 private:
  void add_body(const targets::Node& node) {
    const targets::Section section(node, body_keys());
    model::AssemblyBody body;
    const targets::Node name = section.required("name", "its name");
    body.name = usable_name(name);
    if (!body_of_.try_emplace(body.name, static_cast<int>(out_.bodies.size())).second)
      throw name.error("two bodies have this name. Rename one of them");
    body.solid = read_shell(section.required("file", "the file of its surface, e.g. `parts/body_1.stl`"));
    body.position = model::mass_properties(body.solid).center;
    if (const auto position = section.optional("position_mm"))
      body.position = read_vector(*position, "a point [x, y, z], mm");
    out_.bodies.push_back(std::move(body));
  }

  int body_of(const targets::Node& node) const {
    const auto found = body_of_.find(node.text("name of a body"));
    if (found == body_of_.end()) throw node.error("the file has no such body. Give the name of a body");
    return found->second;
  }

  void add_hinge(const targets::Node& node) {
    const targets::Section section(node, joint_keys());
    model::AssemblyHinge hinge;
    const targets::Node name = section.required("name", "its name");
    hinge.name = usable_name(name);
    if (std::find(out_hinges_.begin(), out_hinges_.end(), hinge.name) != out_hinges_.end())
      throw name.error("two hinges have this name. Rename one of them");
    const targets::Node bodies = section.required("bodies", "the names of its two bodies");
    const auto ends = bodies.list_of(2, "the names of its two bodies");
    hinge.lower = body_of(ends[0]);
    hinge.upper = body_of(ends[1]);
    if (hinge.lower == hinge.upper) throw bodies.error("the hinge joins a body with itself. Give two bodies");
    JointChoice kind = JointChoice::block;
    section.read("kind", kind, joint_choices);
    hinge.kind = kind == JointChoice::block  ? model::HingeKind::block
                 : kind == JointChoice::film ? model::HingeKind::film
                                             : model::HingeKind::pin;
    hinge.ball = kind == JointChoice::ball;
    hinge.point =
        read_vector(section.required("point_mm", "a point on its axis, mm"), "a point [x, y, z], mm");
    hinge.axis = read_direction(section.required("axis", "its axis, of length 1"));
    hinge.along = direction_of(section, hinge);
    hinge.reach_mm = 0;
    section.read("reach_mm", hinge.reach_mm);
    if (const targets::Section k = section.section("k"); k.given()) {
      k.read_needed("axial", "a stiffness in N/mm", hinge.k.axial);
      k.read_needed("shear", "a stiffness in N/mm", hinge.k.shear);
      k.read_needed("along", "a stiffness in N/mm", hinge.k.along);
      k.read_needed("turn", "a stiffness in N mm/rad", hinge.k.turn);
      k.read("rock", hinge.k.rock);
      k.read("twist", hinge.k.twist);
    }
    section.read("diameter_mm", hinge.rod_mm);
    section.read("clearance_mm", hinge.clearance_mm);
    section.read("confidence", hinge.confidence);
    if (const auto file = section.optional("file")) hinge.soft = read_shell(*file);
    if (!hinge.soft.points.empty() && body_of_.contains(hinge.name))
      throw name.error("a body has the same name. Rename one of them: names are also names of files");
    out_hinges_.push_back(hinge.name);
    out_.hinges.push_back(std::move(hinge));
  }

  Vector3d direction_of(const targets::Section& section, const model::AssemblyHinge& hinge) const {
    if (const auto along = section.optional("along")) {
      const Vector3d d = read_direction(*along);
      if (!(std::abs(d.dot(hinge.axis)) <= square))
        throw along->error("the direction is not perpendicular to the axis. Give a perpendicular one");
      return (d - d.dot(hinge.axis) * hinge.axis).normalized();
    }
    return model::direction_across(out_.bodies[hinge.upper].position - out_.bodies[hinge.lower].position,
                                   hinge.axis);
  }

  const targets::Section structure_;
  model::Assembly out_;
  std::map<std::string, int> body_of_;
  std::vector<std::string> out_hinges_;
};

std::string vector_text(const Vector3d& v) {
  using targets::shortest_text;
  return "[" + shortest_text(v.x() + 0.0) + ", " + shortest_text(v.y() + 0.0) + ", " +
         shortest_text(v.z() + 0.0) + "]";
}

/// Formats the stiffness. Of the tilts it has only those that do not follow from the hinge's reach.
std::string k_text(const model::HingeStiffness& k) {
  using targets::shortest_text;
  std::string out = fmt::format("{{axial: {}, shear: {}, along: {}, turn: {}", shortest_text(k.axial),
                                shortest_text(k.shear), shortest_text(k.along), shortest_text(k.turn));
  if (k.rock) out += ", rock: " + shortest_text(*k.rock);
  if (k.twist) out += ", twist: " + shortest_text(*k.twist);
  return out + "}";
}

std::string hinge_line(const model::Assembly& a, const model::AssemblyHinge& h) {
  using targets::shortest_text;
  std::string out =
      fmt::format("    - {{name: {}, bodies: [{}, {}], kind: {}, point_mm: {}, axis: {}, along: {}", h.name,
                  a.bodies[h.lower].name, a.bodies[h.upper].name, h.ball ? "ball" : to_string(h.kind),
                  vector_text(h.point), vector_text(h.axis), vector_text(h.along));
  if (h.ball) return out + "}\n";
  out += fmt::format(", reach_mm: {}, k: {}, confidence: {:.4g}", shortest_text(h.reach_mm), k_text(h.k),
                     h.confidence);
  if (h.rod_mm > 0)
    out += fmt::format(", diameter_mm: {}, clearance_mm: {}", shortest_text(h.rod_mm),
                       shortest_text(h.clearance_mm));
  if (!h.soft.points.empty()) out += ", file: parts/" + h.name + ".stl";
  return out + "}\n";
}

std::string poses_text(const model::State& poses) {
  using targets::shortest_text;
  std::string out = "drive:\n  poses:\n";
  for (const model::Pose& pose : poses) {
    const Eigen::Quaterniond q(pose.R);
    out += fmt::format("    - [{}, {}, {}, {}, {}, {}, {}]\n", shortest_text(pose.p.x()),
                       shortest_text(pose.p.y()), shortest_text(pose.p.z()), shortest_text(q.w()),
                       shortest_text(q.x()), shortest_text(q.y()), shortest_text(q.z()));
  }
  return out;
}

model::Pose read_pose(const targets::Node& node) {
  constexpr const char* what = "a pose [x, y, z, qw, qx, qy, qz], mm and a quaternion of length 1";
  const auto n = node.list_of(7, what);
  const Eigen::Quaterniond q(n[3].number(), n[4].number(), n[5].number(), n[6].number());
  if (!(std::abs(q.norm() - 1) <= unit_length))
    throw node.error(fmt::format("the quaternion has length {:.4g}. Give one of length 1", q.norm()));
  return {q.normalized().toRotationMatrix(), {n[0].number(), n[1].number(), n[2].number()}};
}

model::State read_poses(const targets::Node& node, std::size_t bodies) {
  model::State out;
  for (const targets::Node& pose : node.list("a list of poses")) out.push_back(read_pose(pose));
  if (out.size() != bodies)
    throw node.error(
        fmt::format("the list has {} poses, and the structure has {} bodies. Give one pose per body",
                    out.size(), bodies));
  return out;
}

int find_joint(const model::Assembly& bodies, const targets::Node& node) {
  const std::string name = node.text("name of a hinge");
  for (std::size_t h = 0; h < bodies.hinges.size(); ++h)
    if (bodies.hinges[h].name == name) return static_cast<int>(h);
  throw node.error("the file has no such hinge. Give the name of a hinge");
}

/// Reads the drive of a design of bodies.
void read_bodies_drive(const targets::Section& drive, Design& design) {
  const auto poses = drive.optional("poses"), expand = drive.optional("expand");
  if (poses && expand) throw expand->error("cannot be combined with `poses`. Remove one of the two keys");
  for (const char* key : {"hinge", "angle_deg"})
    if (const auto turned = drive.optional(key); turned && (poses || expand))
      throw turned->error(
          fmt::format("cannot be combined with `{}`, which pulls bodies. Remove one of the two keys",
                      poses ? "poses" : "expand"));
  if (poses || expand) {
    model::BodyPull pull;
    if (poses) pull.poses = read_poses(*poses, design.structure.assembly()->bodies.size());
    drive.read("expand", pull.expand);
    design.drive = pull;
    return;
  }
  model::HingeTurn turn{-1, 0};
  if (const auto hinge = drive.optional("hinge")) {
    turn.hinge = find_joint(*design.structure.assembly(), *hinge);
    if (design.structure.assembly()->hinges[turn.hinge].ball)
      throw hinge->error("a ball has no axis of rotation. Give another hinge");
  }
  const auto angle = drive.optional("angle_deg");
  if (!angle)
    throw drive.error(
        "the drive has no goal. Give `angle_deg` for a hinge, or `poses` or `expand` for bodies");
  turn.angle = angle->angle(turn_bounds);
  design.drive = turn;
}

}  // namespace

const targets::KeyTable& bodies_keys() {
  static const targets::KeyTable keys = file_keys({
      {"structure", value::either({value::map(bodies_structure_keys()), value::map(cuts_keys())}),
       targets::needed, "its bodies and hinges at rest, or a sheet with cuts"},
      {"drive",
       value::map(turn_keys()),
       {},
       "actuation. Without it bodies stay at rest, and the pieces of a sheet with cuts are pulled apart"},
      design_process_key(),
      {"tolerance", value::map(tolerance_keys()), {}, "limits for a met goal"},
  });
  return keys;
}

bool lists_bodies(const targets::Node& root) {
  if (root.kind() != targets::Node::Kind::map) return false;
  const auto structure = root.optional("structure");
  return structure && structure->kind() == targets::Node::Kind::map &&
         (structure->optional("bodies") || structure->optional("cuts"));
}

Design read_bodies(const targets::Node& node) {
  const targets::Section root(node, bodies_keys());
  check_version(root);
  Design design{.name = read_name(root), .structure = {}};
  const targets::Node structure = root.required("structure", "a section");
  if (structure.optional("bodies")) {
    design.process = read_process(root);
    design.structure =
        model::Lattice(BodiesReader(targets::Section(structure, bodies_structure_keys())).read());
  } else {
    read_cuts(root, design);
  }
  if (const targets::Section drive = root.section("drive"); drive.given()) read_bodies_drive(drive, design);
  if (const targets::Section tolerance = root.section("tolerance"); tolerance.given()) {
    auto* pull = design.drive ? std::get_if<model::BodyPull>(&*design.drive) : nullptr;
    if (const auto given = tolerance.optional("pull"); given && !(pull && pull->poses))
      throw given->error(
          "only applies to bodies that are pulled to `drive.poses`. Add `drive.poses`, or remove the key");
    if (pull && pull->poses) tolerance.read("pull", pull->tolerance, pull_bounds);
  }
  return design;
}

namespace {

std::string listed_bodies_text(const model::Assembly& a) {
  std::string out = fmt::format("structure:\n  cell_mm: {}\n  bodies:\n", targets::shortest_text(a.edge_mm));
  for (const model::AssemblyBody& b : a.bodies)
    out += fmt::format("    - {{name: {}, file: parts/{}.stl, position_mm: {}}}\n", b.name, b.name,
                       vector_text(b.position));
  out += "  hinges:\n";
  for (const model::AssemblyHinge& h : a.hinges) out += hinge_line(a, h);
  return out;
}

}  // namespace

std::string bodies_text(const Design& design) {
  const model::Assembly& a = *design.structure.assembly();
  std::string out = fmt::format("kinetix: 1\nname: {}\n", design.name) +
                    (design.cuts ? cuts_text(design) : listed_bodies_text(a));
  if (!design.cuts && design.process != model::processes().front())
    out += "process: " + process_text(design.process) + "\n";
  if (const model::BodyPull* pull = body_pull_of(design)) {
    if (!pull->poses)
      return out + fmt::format("drive: {{expand: {}}}\n", targets::shortest_text(*pull->expand));
    if (pull->tolerance != model::BodyPull{}.tolerance)
      out += fmt::format("tolerance: {{pull: {}}}\n", targets::shortest_text(pull->tolerance));
    return out + poses_text(*pull->poses);
  }
  const model::HingeTurn* turn = turn_of(design);
  if (!turn) return out;
  const std::string hinge = turn->hinge < 0 ? "" : fmt::format("hinge: {}, ", a.hinges[turn->hinge].name);
  return out + fmt::format("drive: {{{}angle_deg: {}}}\n", hinge, targets::degrees_text(turn->angle));
}

std::vector<NamedContent> design_files(const Design& design) {
  std::vector<NamedContent> out{{"design.yaml", design_text(design)}};
  const model::Assembly* a = design.structure.assembly();
  if (!a) return out;
  if (design.cuts) {
    out.push_back(cuts_file(design));
    return out;
  }
  for (const model::AssemblyBody& b : a->bodies)
    out.push_back({"parts/" + b.name + ".stl", stl_text(b.name, b.solid)});
  for (const model::AssemblyHinge& h : a->hinges)
    if (!h.soft.points.empty()) out.push_back({"parts/" + h.name + ".stl", stl_text(h.name, h.soft)});
  return out;
}

}  // namespace kinetix::app
