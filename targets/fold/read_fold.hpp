#pragma once

#include "targets/document/section.hpp"
#include "targets/fold/fold_goal.hpp"
#include "targets/mesh/mesh_file.hpp"

namespace kinetix::targets {

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
