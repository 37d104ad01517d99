#pragma once

#include <optional>

#include "model/base/invalid_input.hpp"
#include "targets/document/keys.hpp"
#include "targets/mesh/triangle_mesh.hpp"

namespace kinetix::targets {

/// mm, largest side of the box of a head mesh (shoulders included). A head of 250 mm lies outside where
/// its file, in mm, cm or m, is read as in another of these.
inline constexpr double min_head_mm = 100, max_head_mm = 1000;
/// mm below the crown: above the ears of a usual head (tragion lies some 130 mm below the top).
inline constexpr double default_coverage_mm = 90;
/// mm. A crown that is given may lie this far from the mesh: one read off by hand does; one farther away is
/// in another unit or in other axes.
inline constexpr double crown_reach_mm = 15;
enum class LengthUnit { mm, cm, m, inch };
/// Millimetres in one of the unit.
double mm_per(LengthUnit unit);

/// Pose of a head in its mesh. The axes are those of the mesh file.
struct HeadPose {
  LengthUnit unit = LengthUnit::mm;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit vector along an axis
  /// Front of the head, a unit vector along another axis; empty: the axis along which the top of the head is longer.
  std::optional<Eigen::Vector3d> front = {};
  std::optional<Eigen::Vector3d> crown = {};  ///< mm; nothing: the highest point
  double coverage_mm = default_coverage_mm;
};

/// Bad input that one key of a head's description shows.
class InvalidHead : public InvalidInput {
 public:
  InvalidHead(const std::string& key, const std::string& fault_text) : InvalidInput(fault_text), key_(key) {}
  /// mesh, units, front, crown or coverage_mm
  const std::string& key() const { return key_; }

 private:
  std::string key_;
};

/// Returns the mesh in mm, without parts that float next to it.
/// @throws InvalidHead for a size that no head has; it names the unit that would fit
/// @pre at least one triangle, finite vertices
TriangleMesh head_mesh(const TriangleMesh& mesh, LengthUnit unit);

/// Head frame (origin at the crown, z up, y to the front, x to the head's right) to the axes of the mesh.
/// @param mesh what head_mesh gave
/// @throws InvalidHead for a front that is not across up, a crown farther than crown_reach_mm from the mesh
Eigen::Isometry3d head_frame(const TriangleMesh& mesh, const HeadPose& pose);

/// The units of a mesh, as files name them.
inline constexpr Word<LengthUnit> length_units[] = {
    {"mm", LengthUnit::mm}, {"cm", LengthUnit::cm}, {"m", LengthUnit::m}, {"in", LengthUnit::inch}};

}  // namespace kinetix::targets
