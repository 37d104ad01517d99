#pragma once

#include "targets/document/section.hpp"
#include "targets/fold/fold_net.hpp"
#include "targets/fold/solid.hpp"
#include "targets/mesh/mesh_file.hpp"

namespace kinetix::targets {

/// Returns the names of a box's faces: bottom, top, front, back, left, right, in this order.
const std::vector<std::string>& box_face_names();
/// Returns the axis that a face is normal to: 0, 1, 2 for x, y, z. @param face position in box_face_names
int box_face_axis(int face);

/// Returns all ways to cut a box open into one flat piece, no two congruent (11 for a cube), all folds 90 degrees.
/// Nets whose faces are the fewest folds apart come first; ties go to the smallest bounding rectangle. The first face
/// of each net is the bottom, or the next one in order if the bottom is open.
/// @param edges cells along x, y, z: the bottom has edges[0] x edges[1]
/// @param open index of a face that is left out
std::vector<FoldNet> box_unfoldings(const std::array<int, 3>& edges, std::optional<int> open = {});

/// A solid cut open into faces of quadrilateral cells (targets/fold/solid_net.hpp).
struct SolidGoal {
  std::string name;  ///< one of solid_names(), or the file that gives it
  Solid shape = {};
  int cells = 2;    ///< of half a side of a face, 2 to max_solid_cells
  int columns = 0;  ///< bending columns of each crease; 0: for the search to choose
};
/// Most cells per half side: an icosahedron of more cells has tens of thousands of walls to keep apart.
inline constexpr int max_solid_cells = 8;

/// Goal of a fold: a box in any of its unfoldings, one net, or a solid.
struct FoldGoal {
  std::optional<std::array<int, 3>> box = {};        ///< edges in cells
  std::optional<std::array<double, 3>> box_mm = {};  ///< requested edges of the folded box, in mm
  std::optional<int> open = {};                      ///< the box's face that is left out, by box_face_names
  std::vector<FoldNet> nets;                         ///< to try in this order; one if a net was requested
  std::optional<SolidGoal> solid = {};               ///< then there are no nets
};

/// @param columns bending columns of each crease; 0: for the search to choose
/// @throws InvalidInput for an edge under 1 or over max_face_side
FoldGoal box_goal(const std::array<int, 3>& edges, std::optional<int> open = {}, int columns = 0);

/// @throws InvalidInput for what validate refuses, for what lay_out refuses with one column a crease, and for
/// a ring of faces that does not close when it folds
FoldGoal net_goal(FoldNet net);

/// Returns every key of a `target:` section of kind fold.
const KeyTable& fold_target_keys();

/// Reads a `target:` section of kind fold, which has one of three forms.
///   - `box: [4, 4, 4]`: edge lengths in cells along x, y, z; the bottom has 4 x 4 cells. Optionally `open: top` (or
///     another face: bottom, top, front, back, left, right): a box without that face.
///   - `net:` with faces and creases. The second face of a crease lies beyond the given side (left, right, bottom,
///     top) of the first. `shift: 1` moves it by cells along the crease; `columns: 2` gives the crease's bending
///     columns. Positive angles fold towards +z. Example:
///         `faces: [{name: base, cells: [4, 4]}, {name: flap, cells: [4, 2]}]`
///         `creases: [{faces: [base, flap], side: top, angle_deg: 90}]`
///   - `solid: icosahedron` (or another of solid_names(), or a mesh file), optionally `cells: 2`, per half side of a face.
/// `crease_columns: 2` applies to every crease; if omitted, the search chooses.
/// @throws InvalidInput for anything else, each at its place
/// @param read for a file of a solid
FoldGoal read_fold(const Node& target, const MeshReader& read = read_plain_mesh);

}  // namespace kinetix::targets
