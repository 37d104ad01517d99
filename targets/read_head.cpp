#include "targets/read_head.hpp"

#include <filesystem>

#include "targets/mesh_file.hpp"
#include "targets/read_curve.hpp"

namespace kinetix {
namespace {

using Eigen::Vector3d;

TriangleMesh read_mesh_of(const Node& mesh) {
  const std::string name = mesh.text("the path of an OBJ, STL or PLY file");
  try {
    return read_mesh((std::filesystem::path(mesh.folder()) / name).string());
  } catch (const InvalidInput& e) {
    throw mesh.error(e.what());
  }
}

Vector3d read_axis(const Node& axis) {
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  return axis.choice<Vector3d>(
      {{"x", x}, {"y", y}, {"z", z}, {"+x", x}, {"+y", y}, {"+z", z}, {"-x", -x}, {"-y", -y}, {"-z", -z}});
}

Vector3d read_crown(const Node& crown) {
  const Bounds coordinate = from_to(-max_coordinate_mm, max_coordinate_mm, "mm");
  const auto xyz = crown.list_of(3, "a point [x, y, z], in mm and in the mesh's axes");
  return {xyz[0].number(coordinate), xyz[1].number(coordinate), xyz[2].number(coordinate)};
}

HeadPose read_pose(const Node& target) {
  HeadPose pose;
  if (const auto units = target.optional("units"))
    pose.unit = units->choice<LengthUnit>(
        {{"mm", LengthUnit::mm}, {"cm", LengthUnit::cm}, {"m", LengthUnit::m}, {"in", LengthUnit::inch}});
  if (const auto up = target.optional("up")) pose.up = read_axis(*up);
  if (const auto front = target.optional("front")) pose.front = read_axis(*front);
  if (const auto crown = target.optional("crown")) pose.crown = read_crown(*crown);
  if (const auto coverage = target.optional("coverage_mm"))
    pose.coverage_mm = coverage->number(above(0, "mm"));
  return pose;
}

}  // namespace

Head read_head(const Node& target) {
  const Node file = target.required("mesh", "the path of an OBJ, STL or PLY file of a head");
  const HeadPose pose = read_pose(target);
  const TriangleMesh mesh = read_mesh_of(file);
  try {
    return make_head(mesh, pose);
  } catch (const InvalidHead& e) {
    throw target.optional(e.key()).value_or(file).error(e.reason());
  }
}

}  // namespace kinetix
