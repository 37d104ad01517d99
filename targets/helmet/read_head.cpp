#include "targets/helmet/read_head.hpp"

#include <filesystem>

#include "targets/curve/read_curve.hpp"
#include "targets/document/hidden_quotes.hpp"
#include "targets/helmet/length_units.hpp"
#include "targets/mesh/mesh_file.hpp"

namespace kinetix::targets {
namespace {

using Eigen::Vector3d;

// Range of the crown's coordinates, mm, as for points of curves.
const Bounds coordinate = from_to(-max_coordinate_mm, max_coordinate_mm, "mm");
TriangleMesh read_mesh_of(const Node& mesh) {
  const std::string name = mesh.text("the path of an OBJ, STL or PLY file");
  const std::string file = (std::filesystem::path(mesh.folder()) / name).string();
  const HiddenQuotes hidden(file, mesh.folder());
  try {
    return read_mesh(file);
  } catch (const InvalidInput& e) {
    throw mesh.error(e.what());
  }
}

// Words of the keys `up` and `front`: unit vectors in the mesh's axes.
const Word<Vector3d> axes[] = {
    {"x", Vector3d::UnitX()},   {"y", Vector3d::UnitY()},   {"z", Vector3d::UnitZ()},
    {"+x", Vector3d::UnitX()},  {"+y", Vector3d::UnitY()},  {"+z", Vector3d::UnitZ()},
    {"-x", -Vector3d::UnitX()}, {"-y", -Vector3d::UnitY()}, {"-z", -Vector3d::UnitZ()}};

Vector3d read_crown(const Node& crown) {
  const auto xyz = crown.list_of(3, "a point [x, y, z], in mm and in the mesh's axes");
  return {xyz[0].number(coordinate), xyz[1].number(coordinate), xyz[2].number(coordinate)};
}

HeadPose read_pose(const Section& target) {
  HeadPose pose;
  target.read("units", pose.unit, length_units);
  target.read("up", pose.up, axes);
  target.read("front", pose.front, axes);
  if (const auto crown = target.optional("crown")) pose.crown = read_crown(*crown);
  target.read("coverage_mm", pose.coverage_mm);
  return pose;
}

}  // namespace

std::vector<Key> head_keys() {
  return {
      {"mesh", value::text("path of an OBJ, STL or PLY file"), needed, "a mesh of a head"},
      {"units", value::choice(length_units), by_default("mm"), "of the mesh"},
      {"up", value::choice(axes), by_default("z"), "axis of the mesh that points up"},
      {"front", value::choice(axes), otherwise("whichever way the top of the head is longer"),
       "axis of the mesh that points to the face"},
      {"crown", value::list(value::number(coordinate), "`[x, y, z]`", 3, 3), otherwise("the highest point"),
       "where the ribs meet the spine's middle, in mm and in the mesh's axes"},
  };
}

Key coverage_key() {
  return {"coverage_mm", value::number(above(0, "mm")), by_default(HeadPose{}.coverage_mm),
          "how far below the crown the rim is"};
}

Head read_head(const Section& target) {
  const Node file = target.required("mesh", "the path of an OBJ, STL or PLY file of a head");
  const HeadPose pose = read_pose(target);
  const TriangleMesh mesh = read_mesh_of(file);
  try {
    return make_head(mesh, pose);
  } catch (const InvalidHead& e) {
    throw target.optional(e.key()).value_or(file).error(e.reason());
  }
}

}  // namespace kinetix::targets
