#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/linkage/cell_size.hpp"
#include "model/linkage/plate.hpp"
#include "model/linkage/rest_hinge.hpp"

namespace kinetix::model {

/// A rigid body: the half walls that meet at one vertex.
struct LinkageBody {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< position of its vertex at rest, cell edges
  /// Direction of its turn about z, +1 or -1, as theta grows from flat. The two bodies of a hinge differ.
  int sense = 1;
  /// Turn as theta grows from flat, rad per rad. Empty: `sense` about z.
  std::optional<Eigen::Vector3d> spin = {};

  Eigen::Vector3d first_turn() const { return spin ? *spin : Eigen::Vector3d(0, 0, sense); }
};

/// A loop of bodies, each joined to the next by a hinge and the last to the first. Its length is even, since
/// neighbours have opposite senses.
struct LinkageCell {
  std::vector<int> bodies;  ///< counter-clockwise
  std::vector<int> hinges;  ///< hinge k joins bodies k and k + 1
};

/// Rigid bodies, the hinges that join them, and their walls, flat at rest. Elastic model, closure, contact
/// and simulation use only this description of a structure. Lattices create linkages (model/lattice/); a
/// linkage does not record its lattice.
struct Linkage {
  CellSize size;
  std::vector<LinkageBody> bodies;
  std::vector<RestHinge> hinges;
  std::vector<Plate> plates;  ///< two per hinge, at 2 hinge (the lower body's) and 2 hinge + 1
  std::vector<LinkageCell> cells;
  std::function<std::string(int hinge)> wall_name;   ///< wall name of a hinge in messages
  std::function<std::string(int body)> vertex_name;  ///< vertex name of a body in messages

  Eigen::Vector3d rest_position(int body) const;  ///< mm
};

/// Returns true if all hinge axes are along z at rest: then the structure moves in the plane.
bool all_vertical(const Linkage& linkage);

}  // namespace kinetix::model
