#pragma once

#include <optional>
#include <string>

#include "model/invalid_input.hpp"
#include "targets/mesh_distance.hpp"
#include "targets/space_curve.hpp"

namespace kinetix {

/// Largest side of the box of a head mesh (shoulders included), mm.
inline constexpr double least_head_mm = 100, most_head_mm = 1000;
inline constexpr double default_coverage_mm = 90;
/// A crown that is given may lie this far from the mesh, mm.
inline constexpr double crown_reach_mm = 15;
/// Depth below the crown of the point from which the head's top is seen: half the breadth of a man's head.
inline constexpr double core_depth_mm = 75;

enum class LengthUnit { mm, cm, m, inch };
double mm_per(LengthUnit unit);

/// How a mesh is a head. The axes are those of the mesh file.
struct HeadPose {
  LengthUnit unit = LengthUnit::mm;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< along an axis
  /// Along another axis; nothing: whichever way the top of the head is longer.
  std::optional<Eigen::Vector3d> front = {};
  std::optional<Eigen::Vector3d> crown = {};  ///< mm; nothing: the highest point
  double coverage_mm = default_coverage_mm;
};

/// Bad input that one key of a head's description shows.
class InvalidHead : public InvalidInput {
 public:
  InvalidHead(const std::string& key, const std::string& what_is_wrong)
      : InvalidInput(what_is_wrong), key_(key) {}
  /// mesh, units, front, crown or coverage_mm
  const std::string& key() const { return key_; }

 private:
  std::string key_;
};

/// A head, mm, in the head frame: origin at the crown as it was given or found, z up, y to the front, x to
/// the head's right.
struct Head {
  /// Head frame to the axes of the mesh file (in mm).
  Eigen::Isometry3d to_mesh;
  /// The whole mesh but for parts that float beside it. Its distances are those of the head that was given;
  /// over holes they are those of their rims.
  MeshDistance scan;
  /// The top of the head as one clean sheet without holes (head_dome.hpp).
  MeshDistance dome;
  /// Section of the dome by the sagittal plane x = 0, from the back to the front; 0 above (or below) the
  /// origin.
  SpaceCurve profile;
  double coverage_mm;
  /// Part of the dome's vertices that lie over holes of the scan.
  double closed_part;
};

/// Finds crown, dome and profile.
/// @throws InvalidHead for a mesh too small or too large to be a head (it names the unit that would do), a
/// front that is not across up, a crown farther than crown_reach_mm from the mesh, a coverage that the dome
/// does not reach, along the profile or across it at the crown
/// @pre at least one triangle, finite vertices
Head make_head(const TriangleMesh& mesh, const HeadPose& pose);

/// Section of the dome by the plane across its profile at arc length s, from the left (x < 0) to the right; 0
/// at the profile. It ends where the dome does; a closed one is cut open opposite to the profile.
/// @param reach the plane's normal is the profile's direction over s - reach to s + reach, mm, > 0
/// @pre s on the profile
SpaceCurve cross_section(const Head& head, double s, double reach);

}  // namespace kinetix
