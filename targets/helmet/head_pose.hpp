#pragma once

#include <optional>

#include "model/base/invalid_input.hpp"
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
/// mm. Larger meshes up to this are whole bodies, of which the part near the crown is taken.
inline constexpr double max_body_mm = 2300;

/// Pose of a head in its mesh. The axes are those of the mesh file.
struct HeadPose {
  double unit_mm = 1;                             ///< mm in one unit of the mesh
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
  /// mesh, units, up, front, crown or coverage_mm
  const std::string& key() const { return key_; }

 private:
  std::string key_;
};

/// Returns the mesh in mm, without parts that float next to it.
/// @throws InvalidHead for a size that no head has; it names the unit that would fit
/// @pre at least one triangle, finite vertices
TriangleMesh head_mesh(const TriangleMesh& mesh, double unit_mm);

/// Returns the part of a whole body near its crown, or a smaller mesh as it is. Both in mm.
/// @param up unit vector along an axis
TriangleMesh near_crown(const TriangleMesh& mesh, const Eigen::Vector3d& up);

/// Length of a head from front to back, in the units of its mesh. It is the longer side of the box of the part above
/// a depth of 0.4 of that length, which lies above nose and ears.
double head_length(const TriangleMesh& mesh, const Eigen::Vector3d& up);

/// Finds the direction that points up in a mesh of a head: the axis along which its sections below the top fit a usual
/// head best. Another axis than +z must fit clearly better than the other five.
/// @param mesh of a head, in any unit   @return unit vector along an axis
Eigen::Vector3d likely_up(const TriangleMesh& mesh);

/// Whether a mesh shows one side of a head alone, as a scan of a face does. @param up unit vector
bool is_face_scan(const TriangleMesh& mesh, const Eigen::Vector3d& up);

/// Head frame (origin at the crown, z up, y to the front, x to the head's right) to the axes of the mesh.
/// @param mesh what head_mesh gave
/// @throws InvalidHead for a front that is not across up, a crown farther than crown_reach_mm from the mesh
Eigen::Isometry3d head_frame(const TriangleMesh& mesh, const HeadPose& pose);

}  // namespace kinetix::targets
