#pragma once

#include "model/linkage/state.hpp"
#include "targets/curve/space_curve.hpp"
#include "targets/document/section.hpp"
#include "targets/helmet/head_pose.hpp"
#include "targets/mesh/mesh_file.hpp"
#include "targets/mesh/mesh_solid.hpp"
#include "targets/mesh/triangle_tree.hpp"

namespace kinetix::targets {

/// Part of the dome that is invented because the mesh is open there.
struct DomeOpening {
  double width_mm = 0;  ///< across, at its widest
  double top_z = 0;     ///< of its highest place, mm, in the frame of the head that was given
};

/// Outer envelope of the top of a head as one clean sheet. It joins the outermost places in all directions from an
/// inner point, down to dome_angle from above. The directions are evenly spread over a sphere, about one per square
/// degree. Inner shells, doubled and flipped triangles are gone, and holes are closed. Thin ears protrude as in the
/// mesh.
struct HeadDome {
  TriangleMesh mesh;                  ///< mm; no holes, edges shared by at most two triangles, wound outward
  int closed = 0;                     ///< vertices of the mesh that lie over holes
  std::vector<DomeOpening> openings;  ///< those holes
};

/// End of the dome, rad from straight up as seen from the inner point: 30 deg below level. At 80 mm from that point it
/// is then 115 mm below the crown, past the default coverage.
inline constexpr double dome_angle = 120 * 3.14159265358979323846 / 180;

/// Finds the dome. Holes are closed by the membrane of the distance from the inner point. A hole that reaches the
/// dome's boundary is left open.
/// @param core the inner point, mm, z up
HeadDome head_dome(const MeshSolid& head, const Eigen::Vector3d& core);

/// Depth below the crown, mm, of the point from which the head's top is seen. It is half the breadth of a man's head,
/// so sides and top are about equally far from it.
inline constexpr double core_depth_mm = 75;

/// A head, mm, in the head frame: origin at the crown as it was given or found, z up, y to the front, x to
/// the head's right.
struct Head {
  /// Head frame to the axes of the mesh file (in mm).
  Eigen::Isometry3d to_mesh;
  /// Solid that the whole mesh encloses, without parts that float next to it: the head as given.
  MeshSolid scan;
  /// The top of the head as one clean sheet without holes (head_dome()).
  MeshDistance dome;
  /// Section of the dome by the sagittal plane x = 0, from the back to the front; 0 above (or below) the origin.
  SpaceCurve profile;
  double coverage_mm;  ///< how far below the crown the head is to be covered
  /// Part of the dome's vertices that lie over holes of the scan, [0, 1].
  double closed_part;
  std::vector<DomeOpening> openings;    ///< holes above the coverage
  std::vector<std::string> notes = {};  ///< what was guessed about the mesh, one sentence each
};

/// Finds crown, dome and profile.
/// @throws InvalidHead for what head_mesh and head_frame refuse, and for a head that is open at its crown. It also
/// throws for a coverage that the dome does not reach, along the profile or across it at the crown.
/// @pre at least one triangle, finite vertices
Head make_head(const TriangleMesh& mesh, const HeadPose& pose);

/// Computes the section of the dome by the plane across its profile at arc length s, mm, from the left (x < 0) to the
/// right; 0 at the profile. It ends at the end of the dome; a closed one is cut open opposite to the profile.
/// @param reach the plane's normal is the profile's direction over s - reach to s + reach, mm, > 0
/// @pre s on the profile
SpaceCurve cross_section(const Head& head, double s, double reach);

/// Walls of a folded structure that lie in a solid, wholly or in part.
struct WallsInside {
  std::vector<int> hinges;  ///< of these walls, ascending
  int corners = 0;      ///< of the two plates that make a wall (half_wall.hpp), eight each, that lie inside
  double depth_mm = 0;  ///< of the deepest corner; 0 where a solid pokes through a wall between its corners
};

/// @param state of the structure, in the frame of the solid
WallsInside walls_inside(const model::Linkage& structure, const model::State& state, const MeshSolid& solid);

/// Returns the keys of a target section that describe the head and its pose, except coverage_mm.
std::vector<Key> head_keys();
Key coverage_key();

/// Reads the head of a target section. `mesh` is a file relative to the document's folder. All other keys are optional:
///   - `units`: mm, cm, dm, m, in or a number of mm; by default that of the file, or mm.
///   - `head_mm`: length of the head, in place of `units`.
///   - `up` and `front`: x, -x, +x, y, ...; by default found by the shape, and the axis along which the head is longer.
///   - `crown`: [x, y, z] in mm and in the mesh's axes; default the highest point.
///   - `coverage_mm`: depth below the crown; default 90.
/// @throws InvalidInput at the key at fault for what read_mesh and make_head refuse
Head read_head(const Section& target, const MeshReader& read = read_plain_mesh);

}  // namespace kinetix::targets
